#version 450
// out · output · mxgen 0.1 · glsl · reduced · 0 closures · 0 textures

in VertexData {
    vec2 texcoord_0;
} vd;
out vec4 out1;

void main()
{
    // NG
    vec2 cell = floor(vd.texcoord_0 * 8.0);
    vec3 board = vec3(mod(cell.x + cell.y, 2.0));
    out1 = vec4(vd.texcoord_0.x > 0.5 ? board : vec3(1.0, 0.0, 0.0), 1.0);
}
