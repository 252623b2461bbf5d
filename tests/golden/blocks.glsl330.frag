#version 330
// out · output · mxgen 0.1 · glsl · complete · 0 closures · 0 textures

uniform vec3 NG_c3 = vec3(1.0, 2.0, 3.0);
uniform mat3 NG_m3 = mat3(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0);
uniform int NG_i = 7;
uniform bool NG_b = true;
uniform vec2 NG_v2 = vec2(1.0, 2.0);
uniform float NG_f = 1.0;
uniform float NG_g = 2.0;
uniform vec4 NG_v4 = vec4(1.0, 2.0, 3.0, 4.0);
out vec4 out1;

void main()
{
    out1 = vec4(NG_m3 * NG_c3 * (NG_g - (NG_f - (float(NG_i) + float(NG_b) + NG_v2.x))), 1.0) + NG_v4;
}
