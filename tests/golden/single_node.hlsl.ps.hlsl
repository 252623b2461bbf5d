// out · output · mxgen 0.1 · hlsl · complete · 0 closures · 0 textures
// shader model 6.0

struct VertexData {
    float4 position : SV_Position;
    float3 positionWorld : TEXCOORD0;
};

void main(
    VertexData vd,
    out float4 out1 : SV_Target0)
{
    out1 = float4(vd.positionWorld * 0.5, 1.0);
}
