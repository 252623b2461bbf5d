#version 450
// out · output · mxgen 0.1 · glsl · complete · 0 closures · 0 textures

uniform vec3 NG_paint = vec3(0.5, 0.25, 0.125);
uniform float NG_size = 10.0;
out vec4 out1;

// IEC 61966-2-1
vec3 mx_srgb_texture_to_lin_rec709(const vec3 color)
{
    return mix(color / vec3(12.92), pow(max((color + vec3(0.055)) / vec3(1.055), vec3(0.0)), vec3(2.4)),
        step(0.04045, color));
}

void main()
{
    out1 = vec4(mx_srgb_texture_to_lin_rec709(NG_paint) * (NG_size * 0.0254) + vec3(0.5), 1.0);
}
