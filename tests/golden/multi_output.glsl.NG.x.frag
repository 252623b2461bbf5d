#version 450
// x · output · mxgen 0.1 · glsl · reduced · 0 closures · 0 textures

in VertexData {
    vec2 texcoord_0;
} vd;
out vec4 out1;

void main()
{
    out1 = vec4(vd.texcoord_0.xxx, 1.0);
}
