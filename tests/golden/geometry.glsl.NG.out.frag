#version 450
// out · output · mxgen 0.1 · glsl · complete · 0 closures · 0 textures

uniform vec3 u_viewPosition = vec3(0.0);
uniform float u_time = 0.0;
in VertexData {
    vec3 positionWorld;
    vec3 normalObject;
    vec3 tangentObject;
    vec4 color_0;
    float geomprop_wear;
    flat int geomprop_part;
} vd;
out vec4 out1;

void main()
{
    // NG
    vec3 v = normalize(vd.positionWorld - u_viewPosition);
    float facing = dot(normalize(vd.normalObject), v);
    out1 = vec4(facing, dot(v, normalize(vd.tangentObject)), vd.geomprop_wear, float(vd.geomprop_part)) * vd.color_0
        * u_time;
}
