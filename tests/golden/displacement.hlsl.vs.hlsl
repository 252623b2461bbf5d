// Moved · surfacematerial · mxgen 0.1 · hlsl · reduced · 1 closure · 1 texture
// shader model 6.0

cbuffer PrivateUniforms : register(b0)
{
    row_major float4x4 u_worldMatrix : packoffset(c0);
    row_major float4x4 u_worldInverseTransposeMatrix : packoffset(c4);
    row_major float4x4 u_viewProjectionMatrix : packoffset(c8);
    float3 u_viewPosition : packoffset(c12);
    row_major float4x4 u_envMatrix : packoffset(c13);
    float u_envLightIntensity : packoffset(c17);
};
Texture2D height_file : register(t3);
SamplerState height_file_sampler : register(s3);
struct VertexData {
    float4 position : SV_Position;
    float3 positionWorld : TEXCOORD0;
    float3 normalWorld : TEXCOORD1;
    float3 tangentWorld : TEXCOORD2;
    float2 texcoord_0 : TEXCOORD3;
};

// 1 on a line of this radius between two points, 0 beside it.
// Here radius = 0.1, point1 = float2(0.25, 0.25), point2 = float2(0.75, 0.75).
float mx_line(float2 p)
{
    float2 from = p - float2(0.25, 0.25);
    return distance(from, float2(0.5, 0.5) * clamp(dot(from, float2(0.5, 0.5)) / 0.5, 0.0, 1.0)) > 0.1 ? 0.0 : 1.0;
}

void main(
    float3 i_position : POSITION,
    float3 i_normal : NORMAL,
    float3 i_tangent : TANGENT,
    float2 i_texcoord_0 : TEXCOORD0,
    out VertexData vd)
{
    float3 normalWorld = normalize(mul(float4(i_normal, 0.0), u_worldInverseTransposeMatrix).xyz);
    vd.normalWorld = normalWorld;
    vd.texcoord_0 = i_texcoord_0;
    float3 tangentWorld = normalize(mul(float4(i_tangent, 0.0), u_worldMatrix).xyz);
    vd.tangentWorld = tangentWorld;
    float3 positionWorld = mul(float4(i_position, 1.0), u_worldMatrix).xyz;
    vd.positionWorld = positionWorld;
    float both = height_file.SampleLevel(height_file_sampler, i_texcoord_0, 0.0).x * mx_line(i_texcoord_0);
    float3 displacement = tangentWorld * 0.1 + normalWorld * both;
    vd.position = mul(float4(positionWorld + lerp(displacement, normalWorld * (both * 0.5), 0.25), 1.0),
        u_viewProjectionMatrix);
}
