#version 450
// out · output · mxgen 0.1 · glsl · reduced · 0 closures · 0 textures

out vec4 out1;

void main()
{
    out1 = vec4(5.936645, 1.7922527, 0.8644869, 1.0);
}
