#version 450
// out · output · mxgen 0.1 · glsl · complete · 0 closures · 0 textures

uniform vec3 NG_paint = vec3(0.5, 0.25, 0.125);
uniform float NG_size = 10.0;
out vec4 out1;

void main()
{
    // NG
    vec3 scaled = pow(max((NG_paint + vec3(0.055)) / vec3(1.055), 0.0), vec3(2.4));
    out1 = vec4(mix(NG_paint / vec3(12.92), scaled, step(0.04045, NG_paint)) * (NG_size * 0.0254) + vec3(0.5), 1.0);
}
