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
    vec3 c = vec3(atan(vd_texcoord_0.y, vd_texcoord_0.x), length(vd_texcoord_0), 0.0);
    out1 = vec4(mix(c, c * vec3(1.0, 0.9, 0.7), 0.25), 1.0);
}
