#version 300 es
// Clay · surfacematerial · mxgen 0.1 · essl · reduced · 1 closure · 0 textures
precision highp float;
precision highp int;
precision highp sampler2D;

uniform vec3 u_viewPosition;
uniform int u_numActiveLightSources;
uniform mat4 u_envMatrix;
uniform float u_envLightIntensity;
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
uniform LightData u_lightData[3];
uniform sampler2D u_envIrradiance;
in vec3 vd_positionWorld;
in vec3 vd_normalWorld;
out vec4 out1;

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
    // lights
    vec3 direction = normalize(vd_normalWorld);
    vec3 V = normalize(u_viewPosition - vd_positionWorld);
    // SR_clay
    vec3 N = faceforward(direction, -V, direction);
    float cos_v = max(abs(dot(direction, V)), 1e-8);
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        // diffuse
        int type = u_lightData[i].type;
        vec3 d = u_lightData[i].position - vd_positionWorld;
        float ratio = u_lightData[i].intensity / pow(length(d) + 1.0, u_lightData[i].decay_rate);
        float spot_light_difference = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
        vec3 to_light = normalize(d);
        float spot_light_choice = type == 3
            ? smoothstep(spot_light_difference, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, to_light))
            * ratio : 0.0;
        float point_light_choice = type == 2 ? ratio : spot_light_choice;
        vec3 L = type == 1 ? -u_lightData[i].direction : to_light;
        float cos_l = max(dot(L, N), 1e-8);
        float diffuse_sum = max(dot(L, V) - cos_l * cos_v, 0.0) * 0.36 / max(cos_l, cos_v) + 0.73913044;
        vec3 diffuse_product = u_lightData[i].color * (cos_l / 3.1415927 * vec3(0.5, 0.25, 0.15) * diffuse_sum);
        color += (type == 1 ? u_lightData[i].intensity : point_light_choice) * diffuse_product;
    }
    // environment
    // diffuse
    vec2 fit = (cos_v * vec2(-0.7632, -0.4993) - vec2(0.4297, 0.6076) + vec2(0.8631, 1.2189)) * 0.6 + vec2(1.0);
    vec3 environment_irradiance = textureLod(u_envIrradiance, mx_map_point(normalize((u_envMatrix * vec4(N, 0.0)).xyz)),
        0.0).xyz * u_envLightIntensity;
    color += clamp(fit.x / fit.y, 0.0, 1.0) * vec3(0.5, 0.25, 0.15) * environment_irradiance;
    out1 = vec4(color, 1.0);
}
