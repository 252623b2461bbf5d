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
struct VertexData {
    float4 position : SV_Position;
    [[vk::location(0)]] float3 positionWorld : TEXCOORD0;
    [[vk::location(1)]] float3 normalWorld : TEXCOORD1;
};

void main(
    [[vk::location(0)]] float3 i_position : POSITION,
    [[vk::location(1)]] float3 i_normal : NORMAL,
    out VertexData vd)
{
    vd.normalWorld = normalize(mul(float4(i_normal, 0.0), u_worldInverseTransposeMatrix).xyz);
    float4 positionWorld = mul(float4(i_position, 1.0), u_worldMatrix);
    vd.positionWorld = positionWorld.xyz;
    vd.position = mul(positionWorld, u_viewProjectionMatrix);
}
