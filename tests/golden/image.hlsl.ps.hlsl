// out · output · mxgen 0.1 · hlsl · complete · 0 closures · 3 textures
// shader model 6.0

Texture2D NG_file : register(t3);
SamplerState NG_file_sampler : register(s3);
Texture2D framed_file : register(t4);
SamplerState framed_file_sampler : register(s4);
Texture2D tiled_file : register(t5);
SamplerState tiled_file_sampler : register(s5);
struct VertexData {
    float4 position : SV_Position;
    float2 texcoord_0 : TEXCOORD0;
};

// IEC 61966-2-1
float3 mx_srgb_texture_to_lin_rec709(float3 color)
{
    return lerp(color / 12.92, pow(max((color + 0.055) / 1.055, 0.0), float3(2.4, 2.4, 2.4)), step(0.04045, color));
}

void main(
    VertexData vd,
    out float4 out1 : SV_Target0)
{
    // NG
    float3 base = mx_srgb_texture_to_lin_rec709(NG_file.Sample(NG_file_sampler, vd.texcoord_0).xyz);
    float3 tiled = mx_srgb_texture_to_lin_rec709(tiled_file.Sample(tiled_file_sampler,
        vd.texcoord_0 * float2(4.0, 2.0)).xyz);
    out1 = float4(base * framed_file.Sample(framed_file_sampler, vd.texcoord_0).xyz + tiled, 1.0);
}
