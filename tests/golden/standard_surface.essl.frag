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

vec2 mx_latlong(const mat4 map, const vec3 direction)
{
    vec3 d = normalize((map * vec4(direction, 0.0)).xyz);
    return vec2(atan(d.x, -d.z), -2.0 * asin(clamp(d.y, -1.0, 1.0))) * 0.15915494 + vec2(0.5);
}

void main()
{
    vec3 color = vec3(0.0);
    vec3 normal = normalize(vd_normalWorld);
    vec3 V = normalize(u_viewPosition - vd_positionWorld);
    // SR_clay
    vec3 diffuse = faceforward(normal, -V, normal);
    float diffuse_2 = max(abs(dot(normal, V)), 1e-8);
    for (int i = 0; i < min(u_numActiveLightSources, 3); ++i) {
        int type = u_lightData[i].type;
        float intensity = u_lightData[i].intensity;
        vec3 spot_light = u_lightData[i].position - vd_positionWorld;
        float spot_light_2 = intensity / pow(length(spot_light) + 1.0, u_lightData[i].decay_rate);
        float spot_light_3 = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
        vec3 spot_light_4 = normalize(spot_light);
        float spot_light_5 = smoothstep(spot_light_3, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, spot_light_4)) * spot_light_2;
        float light = type == 3 ? spot_light_5 : 0.0;
        float light_2 = type == 2 ? spot_light_2 : light;
        vec3 light_3 = u_lightData[i].color * (type == 1 ? intensity : light_2);
        vec3 directional_light = -u_lightData[i].direction;
        vec3 L = type == 1 ? directional_light : spot_light_4;
        float diffuse_3 = max(dot(L, diffuse), 1e-8);
        float diffuse_4 = max(dot(L, V) - diffuse_3 * diffuse_2, 0.0) * 0.35999998 / max(diffuse_3, diffuse_2) + 0.73913044;
        color += light_3 * (diffuse_3 / 3.1415927 * vec3(0.5, 0.25, 0.15) * diffuse_4);
    }
    vec2 diffuse_5 = (diffuse_2 * vec2(-0.7632, -0.4993) - vec2(0.4297, 0.6076) + vec2(0.86310005, 1.2189001)) * 0.6 + vec2(1.0);
    vec3 diffuse_6 = textureLod(u_envIrradiance, mx_latlong(u_envMatrix, diffuse), 0.0).xyz * u_envLightIntensity;
    color += clamp(diffuse_5.x / diffuse_5.y, 0.0, 1.0) * vec3(0.5, 0.25, 0.15) * diffuse_6;
    out1 = vec4(color, 1.0);
}
