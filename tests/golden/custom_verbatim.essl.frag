#version 300 es
// out · output · mxgen 0.1 · essl · complete · 0 closures · 0 textures
precision highp float;
precision highp int;
precision highp sampler2D;

in vec2 vd_texcoord_0;
out vec4 out1;

void main()
{
    // NG
    float b = intBitsToFloat(floatBitsToInt((uintBitsToFloat(packHalf2x16(vd_texcoord_0 * 1.0)))) >> 1);
    out1 = vec4(b, b, b, 1.0);
}
