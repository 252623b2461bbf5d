// Holes · surfacematerial · mxgen 0.1 · hlsl · complete · 0 closures · 0 textures
// shader model 6.0

cbuffer PrivateUniforms : register(b0)
{
    row_major float4x4 u_worldMatrix : packoffset(c0);
    row_major float4x4 u_viewProjectionMatrix : packoffset(c4);
    float u_alphaThreshold : packoffset(c8);
};
struct VertexData {
    precise float4 position : SV_Position;
    float geomprop_torn : TEXCOORD0;
};

void main(
    float3 i_position : POSITION,
    float i_geomprop_torn : GEOMPROP_TORN,
    out VertexData vd)
{
    vd.geomprop_torn = i_geomprop_torn;
    vd.position = mul(mul(float4(i_position, 1.0), u_worldMatrix), u_viewProjectionMatrix);
}
