// Moved · surfacematerial · mxgen 0.1 · hlsl · reduced · 1 closure · 1 texture
// shader model 6.0

cbuffer PrivateUniforms : register(b0)
{
    row_major float4x4 u_worldMatrix : packoffset(c0);
    row_major float4x4 u_worldInverseTransposeMatrix : packoffset(c4);
    row_major float4x4 u_viewProjectionMatrix : packoffset(c8);
    float3 u_viewPosition : packoffset(c12);
    row_major float4x4 u_envMatrix : packoffset(c13);
    float u_envLightIntensity : packoffset(c17);
};
Texture2D height_file : register(t3);
SamplerState height_file_sampler : register(s3);
Texture2D u_envIrradiance : register(t4);
SamplerState u_envIrradiance_sampler : register(s4);
struct VertexData {
    float4 position : SV_Position;
    float3 positionWorld : TEXCOORD0;
    float3 normalWorld : TEXCOORD1;
    float3 tangentWorld : TEXCOORD2;
    float2 texcoord_0 : TEXCOORD3;
};

// 1 on a line of this radius between two points, 0 beside it.
// Here radius = 0.1, point1 = float2(0.25, 0.25), point2 = float2(0.75, 0.75).
float mx_line(float2 p)
{
    float2 from = p - float2(0.25, 0.25);
    return distance(from, float2(0.5, 0.5) * clamp(dot(from, float2(0.5, 0.5)) / 0.5, 0.0, 1.0)) > 0.1 ? 0.0 : 1.0;
}

// The angle, over pi, with this sine and cosine; the cosine is not negative. It errs by 2.9e-5 at most.
float mx_half_turn(float sine, float cosine)
{
    return sine * (0.4999709 + cosine * (cosine * (0.2302802 + cosine * (0.0398298 * cosine - 0.1351235)) - 0.3164252));
}

// The square of the distance of the unit direction d from the vertical axis, never 0.
float mx_map_square(float3 d)
{
    return d.x * d.x + (d.z * d.z + 1e-16);
}

// The point of the latitude-longitude picture for the unit direction d, to a tenth of a texel in 4096.
float2 mx_map_point(float3 d)
{
    float square = mx_map_square(d);
    float stretch = rsqrt(square);
    return float2(frac((d.z > 0.0 ? -0.5 : 0.5) * (mx_half_turn(d.x * stretch, abs(d.z) * stretch) + 0.5) + 0.25),
        0.5 - mx_half_turn(d.y, square * stretch));
}

void main(
    VertexData vd,
    out float4 out1 : SV_Target0)
{
    float3 color = float3(0.0, 0.0, 0.0);
    // environment: bsdf
    float3 Ng = normalize(vd.normalWorld);
    float both = height_file.Sample(height_file_sampler, vd.texcoord_0).x * mx_line(vd.texcoord_0);
    float3 displacement = normalize(vd.tangentWorld) * 0.1 + Ng * both;
    float3 P = lerp(displacement, Ng * (both * 0.5), 0.25) + vd.positionWorld;
    float3 facet = normalize(cross(ddx(P), ddy(P)));
    float3 facet_normal = faceforward(facet, -Ng, facet);
    float3 facet_2 = normalize(cross(ddx(vd.positionWorld), ddy(vd.positionWorld)));
    float3 displaced_normal = normalize(Ng + (facet_normal - faceforward(facet_2, -Ng, facet_2)));
    color += u_envIrradiance.SampleLevel(u_envIrradiance_sampler,
        mx_map_point(normalize(mul(faceforward(displaced_normal, -normalize(u_viewPosition - P), displaced_normal),
        (float3x3)u_envMatrix))), 0.0).xyz * (u_envLightIntensity * 0.18);
    out1 = float4(color, 1.0);
}
