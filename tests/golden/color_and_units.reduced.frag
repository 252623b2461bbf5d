#version 450
// out · output · mxgen 0.1 · glsl · reduced · 0 closures · 0 textures

out vec4 out1;

void main()
{
    out1 = vec4(0.55436647, 0.5129225, 0.5036449, 1.0);
}
