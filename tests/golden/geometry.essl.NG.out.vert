#version 300 es
// out · output · mxgen 0.1 · essl · complete · 0 closures · 0 textures

uniform mat4 u_worldMatrix;
uniform mat4 u_viewProjectionMatrix;
in vec3 i_position;
in vec3 i_normal;
in vec3 i_tangent;
in vec4 i_color_0;
in float i_geomprop_wear;
in int i_geomprop_part;
out vec3 vd_positionWorld;
out vec3 vd_normalObject;
out vec3 vd_tangentObject;
out vec4 vd_color_0;
out float vd_geomprop_wear;
flat out int vd_geomprop_part;

void main()
{
    vd_normalObject = i_normal;
    vec4 positionWorld = u_worldMatrix * vec4(i_position, 1.0);
    vd_positionWorld = positionWorld.xyz;
    vd_tangentObject = i_tangent;
    vd_geomprop_wear = i_geomprop_wear;
    vd_geomprop_part = i_geomprop_part;
    vd_color_0 = i_color_0;
    gl_Position = u_viewProjectionMatrix * positionWorld;
}
