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

vec3 mx_srgb_texture_to_lin_rec709(const vec3 color)
{
    return mix(color / vec3(12.92), pow(max((color + vec3(0.055)) / vec3(1.055), vec3(0.0)), vec3(2.4)), step(0.04045, color));
}

void main()
{
    // NG
    vec2 wall = floor(vd.texcoord_0);
    bool wall_2 = wall.y >= 0.0 && wall.y <= 1.0;
    float stone[6] = float[6](0.0, 1.0, -1.0, -1.0, -1.0, 2.0);
    float wall_3 = stone[int(clamp(wall.x + wall.y * 3.0, 0.0, 5.0))];
    bool wall_4 = wall.x >= 0.0 && wall.x <= 2.0 && wall_2 && wall_3 >= 0.0;
    vec2 wall_5 = fract(vd.texcoord_0);
    vec2 wall_6 = dFdx(vd.texcoord_0);
    vec2 wall_7 = dFdy(vd.texcoord_0);
    vec4 wall_8 = textureGrad(wall_file, vec3(wall_5, wall_3), wall_6, wall_7);
    vec3 wall_9 = mx_srgb_texture_to_lin_rec709((wall_4 ? wall_8 : vec4(1.0, 0.0, 1.0, 1.0)).xyz);
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
    vec4 stone_12 = textureGrad(stone_filez, vec3(fract(vd.positionObject.xy), stone_8), stone_10, stone_11);
    vec4 stone_13 = (stone_9 ? stone_12 : vec4(0.0, 0.0, 0.0, 1.0)) * stone_4.z;
    vec3 stone_14 = (stone_5 + texture(stone_filey, vd.positionObject.xz) * stone_4.y + stone_13).xyz;
    bool rust = wall_2 && (wall.x >= 0.0 && wall.x <= 1.0);
    vec3 rust_2 = vec3(wall_5, wall.x + wall.y * 2.0);
    vec4 rust_3 = textureGrad(rust_file, rust_2, wall_6, wall_7);
    out1 = vec4(mix(wall_9, stone_14, (rust ? rust_3 : vec4(0.0, 0.0, 0.0, 1.0)).x), 1.0);
}
