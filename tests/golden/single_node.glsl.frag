#version 450
// out · output · mxgen 0.1 · glsl · complete · 0 closures · 0 textures

in VertexData {
    vec3 positionWorld;
} vd;
out vec4 out1;

void main()
{
    out1 = vec4(vd.positionWorld * 0.5, 1.0);
}
