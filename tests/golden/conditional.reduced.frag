#version 450
// out · output · mxgen 0.1 · glsl · reduced · 0 closures · 0 textures

in VertexData {
    vec2 texcoord_0;
} vd;
out vec4 out1;

void main()
{
    // NG/board
    vec2 board = floor(vd.texcoord_0 * vec2(8.0));
    // NG/side
    vec3 side = vd.texcoord_0.x > 0.5 ? vec3(mod(board.x + board.y, 2.0)) : vec3(1.0, 0.0, 0.0);
    out1 = vec4(side, 1.0);
}
