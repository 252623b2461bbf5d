#version 450
// Clay · surfacematerial · mxgen 0.1 · vulkan · reduced · 1 closure · 0 textures

layout(set = 0, binding = 0, std140) uniform PrivateUniforms {
    mat4 u_worldMatrix;
    mat4 u_worldInverseTransposeMatrix;
    mat4 u_viewProjectionMatrix;
    vec3 u_viewPosition;
    int u_numActiveLightSources;
    mat4 u_envMatrix;
    float u_envLightIntensity;
};
struct LightData {
    int type;
    vec3 direction;
    vec3 color;
    float intensity;
    vec3 position;
    float decay_rate;
    float inner_angle;
    float outer_angle;
};
layout(set = 0, binding = 2, std140) uniform LightData_block { LightData u_lightData[3]; };
layout(set = 0, binding = 3) uniform sampler2D u_envIrradiance;
layout(location = 0) in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
} vd;
layout(location = 0) out vec4 out1;

// The angle, over pi, with this sine and cosine; the cosine is not negative. It errs by 2.9e-5 at most.
float mx_half_turn(const float sine, const float cosine)
{
    return sine * (0.4999709 + cosine * (cosine * (0.2302802 + cosine * (0.0398298 * cosine - 0.1351235)) - 0.3164252));
}

// The square of the distance of the unit direction d from the vertical axis, never 0.
float mx_map_square(const vec3 d)
{
    return d.x * d.x + (d.z * d.z + 1e-16);
}

// The point of the latitude-longitude picture for the unit direction d, to a tenth of a texel in 4096.
vec2 mx_map_point(const vec3 d)
{
    float square = mx_map_square(d);
    float stretch = inversesqrt(square);
    return vec2(fract((d.z > 0.0 ? -0.5 : 0.5) * (mx_half_turn(d.x * stretch, abs(d.z) * stretch) + 0.5) + 0.25),
        0.5 - mx_half_turn(d.y, square * stretch));
}

void main()
{
    vec3 color = vec3(0.0);
    // lights
    vec3 axis = normalize(vd.normalWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    // SR_clay
    vec3 facing = faceforward(axis, -V, axis);
    float cos_v = max(abs(dot(axis, V)), 1e-8);
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        vec3 L;
        float intensity;
        int light_type = u_lightData[i].type;
        if (light_type == 1) {
            L = -u_lightData[i].direction;
            intensity = u_lightData[i].intensity;
        } else {
            vec3 d = u_lightData[i].position - vd.positionWorld;
            vec3 to_light = normalize(d);
            L = to_light;
            float falloff = u_lightData[i].intensity / pow(length(d) + 1.0, u_lightData[i].decay_rate);
            if (light_type == 2) {
                intensity = falloff;
            } else {
                float edge = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
                intensity = light_type == 3
                    ? smoothstep(edge, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, to_light)) * falloff
                    : 0.0;
            }
        }
        // diffuse
        float cos_l = max(dot(L, facing), 1e-8);
        float diffuse_sum = max(dot(L, V) - cos_l * cos_v, 0.0) * 0.36 / max(cos_l, cos_v) + 0.73913044;
        color += u_lightData[i].color * (intensity * (cos_l * 0.31830987 * vec3(0.5, 0.25, 0.15) * diffuse_sum));
    }
    // environment: diffuse
    vec2 fit = (cos_v * vec2(-0.7632, -0.4993) - vec2(0.4297, 0.6076) + vec2(0.8631, 1.2189)) * 0.6 + vec2(1.0);
    vec3 environment_irradiance = textureLod(u_envIrradiance, mx_map_point(normalize(mat3(u_envMatrix) * facing)),
        0.0).xyz * u_envLightIntensity;
    color += clamp(fit.x / fit.y, 0.0, 1.0) * vec3(0.5, 0.25, 0.15) * environment_irradiance;
    out1 = vec4(color, 1.0);
}
