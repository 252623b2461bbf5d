// x · output · mxgen 0.1 · hlsl · reduced · 0 closures · 0 textures
// shader model 6.0

struct VertexData {
    float4 position : SV_Position;
    float2 texcoord_0 : TEXCOORD0;
};

void main(
    VertexData vd,
    out float4 out1 : SV_Target0)
{
    out1 = float4(vd.texcoord_0.xxx, 1.0);
}
