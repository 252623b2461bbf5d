#version 450
// o · output · mxgen 0.1 · vulkan · complete · 0 closures · 0 textures

layout(set = 0, binding = 0, std140) uniform PrivateUniforms {
    mat4 u_worldMatrix;
    mat4 u_viewProjectionMatrix;
};
layout(location = 0) in vec3 i_position;
layout(location = 1) in vec2 i_texcoord_0;
layout(location = 0) out VertexData {
    vec2 texcoord_0;
} vd;

void main()
{
    vd.texcoord_0 = i_texcoord_0;
    gl_Position = u_viewProjectionMatrix * (u_worldMatrix * vec4(i_position, 1.0));
}
