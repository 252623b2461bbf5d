#version 450
// out · output · mxgen 0.1 · glsl · complete · 0 closures · 0 textures

uniform mat4 u_worldMatrix = mat4(1.0);
uniform mat4 u_viewProjectionMatrix = mat4(1.0);
in vec3 i_position;
out VertexData {
    vec3 positionWorld;
} vd;

void main()
{
    vec4 positionWorld = u_worldMatrix * vec4(i_position, 1.0);
    vd.positionWorld = positionWorld.xyz;
    gl_Position = u_viewProjectionMatrix * positionWorld;
}
