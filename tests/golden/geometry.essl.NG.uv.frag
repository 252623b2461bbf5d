#version 300 es
// uv · output · mxgen 0.1 · essl · complete · 0 closures · 0 textures
precision highp float;
precision highp int;
precision highp sampler2D;

in vec2 vd_texcoord_1;
out vec4 out1;

void main()
{
    out1 = vec4(vd_texcoord_1, 0.0, 1.0);
}
