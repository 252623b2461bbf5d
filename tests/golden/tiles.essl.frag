#version 300 es
// out · output · mxgen 0.1 · essl · reduced · 0 closures · 5 textures
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler2DArray;

uniform sampler2D stone_filex;
uniform sampler2D stone_filey;
uniform sampler2DArray stone_filez;
uniform sampler2DArray wall_file;
uniform sampler2DArray rust_file;
in vec3 vd_positionObject;
in vec3 vd_normalObject;
in vec2 vd_texcoord_0;
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
    vec2 wall_tile = floor(vd_texcoord_0);
    bool wall_in_columns = wall_tile.x >= 0.0 && wall_tile.x <= 2.0;
    float vector[6] = float[6](0.0, 1.0, -1.0, -1.0, -1.0, 2.0);
    float wall_element = vector[int(clamp(wall_tile.x + wall_tile.y * 3.0, 0.0, 5.0))];
    bool wall_are_both = wall_in_columns && wall_tile.y >= 0.0 && wall_tile.y <= 1.0 && wall_element >= 0.0;
    vec2 dx = dFdx(vd_texcoord_0);
    vec2 dy = dFdy(vd_texcoord_0);
    vec4 wall_texel = textureGrad(wall_file, vec3(fract(vd_texcoord_0), wall_element), dx, dy);
    vec3 stone_weight = abs(normalize(vd_normalObject));
    vec3 stone_weight_2 = stone_weight / dot(stone_weight, vec3(1.0));
    vec3 stone_weight_3 = stone_weight_2 / dot(stone_weight_2, vec3(1.0));
    vec4 stone_product = texture(stone_filex, vd_positionObject.yz) * stone_weight_3.x;
    vec2 stone_tile = floor(vd_positionObject.xy);
    bool stone_in_columns = stone_tile.x >= 0.0 && stone_tile.x <= 2.0;
    float stone_element = vector[int(clamp(stone_tile.x + stone_tile.y * 3.0, 0.0, 5.0))];
    bool stone_are_both = stone_in_columns && stone_tile.y >= 0.0 && stone_tile.y <= 1.0 && stone_element >= 0.0;
    vec2 slope_x_of_along_z = dFdx(vd_positionObject.xy);
    vec2 slope_y_of_along_z = dFdy(vd_positionObject.xy);
    const vec4 stone_constant = vec4(0.0, 0.0, 0.0, 1.0);
    vec4 stone_product_2 = (stone_are_both
        ? textureGrad(stone_filez, vec3(fract(vd_positionObject.xy), stone_element), slope_x_of_along_z,
        slope_y_of_along_z) : stone_constant) * stone_weight_3.z;
    vec3 stone = (stone_product + texture(stone_filey, vd_positionObject.xz) * stone_weight_3.y + stone_product_2).xyz;
    vec2 size = vec2(textureSize(rust_file, 0).xy);
    vec2 texel = vd_texcoord_0 * size - vec2(0.5);
    vec2 whole_texel = floor(texel);
    vec2 f = fract(texel);
    vec2 w1 = vec2(0.6666667) - f * f * (vec2(1.0) - f * 0.5);
    vec2 scaled_g = (vec2(1.0) - f) * (vec2(1.0) - f);
    vec2 low = (whole_texel - vec2(0.5) + w1 / (w1 + (vec2(1.0) - f) * scaled_g / vec2(6.0))) / size;
    vec2 rust_tile = floor(low);
    bool rust_in_columns = rust_tile.x >= 0.0 && rust_tile.x <= 1.0;
    bool rust_tile_is_inside = rust_in_columns && rust_tile.y >= 0.0 && rust_tile.y <= 1.0;
    vec3 rust_vector = vec3(fract(low), rust_tile.x + rust_tile.y * 2.0);
    vec4 rust_choice = rust_tile_is_inside ? textureGrad(rust_file, rust_vector, dx, dy) : stone_constant;
    vec2 w3 = f * (f * f) / vec2(6.0);
    vec2 t = vec2(0.6666667) - scaled_g * (vec2(1.0) - (vec2(1.0) - f) * 0.5) + w3;
    vec2 high = (whole_texel + vec2(1.5) + w3 / t) / size;
    vec2 rust_vector_2 = vec2(high.x, low.y);
    vec2 rust_tile_2 = floor(rust_vector_2);
    bool rust_in_columns_2 = rust_tile_2.x >= 0.0 && rust_tile_2.x <= 1.0;
    bool rust_tile_is_inside_2 = rust_in_columns_2 && rust_tile_2.y >= 0.0 && rust_tile_2.y <= 1.0;
    vec3 rust_vector_3 = vec3(fract(rust_vector_2), rust_tile_2.x + rust_tile_2.y * 2.0);
    vec4 rust_blend = mix(rust_choice, rust_tile_is_inside_2 ? textureGrad(rust_file, rust_vector_3, dx, dy)
        : stone_constant, t.x);
    vec2 rust_vector_4 = vec2(low.x, high.y);
    vec2 rust_tile_3 = floor(rust_vector_4);
    bool rust_in_columns_3 = rust_tile_3.x >= 0.0 && rust_tile_3.x <= 1.0;
    bool rust_tile_is_inside_3 = rust_in_columns_3 && rust_tile_3.y >= 0.0 && rust_tile_3.y <= 1.0;
    vec3 rust_vector_5 = vec3(fract(rust_vector_4), rust_tile_3.x + rust_tile_3.y * 2.0);
    vec4 rust_choice_2 = rust_tile_is_inside_3 ? textureGrad(rust_file, rust_vector_5, dx, dy) : stone_constant;
    vec2 rust_tile_4 = floor(high);
    bool rust_in_columns_4 = rust_tile_4.x >= 0.0 && rust_tile_4.x <= 1.0;
    bool rust_tile_is_inside_4 = rust_in_columns_4 && rust_tile_4.y >= 0.0 && rust_tile_4.y <= 1.0;
    vec3 rust_vector_6 = vec3(fract(high), rust_tile_4.x + rust_tile_4.y * 2.0);
    float rust = mix(rust_blend, mix(rust_choice_2,
        rust_tile_is_inside_4 ? textureGrad(rust_file, rust_vector_6, dx, dy) : stone_constant, t.x), t.y).x;
    out1 = vec4(mix(mx_srgb_texture_to_lin_rec709((wall_are_both ? wall_texel : vec4(1.0, 0.0, 1.0, 1.0)).xyz), stone,
        rust), 1.0);
}
