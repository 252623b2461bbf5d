// out · output · mxgen 0.1 · hlsl · reduced · 0 closures · 5 textures
// shader model 6.0

Texture2D stone_filex : register(t3);
SamplerState stone_filex_sampler : register(s3);
Texture2D stone_filey : register(t4);
SamplerState stone_filey_sampler : register(s4);
Texture2DArray stone_filez : register(t5);
SamplerState stone_filez_sampler : register(s5);
Texture2DArray wall_file : register(t6);
SamplerState wall_file_sampler : register(s6);
Texture2DArray rust_file : register(t7);
SamplerState rust_file_sampler : register(s7);
struct VertexData {
    float4 position : SV_Position;
    float3 positionObject : TEXCOORD0;
    float3 normalObject : TEXCOORD1;
    float2 texcoord_0 : TEXCOORD2;
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
    float2 tile = floor(vd.texcoord_0);
    bool in_rows = tile.y >= 0.0 && tile.y <= 1.0;
    float vector_[6] = {0.0, 1.0, -1.0, -1.0, -1.0, 2.0};
    float wall_element = vector_[int(clamp(tile.x + tile.y * 3.0, 0.0, 5.0))];
    bool wall_are_both = tile.x >= 0.0 && tile.x <= 2.0 && in_rows && wall_element >= 0.0;
    float2 fraction_uv = frac(vd.texcoord_0);
    float2 slope_x_of_uv = ddx(vd.texcoord_0);
    float2 slope_y_of_uv = ddy(vd.texcoord_0);
    float4 wall_texel = wall_file.SampleGrad(wall_file_sampler, float3(fraction_uv, wall_element), slope_x_of_uv,
        slope_y_of_uv);
    float3 wall = mx_srgb_texture_to_lin_rec709((wall_are_both ? wall_texel : float4(1.0, 0.0, 1.0, 1.0)).xyz);
    float3 stone_weight = abs(normalize(vd.normalObject));
    float3 stone_weight_2 = stone_weight / dot(stone_weight, float3(1.0, 1.0, 1.0));
    float3 stone_weight_3 = stone_weight_2 / dot(stone_weight_2, float3(1.0, 1.0, 1.0));
    float4 stone_product = stone_filex.Sample(stone_filex_sampler, vd.positionObject.yz) * stone_weight_3.x;
    float2 stone_tile = floor(vd.positionObject.xy);
    bool in_columns = stone_tile.x >= 0.0 && stone_tile.x <= 2.0;
    float stone_element = vector_[int(clamp(stone_tile.x + stone_tile.y * 3.0, 0.0, 5.0))];
    bool stone_are_both = in_columns && stone_tile.y >= 0.0 && stone_tile.y <= 1.0 && stone_element >= 0.0;
    float2 slope_x_of_along_z = ddx(vd.positionObject.xy);
    float2 slope_y_of_along_z = ddy(vd.positionObject.xy);
    float4 stone_texel = stone_filez.SampleGrad(stone_filez_sampler, float3(frac(vd.positionObject.xy), stone_element),
        slope_x_of_along_z, slope_y_of_along_z);
    float4 stone_product_2 = (stone_are_both ? stone_texel : float4(0.0, 0.0, 0.0, 1.0)) * stone_weight_3.z;
    float3 stone = (stone_product + stone_filey.Sample(stone_filey_sampler, vd.positionObject.xz) * stone_weight_3.y
        + stone_product_2).xyz;
    bool tile_is_inside = in_rows && tile.x >= 0.0 && tile.x <= 1.0;
    float3 rust_vector = float3(fraction_uv, tile.x + tile.y * 2.0);
    float4 rust_texel = rust_file.SampleGrad(rust_file_sampler, rust_vector, slope_x_of_uv, slope_y_of_uv);
    out1 = float4(lerp(wall, stone, (tile_is_inside ? rust_texel : float4(0.0, 0.0, 0.0, 1.0)).x), 1.0);
}
