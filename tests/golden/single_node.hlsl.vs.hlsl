// out · output · mxgen 0.1 · hlsl · complete · 0 closures · 0 textures
// shader model 6.0

cbuffer PrivateUniforms : register(b0)
{
    row_major float4x4 u_worldMatrix : packoffset(c0);
    row_major float4x4 u_viewProjectionMatrix : packoffset(c4);
};
struct VertexData {
    float4 position : SV_Position;
    float3 positionWorld : TEXCOORD0;
};

void main(
    float3 i_position : POSITION,
    out VertexData vd)
{
    float4 positionWorld = mul(float4(i_position, 1.0), u_worldMatrix);
    vd.positionWorld = positionWorld.xyz;
    vd.position = mul(positionWorld, u_viewProjectionMatrix);
}
