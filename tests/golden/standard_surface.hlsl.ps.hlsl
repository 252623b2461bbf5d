// Clay · surfacematerial · mxgen 0.1 · hlsl · reduced · 1 closure · 0 textures
// shader model 6.0

[[vk::binding(0, 0)]] cbuffer PrivateUniforms : register(b0)
{
    row_major float4x4 u_worldMatrix : packoffset(c0);
    row_major float4x4 u_worldInverseTransposeMatrix : packoffset(c4);
    row_major float4x4 u_viewProjectionMatrix : packoffset(c8);
    float3 u_viewPosition : packoffset(c12);
    int u_numActiveLightSources : packoffset(c12.w);
    row_major float4x4 u_envMatrix : packoffset(c13);
    float u_envLightIntensity : packoffset(c17);
};
struct LightData {
    float3 direction;
    float3 color;
    float3 position;
    int type;
    float intensity;
    float decay_rate;
    float inner_angle;
    float outer_angle;
};
[[vk::binding(2, 0)]] cbuffer LightData_block : register(b2)
{
    LightData u_lightData[3];
};
[[vk::binding(3, 0)]] Texture2D u_envIrradiance : register(t3);
[[vk::binding(3, 0)]] SamplerState u_envIrradiance_sampler : register(s3);
struct VertexData {
    float4 position : SV_Position;
    [[vk::location(0)]] float3 positionWorld : TEXCOORD0;
    [[vk::location(1)]] float3 normalWorld : TEXCOORD1;
};

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
    [[vk::location(0)]] out float4 out1 : SV_Target0)
{
    float3 color = float3(0.0, 0.0, 0.0);
    // lights
    float3 axis = normalize(vd.normalWorld);
    float3 V = normalize(u_viewPosition - vd.positionWorld);
    // SR_clay
    float3 facing = faceforward(axis, -V, axis);
    float cos_v = max(abs(dot(axis, V)), 1e-8);
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        float3 L;
        float intensity;
        int light_type = u_lightData[i].type;
        if (light_type == 1) {
            L = -u_lightData[i].direction;
            intensity = u_lightData[i].intensity;
        } else {
            float3 d = u_lightData[i].position - vd.positionWorld;
            float3 to_light = normalize(d);
            L = to_light;
            float falloff = u_lightData[i].intensity / pow(length(d) + 1.0, u_lightData[i].decay_rate);
            if (light_type == 2) {
                intensity = falloff;
            } else {
                float edge = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
                intensity = light_type == 3
                    ? smoothstep(edge, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, to_light)) * falloff
                    : 0.0;
            }
        }
        // diffuse
        float cos_l = max(dot(L, facing), 1e-8);
        float diffuse_sum = max(dot(L, V) - cos_l * cos_v, 0.0) * 0.36 / max(cos_l, cos_v) + 0.73913044;
        color += u_lightData[i].color * (intensity * (cos_l * 0.31830987 * float3(0.5, 0.25, 0.15) * diffuse_sum));
    }
    // environment: diffuse
    float2 fit = (cos_v * float2(-0.7632, -0.4993) - float2(0.4297, 0.6076) + float2(0.8631, 1.2189)) * 0.6
        + float2(1.0, 1.0);
    float3 environment_irradiance = u_envIrradiance.SampleLevel(u_envIrradiance_sampler,
        mx_map_point(normalize(mul(facing, (float3x3)u_envMatrix))), 0.0).xyz * u_envLightIntensity;
    color += clamp(fit.x / fit.y, 0.0, 1.0) * float3(0.5, 0.25, 0.15) * environment_irradiance;
    out1 = float4(color, 1.0);
}
