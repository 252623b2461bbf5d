#version 450
// out · output · mxgen 0.1 · glsl · complete · 0 closures · 3 textures

uniform sampler2D NG_file;
uniform sampler2D framed_file;
uniform sampler2D tiled_file;
in VertexData {
    vec2 texcoord_0;
} vd;
out vec4 out1;

float mx_address(const float x, const int size)
{
    float mirrored = x;
    float border = 0.5 / float(size);
    return clamp(mirrored, border, 1.0 - border);
}

float mx_address_2(const float x, const int size)
{
    float mirrored = 1.0 - abs(mod(x, 2.0) - 1.0);
    float border = 0.5 / float(size);
    return clamp(mirrored, border, 1.0 - border);
}

vec4 mx_image(sampler2D file, const vec2 texcoord)
{
    ivec2 size = textureSize(file, 0);
    vec2 uv = vec2(mx_address(texcoord.x, size.x), mx_address_2(texcoord.y, size.y));
    vec4 texel = texture(file, uv);
    return texcoord.x < 0.0 || texcoord.x > 1.0 ? vec4(1.0, 0.0, 1.0, 1.0) : texel;
}

void main()
{
    // NG/base
    vec4 base = texture(NG_file, vd.texcoord_0);
    float base_2 = base.x > 0.04045 ? pow((base.x + 0.055) / 1.055, 2.4) : base.x / 12.92;
    float base_3 = base.y > 0.04045 ? pow((base.y + 0.055) / 1.055, 2.4) : base.y / 12.92;
    float base_4 = base.z > 0.04045 ? pow((base.z + 0.055) / 1.055, 2.4) : base.z / 12.92;
    // NG/masked
    vec3 masked = vec3(base_2, base_3, base_4) * mx_image(framed_file, vd.texcoord_0).xyz;
    // NG/tiled
    vec4 tiled = texture(tiled_file, vd.texcoord_0 * vec2(4.0, 2.0));
    float tiled_2 = tiled.x > 0.04045 ? pow((tiled.x + 0.055) / 1.055, 2.4) : tiled.x / 12.92;
    float tiled_3 = tiled.y > 0.04045 ? pow((tiled.y + 0.055) / 1.055, 2.4) : tiled.y / 12.92;
    float tiled_4 = tiled.z > 0.04045 ? pow((tiled.z + 0.055) / 1.055, 2.4) : tiled.z / 12.92;
    out1 = vec4(masked + vec3(tiled_2, tiled_3, tiled_4), 1.0);
}
