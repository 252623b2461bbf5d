// Holes · surfacematerial · mxgen 0.1 · hlsl · complete · 0 closures · 0 textures
// shader model 6.0

cbuffer PrivateUniforms : register(b0)
{
    row_major float4x4 u_worldMatrix : packoffset(c0);
    row_major float4x4 u_viewProjectionMatrix : packoffset(c4);
    float u_alphaThreshold : packoffset(c8);
};
struct VertexData {
    float4 position : SV_Position;
    float geomprop_torn : TEXCOORD0;
};

void main(
    VertexData vd)
{
    if (vd.geomprop_torn < u_alphaThreshold)
        discard;
}
