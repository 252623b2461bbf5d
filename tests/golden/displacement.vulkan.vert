#version 450
// Moved · surfacematerial · mxgen 0.1 · vulkan · reduced · 1 closure · 1 texture

layout(set = 0, binding = 0, std140) uniform PrivateUniforms {
    mat4 u_worldMatrix;
    mat4 u_worldInverseTransposeMatrix;
    mat4 u_viewProjectionMatrix;
    vec3 u_viewPosition;
    mat4 u_envMatrix;
    float u_envLightIntensity;
};
layout(set = 0, binding = 3) uniform sampler2D height_file;
layout(location = 0) in vec3 i_position;
layout(location = 1) in vec3 i_normal;
layout(location = 2) in vec3 i_tangent;
layout(location = 3) in vec2 i_texcoord_0;
layout(location = 0) out VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
    vec3 tangentWorld;
    vec2 texcoord_0;
} vd;

// 1 on a line of this radius between two points, 0 beside it.
// Here radius = 0.1, point1 = vec2(0.25), point2 = vec2(0.75).
float mx_line(const vec2 p)
{
    vec2 from = p - vec2(0.25);
    return distance(from, vec2(0.5) * clamp(dot(from, vec2(0.5)) / 0.5, 0.0, 1.0)) > 0.1 ? 0.0 : 1.0;
}

void main()
{
    vec3 normalWorld = normalize((u_worldInverseTransposeMatrix * vec4(i_normal, 0.0)).xyz);
    vd.normalWorld = normalWorld;
    vd.texcoord_0 = i_texcoord_0;
    vec3 tangentWorld = normalize((u_worldMatrix * vec4(i_tangent, 0.0)).xyz);
    vd.tangentWorld = tangentWorld;
    vec3 positionWorld = (u_worldMatrix * vec4(i_position, 1.0)).xyz;
    vd.positionWorld = positionWorld;
    float both = textureLod(height_file, i_texcoord_0, 0.0).x * mx_line(i_texcoord_0);
    vec3 displacement = tangentWorld * 0.1 + normalWorld * both;
    gl_Position = u_viewProjectionMatrix
        * vec4(positionWorld + mix(displacement, normalWorld * (both * 0.5), 0.25), 1.0);
}
