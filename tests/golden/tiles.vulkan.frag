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
    float stone[6] = float[6](0.0, 1.0, -1.0, -1.0, -1.0, 2.0);
    float wall_2 = stone[int(clamp(wall.x + wall.y * 3.0, 0.0, 5.0))];
    bool wall_3 = wall.x >= 0.0 && wall.x <= 2.0 && (wall.y >= 0.0 && wall.y <= 1.0) && wall_2 >= 0.0;
    vec2 wall_4 = dFdx(vd.texcoord_0);
    vec2 wall_5 = dFdy(vd.texcoord_0);
    vec4 wall_6 = textureGrad(wall_file, vec3(fract(vd.texcoord_0), wall_2), wall_4, wall_5);
    vec3 stone_2 = abs(normalize(vd.normalObject));
    vec3 stone_3 = stone_2 / dot(stone_2, vec3(1.0));
    vec3 stone_4 = stone_3 / dot(stone_3, vec3(1.0));
    vec4 stone_5 = texture(stone_filex, vd.positionObject.yz) * stone_4.x;
    vec2 stone_6 = floor(vd.positionObject.xy);
    float stone_7 = stone[int(clamp(stone_6.x + stone_6.y * 3.0, 0.0, 5.0))];
    bool stone_8 = stone_6.x >= 0.0 && stone_6.x <= 2.0 && (stone_6.y >= 0.0 && stone_6.y <= 1.0) && stone_7 >= 0.0;
    vec2 stone_9 = dFdx(vd.positionObject.xy);
    vec2 stone_10 = dFdy(vd.positionObject.xy);
    const vec4 stone_11 = vec4(0.0, 0.0, 0.0, 1.0);
    vec4 stone_12 = (stone_8 ? textureGrad(stone_filez, vec3(fract(vd.positionObject.xy), stone_7), stone_9, stone_10) : stone_11) * stone_4.z;
    vec3 stone_13 = (stone_5 + texture(stone_filey, vd.positionObject.xz) * stone_4.y + stone_12).xyz;
    vec2 rust = vec2(textureSize(rust_file, 0).xy);
    vec2 rust_2 = vd.texcoord_0 * rust - vec2(0.5);
    vec2 rust_3 = floor(rust_2);
    vec2 rust_4 = fract(rust_2);
    vec2 rust_5 = vec2(0.6666667) - rust_4 * rust_4 * (vec2(1.0) - rust_4 * 0.5);
    vec2 rust_6 = (vec2(1.0) - rust_4) * (vec2(1.0) - rust_4);
    vec2 rust_7 = (rust_3 - vec2(0.5) + rust_5 / (rust_5 + (vec2(1.0) - rust_4) * rust_6 / vec2(6.0))) / rust;
    vec2 rust_8 = floor(rust_7);
    vec4 rust_9 = textureGrad(rust_file, vec3(fract(rust_7), rust_8.x + rust_8.y * 2.0), wall_4, wall_5);
    vec4 rust_10 = rust_8.x >= 0.0 && rust_8.x <= 1.0 && (rust_8.y >= 0.0 && rust_8.y <= 1.0) ? rust_9 : stone_11;
    vec2 rust_11 = rust_4 * (rust_4 * rust_4) / vec2(6.0);
    vec2 rust_12 = vec2(0.6666667) - rust_6 * (vec2(1.0) - (vec2(1.0) - rust_4) * 0.5) + rust_11;
    vec2 rust_13 = (rust_3 + vec2(1.5) + rust_11 / rust_12) / rust;
    vec2 rust_14 = vec2(rust_13.x, rust_7.y);
    vec2 rust_15 = floor(rust_14);
    vec4 rust_16 = textureGrad(rust_file, vec3(fract(rust_14), rust_15.x + rust_15.y * 2.0), wall_4, wall_5);
    vec4 rust_17 = mix(rust_10, rust_15.x >= 0.0 && rust_15.x <= 1.0 && (rust_15.y >= 0.0 && rust_15.y <= 1.0) ? rust_16 : stone_11, rust_12.x);
    vec2 rust_18 = vec2(rust_7.x, rust_13.y);
    vec2 rust_19 = floor(rust_18);
    vec4 rust_20 = textureGrad(rust_file, vec3(fract(rust_18), rust_19.x + rust_19.y * 2.0), wall_4, wall_5);
    vec4 rust_21 = rust_19.x >= 0.0 && rust_19.x <= 1.0 && (rust_19.y >= 0.0 && rust_19.y <= 1.0) ? rust_20 : stone_11;
    vec2 rust_22 = floor(rust_13);
    vec4 rust_23 = textureGrad(rust_file, vec3(fract(rust_13), rust_22.x + rust_22.y * 2.0), wall_4, wall_5);
    float rust_24 = mix(rust_17, mix(rust_21, rust_22.x >= 0.0 && rust_22.x <= 1.0 && (rust_22.y >= 0.0 && rust_22.y <= 1.0) ? rust_23 : stone_11, rust_12.x), rust_12.y).x;
    out1 = vec4(mix(mx_srgb_texture_to_lin_rec709((wall_3 ? wall_6 : vec4(1.0, 0.0, 1.0, 1.0)).xyz), stone_13, rust_24), 1.0);
}
