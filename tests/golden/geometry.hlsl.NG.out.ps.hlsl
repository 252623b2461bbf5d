// out · output · mxgen 0.1 · hlsl · complete · 0 closures · 0 textures
// shader model 6.0

cbuffer PrivateUniforms : register(b0)
{
    row_major float4x4 u_worldMatrix : packoffset(c0);
    row_major float4x4 u_viewProjectionMatrix : packoffset(c4);
    float3 u_viewPosition : packoffset(c8);
    float u_time : packoffset(c8.w);
};
struct VertexData {
    float4 position : SV_Position;
    float3 positionWorld : TEXCOORD0;
    float3 normalObject : TEXCOORD1;
    float3 tangentObject : TEXCOORD2;
    float4 color_0 : TEXCOORD3;
    float geomprop_wear : TEXCOORD4;
    nointerpolation int geomprop_part : TEXCOORD5;
};

void main(
    VertexData vd,
    out float4 out1 : SV_Target0)
{
    // NG
    float3 v = normalize(vd.positionWorld - u_viewPosition);
    float facing = dot(normalize(vd.normalObject), v);
    out1 = float4(facing, dot(v, normalize(vd.tangentObject)), vd.geomprop_wear, float(vd.geomprop_part)) * vd.color_0
        * u_time;
}
