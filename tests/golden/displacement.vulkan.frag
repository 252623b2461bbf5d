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

// atan(t) over pi for |t| <= 1, within 2.6e-5; the built-in function takes thrice as long.
float mx_half_turn(const float t)
{
    float t2 = t * t;
    return t * (0.3180596 + t2 * (t2 * (0.0465574 - 0.0124098 * t2) - 0.1022332));
}

// The point of the picture for a unit direction in it, to a tenth of a texel in 4096.
vec2 mx_map_point(const vec3 d)
{
    float radius = length(d.xz);
    float turn = mx_half_turn(d.x / max(abs(d.z) + radius, 1e-8));
    return vec2(fract(d.z > 0.0 ? -turn : 0.5 + turn), 0.5 - 2.0 * mx_half_turn(d.y / (1.0 + radius)));
}

void main()
{
    vec3 color = vec3(0.0);
    // environment
    // bsdf
    vec3 direction = normalize(vd.normalWorld);
    float both = texture(height_file, vd.texcoord_0).x * mx_line(vd.texcoord_0);
    vec3 D1_sum = normalize(vd.tangentWorld) * 0.1 + direction * both;
    vec3 P_sum = mix(D1_sum, direction * (both * 0.5), 0.25) + vd.positionWorld;
    vec3 facet_direction = normalize(cross(dFdx(P_sum), dFdy(P_sum)));
    vec3 facet_facing = faceforward(facet_direction, -direction, facet_direction);
    vec3 facet_direction_2 = normalize(cross(dFdx(vd.positionWorld), dFdy(vd.positionWorld)));
    vec3 N = normalize(direction + (facet_facing - faceforward(facet_direction_2, -direction, facet_direction_2)));
    color += textureLod(u_envIrradiance,
        mx_map_point(normalize((u_envMatrix * vec4(faceforward(N, -normalize(u_viewPosition - P_sum), N), 0.0)).xyz)),
        0.0).xyz * (u_envLightIntensity * 0.18);
    out1 = vec4(color, 1.0);
}
