#version 450
// mxgen 0.1 · glsl · complete · 0 closures · 0 textures

uniform float u_0;
uniform float u_1;
uniform float u_2;
out vec4 out1;

void main()
{
    float v = cos(sin(u_0)) + u_1;
    float v_2 = (v + u_2) / v;
    out1 = vec4(v_2, v_2, v_2, 1.0);
}
