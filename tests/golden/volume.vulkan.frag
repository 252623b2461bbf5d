#version 450
// Fog · volumematerial · mxgen 0.1 · vulkan · complete · 3 closures · 0 textures

layout(set = 0, binding = 0, std140) uniform PrivateUniforms {
    mat4 u_worldMatrix;
    mat4 u_worldInverseTransposeMatrix;
    mat4 u_viewProjectionMatrix;
    vec3 u_viewPosition;
    int u_numActiveLightSources;
    mat4 u_envMatrix;
    float u_envLightIntensity;
    float u_volumeDepth;
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
    vec2 texcoord_0;
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
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    float volume_depth = u_volumeDepth * max(dot(V, normalize(vd.normalWorld)), 0.0);
    float glow_weight = clamp(vd.texcoord_0.x, 0.0, 1.0);
    float both_weight = 1.0 - glow_weight;
    vec3 optical_depth_sum = both_weight * vec3(0.3, 0.5, 0.9) + both_weight * 1.2;
    vec3 optical_depth = volume_depth * (optical_depth_sum + both_weight * vec3(2.0, 1.0, 0.5));
    vec3 volume_lost = vec3(1.0) - exp(-optical_depth);
    vec3 path_blend = mix(vec3(1.0), volume_lost / max(optical_depth, 0.001), step(vec3(0.001), optical_depth));
    vec3 color = volume_depth * path_blend * (glow_weight * vec3(0.2, 0.06, 0.01));
    // lights
    vec3 smoke_factor = path_blend * (both_weight * volume_depth * 1.2);
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
        // smoke
        float smoke_d = dot(V, L) * 0.8 + 1.16;
        color += u_lightData[i].color * (intensity * (0.84 / (smoke_d * 12.566371 * sqrt(smoke_d)) * smoke_factor));
    }
    // environment: smoke
    if (both_weight > 0.0) {
        vec3 environment_irradiance = textureLod(u_envIrradiance, mx_map_point(normalize(mat3(u_envMatrix) * -V)),
            0.0).xyz * u_envLightIntensity;
        vec3 smoke_blend = mix(environment_irradiance,
            u_envLightIntensity * textureLod(u_envIrradiance, mx_map_point(normalize(mat3(u_envMatrix) * V)), 0.0).xyz,
            0.2);
        color += path_blend * (both_weight * volume_depth) * smoke_blend * 1.2;
    }
    out1 = vec4(color, dot(volume_lost, vec3(0.33333334)));
}
