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
    vec2 whole_uv = floor(vd.texcoord_0);
    bool are_both = whole_uv.y >= 0.0 && whole_uv.y <= 1.0;
    float vector[6] = float[6](0.0, 1.0, -1.0, -1.0, -1.0, 2.0);
    float wall_element = vector[int(clamp(whole_uv.x + whole_uv.y * 3.0, 0.0, 5.0))];
    bool wall_are_both = whole_uv.x >= 0.0 && whole_uv.x <= 2.0 && are_both && wall_element >= 0.0;
    vec2 fraction_uv = fract(vd.texcoord_0);
    vec2 slope_x_of_uv = dFdx(vd.texcoord_0);
    vec2 slope_y_of_uv = dFdy(vd.texcoord_0);
    vec4 wall_texel = textureGrad(wall_file, vec3(fraction_uv, wall_element), slope_x_of_uv, slope_y_of_uv);
    vec3 wall = mx_srgb_texture_to_lin_rec709((wall_are_both ? wall_texel : vec4(1.0, 0.0, 1.0, 1.0)).xyz);
    vec3 stone_weight = abs(normalize(vd.normalObject));
    vec3 stone_weight_2 = stone_weight / dot(stone_weight, vec3(1.0));
    vec3 stone_weight_3 = stone_weight_2 / dot(stone_weight_2, vec3(1.0));
    vec4 stone_product = texture(stone_filex, vd.positionObject.yz) * stone_weight_3.x;
    vec2 whole_along_z = floor(vd.positionObject.xy);
    bool stone_are_both = whole_along_z.x >= 0.0 && whole_along_z.x <= 2.0;
    float stone_element = vector[int(clamp(whole_along_z.x + whole_along_z.y * 3.0, 0.0, 5.0))];
    bool stone_are_both_2 = stone_are_both && (whole_along_z.y >= 0.0 && whole_along_z.y <= 1.0) && stone_element
        >= 0.0;
    vec2 slope_x_of_along_z = dFdx(vd.positionObject.xy);
    vec2 slope_y_of_along_z = dFdy(vd.positionObject.xy);
    vec4 stone_texel = textureGrad(stone_filez, vec3(fract(vd.positionObject.xy), stone_element), slope_x_of_along_z,
        slope_y_of_along_z);
    vec4 stone_product_2 = (stone_are_both_2 ? stone_texel : vec4(0.0, 0.0, 0.0, 1.0)) * stone_weight_3.z;
    vec3 stone = (stone_product + texture(stone_filey, vd.positionObject.xz) * stone_weight_3.y + stone_product_2).xyz;
    bool rust_are_both = are_both && (whole_uv.x >= 0.0 && whole_uv.x <= 1.0);
    vec3 rust_vector = vec3(fraction_uv, whole_uv.x + whole_uv.y * 2.0);
    vec4 rust_texel = textureGrad(rust_file, rust_vector, slope_x_of_uv, slope_y_of_uv);
    out1 = vec4(mix(wall, stone, (rust_are_both ? rust_texel : vec4(0.0, 0.0, 0.0, 1.0)).x), 1.0);
}
