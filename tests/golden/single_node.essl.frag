#version 300 es
// out · output · mxgen 0.1 · essl · complete · 0 closures · 0 textures
precision highp float;
precision highp int;
precision highp sampler2D;

in vec3 vd_positionWorld;
out vec4 out1;

void main()
{
    out1 = vec4(vd_positionWorld * 0.5, 1.0);
}
