#version 300 es
// uv · output · mxgen 0.1 · essl · complete · 0 closures · 0 textures

uniform mat4 u_worldMatrix;
uniform mat4 u_viewProjectionMatrix;
in vec3 i_position;
in vec2 i_texcoord_1;
out vec2 vd_texcoord_1;

void main()
{
    vd_texcoord_1 = i_texcoord_1;
    gl_Position = u_viewProjectionMatrix * (u_worldMatrix * vec4(i_position, 1.0));
}
