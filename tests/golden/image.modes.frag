#version 450
// out · output · mxgen 0.1 · glsl · complete · 0 closures · 3 textures

uniform sampler2D NG_file;
uniform sampler2D framed_file;
uniform sampler2D tiled_file;
in VertexData {
    vec2 texcoord_0;
} vd;
out vec4 out1;

vec4 mx_image(sampler2D file, const vec2 texcoord)
{
    vec2 uv = texcoord;
    uv = vec2(uv.x, uv.y);
    vec4 texel = texture(file, uv);
    return false || false ? vec4(0.0, 0.0, 0.0, 1.0) : texel;
}

vec3 mx_srgb_texture_to_lin_rec709(const vec3 color)
{
    return mix(color / vec3(12.92), pow(max((color + vec3(0.055)) / vec3(1.055), vec3(0.0)), vec3(2.4)), step(0.04045, color));
}

float mx_address(const float x, const int size)
{
    float border = 0.5 / float(size);
    return clamp(x, border, 1.0 - border);
}

float mx_address_2(const float x, const int size)
{
    float border = 0.5 / float(size);
    return clamp(1.0 - abs(mod(x, 2.0) - 1.0), border, 1.0 - border);
}

vec4 mx_image_2(sampler2D file, const vec2 texcoord)
{
    vec2 uv = texcoord;
    ivec2 size = textureSize(file, 0);
    uv = vec2(mx_address(uv.x, size.x), mx_address_2(uv.y, size.y));
    vec4 texel = texture(file, uv);
    return texcoord.x < 0.0 || texcoord.x > 1.0 || false ? vec4(1.0, 0.0, 1.0, 1.0) : texel;
}

void main()
{
    // NG
    vec3 base = mx_srgb_texture_to_lin_rec709(mx_image(NG_file, vd.texcoord_0).xyz);
    vec3 tiled = mx_srgb_texture_to_lin_rec709(texture(tiled_file, vd.texcoord_0 * vec2(4.0, 2.0)).xyz);
    out1 = vec4(base * mx_image_2(framed_file, vd.texcoord_0).xyz + tiled, 1.0);
}
