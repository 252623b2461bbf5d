#version 300 es
// out · output · mxgen 0.1 · essl · complete · 0 closures · 0 textures

uniform mat4 u_worldMatrix;
uniform mat4 u_viewProjectionMatrix;
in vec3 i_position;
out vec3 vd_positionWorld;

void main()
{
    vec4 positionWorld = u_worldMatrix * vec4(i_position, 1.0);
    vd_positionWorld = positionWorld.xyz;
    gl_Position = u_viewProjectionMatrix * positionWorld;
}
