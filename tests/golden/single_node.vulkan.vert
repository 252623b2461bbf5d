#version 450
// out · output · mxgen 0.1 · vulkan · complete · 0 closures · 0 textures

layout(set = 0, binding = 0, std140) uniform PrivateUniforms {
    mat4 u_worldMatrix;
    mat4 u_viewProjectionMatrix;
};
layout(location = 0) in vec3 i_position;
layout(location = 0) out VertexData {
    vec3 positionWorld;
} vd;

void main()
{
    vec4 positionWorld = u_worldMatrix * vec4(i_position, 1.0);
    vd.positionWorld = positionWorld.xyz;
    gl_Position = u_viewProjectionMatrix * positionWorld;
}
