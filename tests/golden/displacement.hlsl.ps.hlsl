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

float mx_line(float2 p)
{
    float2 from = p - float2(0.25, 0.25);
    return distance(from, float2(0.5, 0.5) * clamp(dot(from, float2(0.5, 0.5)) / 0.5, 0.0, 1.0)) > 0.1 ? 0.0 : 1.0;
}

// atan(t) over pi for |t| <= 1, within 2.6e-5; the built-in function takes thrice as long.
float mx_half_turn(float t)
{
    float t2 = t * t;
    return t * (0.3180596 + t2 * (t2 * (0.0465574 - 0.0124098 * t2) - 0.1022332));
}

// The point of the picture for a unit direction in it, to a tenth of a texel in 4096.
float2 mx_map_point(float3 d)
{
    float radius = length(d.xz);
    float turn = mx_half_turn(d.x / max(abs(d.z) + radius, 1e-8));
    return float2(frac(d.z > 0.0 ? -turn : 0.5 + turn), 0.5 - 2.0 * mx_half_turn(d.y / (1.0 + radius)));
}

void main(
    VertexData vd,
    out float4 out1 : SV_Target0)
{
    float3 color = float3(0.0, 0.0, 0.0);
    // environment
    // bsdf
    float3 direction = normalize(vd.normalWorld);
    float both = height_file.Sample(height_file_sampler, vd.texcoord_0).x * mx_line(vd.texcoord_0);
    float3 D1_sum = normalize(vd.tangentWorld) * 0.1 + direction * both;
    float3 P_sum = lerp(D1_sum, direction * (both * 0.5), 0.25) + vd.positionWorld;
    float3 facet_direction = normalize(cross(ddx(P_sum), ddy(P_sum)));
    float3 facet_facing = faceforward(facet_direction, -direction, facet_direction);
    float3 facet_direction_2 = normalize(cross(ddx(vd.positionWorld), ddy(vd.positionWorld)));
    float3 N = normalize(direction + (facet_facing - faceforward(facet_direction_2, -direction, facet_direction_2)));
    color += u_envIrradiance.SampleLevel(u_envIrradiance_sampler,
        mx_map_point(normalize(mul(float4(faceforward(N, -normalize(u_viewPosition - P_sum), N), 0.0),
        u_envMatrix).xyz)), 0.0).xyz * (u_envLightIntensity * 0.18);
    out1 = float4(color, 1.0);
}
