// out · output · mxgen 0.1 · hlsl · complete · 0 closures · 0 textures
// shader model 5.1

cbuffer PublicUniforms : register(b1)
{
    float3 NG_c3 : packoffset(c0);
    row_major float3x3 NG_m3 : packoffset(c1);
    int NG_i : packoffset(c4);
    bool NG_b : packoffset(c4.y);
    float2 NG_v2 : packoffset(c4.z);
    float NG_f : packoffset(c5);
    float NG_g : packoffset(c5.y);
    float4 NG_v4 : packoffset(c6);
};

void main(
    out float4 out1 : SV_Target0)
{
    out1 = float4(mul(NG_c3, NG_m3) * (NG_g - (NG_f - (float(NG_i) + float(NG_b) + NG_v2.x))), 1.0) + NG_v4;
}
