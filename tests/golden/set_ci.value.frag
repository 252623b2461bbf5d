#version 450
// colored · osl_set_ci · mxgen 0.1 · glsl · complete · 0 closures · 0 textures

uniform vec4 colored_input_color4 = vec4(1.0, 0.5, 0.0, 0.5);
out vec4 out1;

void main()
{
    out1 = colored_input_color4;
}
