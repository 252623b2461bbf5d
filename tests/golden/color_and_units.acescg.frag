#version 450
// out · output · mxgen 0.1 · glsl · reduced · 0 closures · 0 textures

out vec4 out1;

void main()
{
    out1 = vec4(0.5378921, 0.51570684, 0.505707, 1.0);
}
