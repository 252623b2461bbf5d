#version 300 es
// out · output · mxgen 0.1 · essl · complete · 0 closures · 0 textures
precision highp float;
precision highp int;
precision highp sampler2D;

uniform vec3 u_viewPosition;
uniform float u_time;
in vec3 vd_positionWorld;
in vec3 vd_normalObject;
in vec3 vd_tangentObject;
in vec4 vd_color_0;
in float vd_geomprop_wear;
flat in int vd_geomprop_part;
out vec4 out1;

void main()
{
    // NG
    vec3 v = normalize(vd_positionWorld - u_viewPosition);
    float facing = dot(normalize(vd_normalObject), v);
    out1 = vec4(facing, dot(v, normalize(vd_tangentObject)), vd_geomprop_wear, float(vd_geomprop_part)) * vd_color_0
        * u_time;
}
