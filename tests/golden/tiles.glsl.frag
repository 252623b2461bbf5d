#version 450
// out · output · mxgen 0.1 · glsl · complete · 0 closures · 5 textures

uniform sampler2D stone_filex;
uniform sampler2D stone_filey;
uniform sampler2DArray stone_filez;
uniform sampler2DArray wall_file;
uniform sampler2DArray rust_file;
in VertexData {
    vec3 positionObject;
    vec3 normalObject;
    vec2 texcoord_0;
} vd;
out vec4 out1;

// IEC 61966-2-1
vec3 mx_srgb_texture_to_lin_rec709(const vec3 color)
{
    return mix(color / vec3(12.92), pow(max((color + vec3(0.055)) / vec3(1.055), vec3(0.0)), vec3(2.4)),
        step(0.04045, color));
}

void main()
{
    // NG
    vec2 tile = floor(vd.texcoord_0);
    bool in_rows = tile.y >= 0.0 && tile.y <= 1.0;
    float vector[6] = float[6](0.0, 1.0, -1.0, -1.0, -1.0, 2.0);
    float wall_element = vector[int(clamp(tile.x + tile.y * 3.0, 0.0, 5.0))];
    bool wall_are_both = tile.x >= 0.0 && tile.x <= 2.0 && in_rows && wall_element >= 0.0;
    vec2 fraction_uv = fract(vd.texcoord_0);
    vec2 slope_x_of_uv = dFdx(vd.texcoord_0);
    vec2 slope_y_of_uv = dFdy(vd.texcoord_0);
    vec4 wall_texel = textureGrad(wall_file, vec3(fraction_uv, wall_element), slope_x_of_uv, slope_y_of_uv);
    vec3 wall = mx_srgb_texture_to_lin_rec709((wall_are_both ? wall_texel : vec4(1.0, 0.0, 1.0, 1.0)).xyz);
    vec3 stone_weight = abs(normalize(vd.normalObject));
    vec3 stone_weight_2 = stone_weight / dot(stone_weight, vec3(1.0));
    vec3 stone_weight_3 = stone_weight_2 / dot(stone_weight_2, vec3(1.0));
    vec4 stone_product = texture(stone_filex, vd.positionObject.yz) * stone_weight_3.x;
    vec2 stone_tile = floor(vd.positionObject.xy);
    bool in_columns = stone_tile.x >= 0.0 && stone_tile.x <= 2.0;
    float stone_element = vector[int(clamp(stone_tile.x + stone_tile.y * 3.0, 0.0, 5.0))];
    bool stone_are_both = in_columns && stone_tile.y >= 0.0 && stone_tile.y <= 1.0 && stone_element >= 0.0;
    vec2 slope_x_of_along_z = dFdx(vd.positionObject.xy);
    vec2 slope_y_of_along_z = dFdy(vd.positionObject.xy);
    vec4 stone_texel = textureGrad(stone_filez, vec3(fract(vd.positionObject.xy), stone_element), slope_x_of_along_z,
        slope_y_of_along_z);
    vec4 stone_product_2 = (stone_are_both ? stone_texel : vec4(0.0, 0.0, 0.0, 1.0)) * stone_weight_3.z;
    vec3 stone = (stone_product + texture(stone_filey, vd.positionObject.xz) * stone_weight_3.y + stone_product_2).xyz;
    bool tile_is_inside = in_rows && tile.x >= 0.0 && tile.x <= 1.0;
    vec3 rust_vector = vec3(fraction_uv, tile.x + tile.y * 2.0);
    vec4 rust_texel = textureGrad(rust_file, rust_vector, slope_x_of_uv, slope_y_of_uv);
    out1 = vec4(mix(wall, stone, (tile_is_inside ? rust_texel : vec4(0.0, 0.0, 0.0, 1.0)).x), 1.0);
}
