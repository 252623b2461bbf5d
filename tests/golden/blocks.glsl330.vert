#version 330
// out · output · mxgen 0.1 · glsl · complete · 0 closures · 0 textures

uniform mat4 u_worldMatrix = mat4(1.0);
uniform mat4 u_viewProjectionMatrix = mat4(1.0);
in vec3 i_position;

void main()
{
    gl_Position = u_viewProjectionMatrix * (u_worldMatrix * vec4(i_position, 1.0));
}
