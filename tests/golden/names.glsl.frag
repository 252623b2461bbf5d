#version 450
// out · output · mxgen 0.1 · glsl · complete · 0 closures · 0 textures

uniform float texture_in = 1.0;
uniform float texture_gl_x = 2.0;
uniform float texture_a_b = 3.0;
out vec4 out1;

void main()
{
    // texture
    float vd_2 = cos(sin(texture_in)) + texture_gl_x;
    float normal = (vd_2 + texture_a_b) / vd_2;
    out1 = vec4(normal, normal, normal, 1.0);
}
