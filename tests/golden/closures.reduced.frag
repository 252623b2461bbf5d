#version 450
// Varnish · surfacematerial · mxgen 0.1 · glsl · reduced · 0 closures · 0 textures

out vec4 out1;

void main()
{
    out1 = vec4(0.0, 0.0, 0.0, 1.0);
}
