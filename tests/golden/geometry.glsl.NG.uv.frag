#version 450
// uv · output · mxgen 0.1 · glsl · complete · 0 closures · 0 textures

in VertexData {
    vec2 texcoord_1;
} vd;
out vec4 out1;

void main()
{
    out1 = vec4(vd.texcoord_1, 0.0, 1.0);
}
