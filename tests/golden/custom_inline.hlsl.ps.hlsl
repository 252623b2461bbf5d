// out · output · mxgen 0.1 · hlsl · complete · 0 closures · 0 textures
// shader model 6.0

struct VertexData {
    float4 position : SV_Position;
    float2 texcoord_0 : TEXCOORD0;
};

void main(
    VertexData vd,
    out float4 out1 : SV_Target0)
{
    // NG
    float3 c = float3(atan2(vd.texcoord_0.y, vd.texcoord_0.x), length(vd.texcoord_0), 0.0);
    out1 = float4(lerp(c, c * float3(1.0, 0.9, 0.7), 0.25), 1.0);
}
