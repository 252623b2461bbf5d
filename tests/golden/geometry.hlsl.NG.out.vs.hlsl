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
    float3 i_position : POSITION,
    float3 i_normal : NORMAL,
    float3 i_tangent : TANGENT,
    float4 i_color_0 : COLOR0,
    float i_geomprop_wear : GEOMPROP_WEAR,
    int i_geomprop_part : GEOMPROP_PART,
    out VertexData vd)
{
    vd.normalObject = i_normal;
    float4 positionWorld = mul(float4(i_position, 1.0), u_worldMatrix);
    vd.positionWorld = positionWorld.xyz;
    vd.tangentObject = i_tangent;
    vd.geomprop_wear = i_geomprop_wear;
    vd.geomprop_part = i_geomprop_part;
    vd.color_0 = i_color_0;
    vd.position = mul(positionWorld, u_viewProjectionMatrix);
}
