#version 450
// shown · osl_set_ci · mxgen 0.1 · glsl · complete · 1 closure · 0 textures

out vec4 out1;

void main()
{
    out1 = vec4(1.0);
}
