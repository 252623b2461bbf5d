// M · surfacematerial · mxgen 0.1 · hlsl · reduced · 1 closure · 0 textures
// shader model 6.0

cbuffer PrivateUniforms : register(b0)
{
    row_major float4x4 u_worldMatrix : packoffset(c0);
    row_major float4x4 u_worldInverseTransposeMatrix : packoffset(c4);
    row_major float4x4 u_viewProjectionMatrix : packoffset(c8);
    float3 u_viewPosition : packoffset(c12);
    int u_numActiveLightSources : packoffset(c12.w);
};
struct LightData {
    float3 position;
    float3 direction;
    float3 tint;
    int type;
    float power;
};
cbuffer LightData_block : register(b2)
{
    LightData u_lightData[3];
};
struct VertexData {
    float4 position : SV_Position;
    float3 positionWorld : TEXCOORD0;
    float3 normalWorld : TEXCOORD1;
};

void main(
    VertexData vd,
    out float4 out1 : SV_Target0)
{
    float3 color = float3(0.0, 0.0, 0.0);
    // lights
    float3 N = normalize(vd.normalWorld);
    float3 facing = faceforward(N, -normalize(u_viewPosition - vd.positionWorld), N);
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        float3 L;
        float3 intensity;
        float3 difference = u_lightData[i].position - vd.positionWorld;
        float way = length(difference);
        L = difference / way;
        if (u_lightData[i].type == 2) {
            float3 conical_edf_emission = smoothstep(0.8660254, 0.9848077,
                dot(normalize(u_lightData[i].direction), -(difference / way))) * float3(1.0, 0.5, 0.2);
            intensity = conical_edf_emission * (60.0 / (way * way));
        } else {
            float bulb_ratio = u_lightData[i].power / (way * way);
            intensity = u_lightData[i].tint * (u_lightData[i].type == 4 ? bulb_ratio : 0.0);
        }
        // bsdf
        color += intensity * (max(dot(L, facing), 1e-8) * 0.31830987 * 0.8);
    }
    out1 = float4(color, 1.0);
}
