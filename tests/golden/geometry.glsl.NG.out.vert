#version 450
// out · output · mxgen 0.1 · glsl · complete · 0 closures · 0 textures

uniform mat4 u_worldMatrix = mat4(1.0);
uniform mat4 u_viewProjectionMatrix = mat4(1.0);
in vec3 i_position;
in vec3 i_normal;
in vec3 i_tangent;
in vec4 i_color_0;
in float i_geomprop_wear;
in int i_geomprop_part;
out VertexData {
    vec3 positionWorld;
    vec3 normalObject;
    vec3 tangentObject;
    vec4 color_0;
    float geomprop_wear;
    flat int geomprop_part;
} vd;

void main()
{
    vd.normalObject = i_normal;
    vec4 positionWorld = u_worldMatrix * vec4(i_position, 1.0);
    vd.positionWorld = positionWorld.xyz;
    vd.tangentObject = i_tangent;
    vd.geomprop_wear = i_geomprop_wear;
    vd.geomprop_part = i_geomprop_part;
    vd.color_0 = i_color_0;
    gl_Position = u_viewProjectionMatrix * positionWorld;
}
