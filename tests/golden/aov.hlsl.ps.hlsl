// Paint · surfacematerial · mxgen 0.1 · hlsl · reduced · 4 closures · 0 textures
// shader model 6.0

cbuffer PrivateUniforms : register(b0)
{
    row_major float4x4 u_worldMatrix : packoffset(c0);
    row_major float4x4 u_worldInverseTransposeMatrix : packoffset(c4);
    row_major float4x4 u_viewProjectionMatrix : packoffset(c8);
    float3 u_viewPosition : packoffset(c12);
    int u_numActiveLightSources : packoffset(c12.w);
    float u_alphaThreshold : packoffset(c13);
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
cbuffer LightData_block : register(b2)
{
    LightData u_lightData[3];
};
struct VertexData {
    float4 position : SV_Position;
    float3 positionWorld : TEXCOORD0;
    float3 normalObject : TEXCOORD1;
    float3 normalWorld : TEXCOORD2;
    float2 texcoord_0 : TEXCOORD3;
};

void main(
    VertexData vd,
    out float4 out1 : SV_Target0,
    out float4 aov_diffuse : SV_Target1,
    out float4 aov_glow : SV_Target2,
    out float4 aov_base_albedo : SV_Target3,
    out float4 aov_uv : SV_Target4,
    out float4 aov_weights : SV_Target5,
    out int aov_is_paint : SV_Target6,
    out int aov_id : SV_Target7,
    out float4 aov_normal : SV_Target8)
{
    float3 color = float3(0.1, 0.2, 0.3);
    // lights
    float3 Ng = normalize(vd.normalWorld);
    float3 P = Ng * vd.texcoord_0.x + vd.positionWorld;
    float3 facet = normalize(cross(ddx(P), ddy(P)));
    float3 facet_normal = faceforward(facet, -Ng, facet);
    float3 facet_2 = normalize(cross(ddx(vd.positionWorld), ddy(vd.positionWorld)));
    float3 displaced_normal = normalize(Ng + (facet_normal - faceforward(facet_2, -Ng, facet_2)));
    // SR/base
    float3 facing = faceforward(displaced_normal, -normalize(u_viewPosition - P), displaced_normal);
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        float3 L;
        float intensity;
        int light_type = u_lightData[i].type;
        if (light_type == 1) {
            L = -u_lightData[i].direction;
            intensity = u_lightData[i].intensity;
        } else {
            float3 d = u_lightData[i].position - P;
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
        color += u_lightData[i].color * (intensity * (max(dot(L, facing), 1e-8) * 0.31830987 * float3(0.8, 0.1, 0.1)));
    }
    float3 color_2 = float3(0.0, 0.0, 0.0);
    // lights (2)
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        float3 L;
        float intensity;
        int light_type = u_lightData[i].type;
        if (light_type == 1) {
            L = -u_lightData[i].direction;
            intensity = u_lightData[i].intensity;
        } else {
            float3 d = u_lightData[i].position - P;
            float3 to_light = normalize(d);
            L = to_light;
            float falloff = u_lightData[i].intensity / pow(length(d) + 1.0, u_lightData[i].decay_rate);
            if (light_type == 2) {
                intensity = falloff;
            } else {
                float edge = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
                intensity = light_type == 3
                    ? falloff * smoothstep(edge, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, to_light))
                    : 0.0;
            }
        }
        // diffuse (2)
        color_2 += u_lightData[i].color * (intensity
            * (max(dot(facing, L), 1e-8) * 0.31830987 * float3(0.8, 0.1, 0.1)));
    }
    // opacity
    if (0.5 < u_alphaThreshold)
        discard;
    out1 = float4(color * 0.5, 0.5);
    aov_diffuse = float4(color_2 * 0.5, 0.5);
    aov_glow = float4(0.05, 0.1, 0.15, 0.5);
    aov_base_albedo = float4(0.4, 0.05, 0.05, 0.5);
    aov_uv = float4(vd.texcoord_0 * 0.5, 0.0, 0.5);
    aov_weights = float4(0.05, 0.1, 0.15, 0.2);
    aov_is_paint = 1;
    aov_id = 7;
    aov_normal = float4(normalize(vd.normalObject) * 0.5, 0.5);
}
