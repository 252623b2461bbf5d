#version 450
// out · output · mxgen 0.1 · vulkan · reduced · 0 closures · 5 textures

layout(set = 0, binding = 3) uniform sampler2D stone_filex;
layout(set = 0, binding = 4) uniform sampler2D stone_filey;
layout(set = 0, binding = 5) uniform sampler2DArray stone_filez;
layout(set = 0, binding = 6) uniform sampler2DArray wall_file;
layout(set = 0, binding = 7) uniform sampler2DArray rust_file;
layout(location = 0) in VertexData {
    vec3 positionObject;
    vec3 normalObject;
    vec2 texcoord_0;
} vd;
layout(location = 0) out vec4 out1;

vec3 mx_srgb_texture_to_lin_rec709(const vec3 color)
{
    return mix(color / vec3(12.92), pow(max((color + vec3(0.055)) / vec3(1.055), vec3(0.0)), vec3(2.4)), step(0.04045, color));
}

void main()
{
    // NG
    vec2 wall = floor(vd.texcoord_0);
    bool wall_2 = wall.x >= 0.0 && wall.x <= 2.0;
    float stone[6] = float[6](0.0, 1.0, -1.0, -1.0, -1.0, 2.0);
    float wall_3 = stone[int(clamp(wall.x + wall.y * 3.0, 0.0, 5.0))];
    bool wall_4 = wall_2 && (wall.y >= 0.0 && wall.y <= 1.0) && wall_3 >= 0.0;
    vec2 wall_5 = dFdx(vd.texcoord_0);
    vec2 wall_6 = dFdy(vd.texcoord_0);
    vec4 wall_7 = textureGrad(wall_file, vec3(fract(vd.texcoord_0), wall_3), wall_5, wall_6);
    vec3 stone_2 = abs(normalize(vd.normalObject));
    vec3 stone_3 = stone_2 / dot(stone_2, vec3(1.0));
    vec3 stone_4 = stone_3 / dot(stone_3, vec3(1.0));
    vec4 stone_5 = texture(stone_filex, vd.positionObject.yz) * stone_4.x;
    vec2 stone_6 = floor(vd.positionObject.xy);
    bool stone_7 = stone_6.x >= 0.0 && stone_6.x <= 2.0;
    float stone_8 = stone[int(clamp(stone_6.x + stone_6.y * 3.0, 0.0, 5.0))];
    bool stone_9 = stone_7 && (stone_6.y >= 0.0 && stone_6.y <= 1.0) && stone_8 >= 0.0;
    vec2 stone_10 = dFdx(vd.positionObject.xy);
    vec2 stone_11 = dFdy(vd.positionObject.xy);
    const vec4 stone_12 = vec4(0.0, 0.0, 0.0, 1.0);
    vec4 stone_13 = (stone_9 ? textureGrad(stone_filez, vec3(fract(vd.positionObject.xy), stone_8), stone_10, stone_11) : stone_12) * stone_4.z;
    vec3 stone_14 = (stone_5 + texture(stone_filey, vd.positionObject.xz) * stone_4.y + stone_13).xyz;
    vec2 rust = vec2(textureSize(rust_file, 0).xy);
    vec2 rust_2 = vd.texcoord_0 * rust - vec2(0.5);
    vec2 rust_3 = floor(rust_2);
    vec2 rust_4 = fract(rust_2);
    vec2 rust_5 = vec2(0.6666667) - rust_4 * rust_4 * (vec2(1.0) - rust_4 * 0.5);
    vec2 rust_6 = (vec2(1.0) - rust_4) * (vec2(1.0) - rust_4);
    vec2 rust_7 = (rust_3 - vec2(0.5) + rust_5 / (rust_5 + (vec2(1.0) - rust_4) * rust_6 / vec2(6.0))) / rust;
    vec2 rust_8 = floor(rust_7);
    bool rust_9 = rust_8.x >= 0.0 && rust_8.x <= 1.0;
    bool rust_10 = rust_9 && (rust_8.y >= 0.0 && rust_8.y <= 1.0);
    vec3 rust_11 = vec3(fract(rust_7), rust_8.x + rust_8.y * 2.0);
    vec4 rust_12 = rust_10 ? textureGrad(rust_file, rust_11, wall_5, wall_6) : stone_12;
    vec2 rust_13 = rust_4 * (rust_4 * rust_4) / vec2(6.0);
    vec2 rust_14 = vec2(0.6666667) - rust_6 * (vec2(1.0) - (vec2(1.0) - rust_4) * 0.5) + rust_13;
    vec2 rust_15 = (rust_3 + vec2(1.5) + rust_13 / rust_14) / rust;
    vec2 rust_16 = vec2(rust_15.x, rust_7.y);
    vec2 rust_17 = floor(rust_16);
    bool rust_18 = rust_17.x >= 0.0 && rust_17.x <= 1.0;
    bool rust_19 = rust_18 && (rust_17.y >= 0.0 && rust_17.y <= 1.0);
    vec3 rust_20 = vec3(fract(rust_16), rust_17.x + rust_17.y * 2.0);
    vec4 rust_21 = mix(rust_12, rust_19 ? textureGrad(rust_file, rust_20, wall_5, wall_6) : stone_12, rust_14.x);
    vec2 rust_22 = vec2(rust_7.x, rust_15.y);
    vec2 rust_23 = floor(rust_22);
    bool rust_24 = rust_23.x >= 0.0 && rust_23.x <= 1.0;
    bool rust_25 = rust_24 && (rust_23.y >= 0.0 && rust_23.y <= 1.0);
    vec3 rust_26 = vec3(fract(rust_22), rust_23.x + rust_23.y * 2.0);
    vec4 rust_27 = rust_25 ? textureGrad(rust_file, rust_26, wall_5, wall_6) : stone_12;
    vec2 rust_28 = floor(rust_15);
    bool rust_29 = rust_28.x >= 0.0 && rust_28.x <= 1.0;
    bool rust_30 = rust_29 && (rust_28.y >= 0.0 && rust_28.y <= 1.0);
    vec3 rust_31 = vec3(fract(rust_15), rust_28.x + rust_28.y * 2.0);
    float rust_32 = mix(rust_21, mix(rust_27, rust_30 ? textureGrad(rust_file, rust_31, wall_5, wall_6) : stone_12, rust_14.x), rust_14.y).x;
    out1 = vec4(mix(mx_srgb_texture_to_lin_rec709((wall_4 ? wall_7 : vec4(1.0, 0.0, 1.0, 1.0)).xyz), stone_14, rust_32), 1.0);
}
