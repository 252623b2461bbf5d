#version 450
// out · output · mxgen 0.1 · glsl · complete · 0 closures · 3 textures

uniform sampler2D NG_file;
uniform sampler2D framed_file;
uniform sampler2D tiled_file;
in VertexData {
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
    ivec2 size = textureSize(framed_file, 0);
    float address = clamp(vd.texcoord_0.x, 0.5 / float(size.x), 1.0 - 0.5 / float(size.x));
    float mirrored = 1.0 - abs(mod(vd.texcoord_0.y, 2.0) - 1.0);
    vec4 image = texture(framed_file, vec2(address, clamp(mirrored, 0.5 / float(size.y), 1.0 - 0.5 / float(size.y))));
    vec3 framed = vd.texcoord_0.x < 0.0 || vd.texcoord_0.x > 1.0 ? vec3(1.0, 0.0, 1.0) : image.xyz;
    vec3 tiled = mx_srgb_texture_to_lin_rec709(texture(tiled_file, vd.texcoord_0 * vec2(4.0, 2.0)).xyz);
    out1 = vec4(mx_srgb_texture_to_lin_rec709(texture(NG_file, vd.texcoord_0).xyz) * framed + tiled, 1.0);
}
