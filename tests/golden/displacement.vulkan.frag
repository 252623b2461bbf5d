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
layout(set = 0, binding = 4) uniform sampler2D u_envIrradiance;
layout(location = 0) in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
    vec3 tangentWorld;
    vec2 texcoord_0;
} vd;
layout(location = 0) out vec4 out1;

float mx_line(const vec2 p)
{
    vec2 from = p - vec2(0.25);
    return distance(from, vec2(0.5) * clamp(dot(from, vec2(0.5)) / 0.5, 0.0, 1.0)) > 0.1 ? 0.0 : 1.0;
}

vec2 mx_latlong(const mat4 map, const vec3 direction)
{
    vec3 d = normalize((map * vec4(direction, 0.0)).xyz);
    return vec2(atan(d.x, -d.z), -2.0 * asin(clamp(d.y, -1.0, 1.0))) * 0.15915494 + vec2(0.5);
}

void main()
{
    vec3 color = vec3(0.0);
    vec3 normal = normalize(vd.normalWorld);
    float both = texture(height_file, vd.texcoord_0).x * mx_line(vd.texcoord_0);
    vec3 D1 = normalize(vd.tangentWorld) * 0.1 + normal * both;
    vec3 P = mix(D1, normal * (both * 0.5), 0.25) + vd.positionWorld;
    vec3 facet = normalize(cross(dFdx(P), dFdy(P)));
    vec3 facet_2 = faceforward(facet, -normal, facet);
    vec3 facet_3 = normalize(cross(dFdx(vd.positionWorld), dFdy(vd.positionWorld)));
    vec3 N = normalize(normal + (facet_2 - faceforward(facet_3, -normal, facet_3)));
    color += textureLod(u_envIrradiance, mx_latlong(u_envMatrix, faceforward(N, -normalize(u_viewPosition - P), N)), 0.0).xyz * (u_envLightIntensity * 0.18);
    out1 = vec4(color, 1.0);
}
