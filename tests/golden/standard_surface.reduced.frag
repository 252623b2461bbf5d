#version 450
// Clay · surfacematerial · mxgen 0.1 · vulkan · reduced · 2 closures · 0 textures

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

vec3 mx_oren_nayar_diffuse_bsdf_eval(const vec3 N, const vec3 V, const vec3 L)
{
    float cos_l = max(dot(faceforward(N, -V, N), L), 1e-8);
    float cos_v = max(dot(faceforward(N, -V, N), V), 1e-8);
    float s = max(dot(L, V), 1e-8) - cos_l * cos_v;
    if (s > 0.0)
        s /= max(cos_l, cos_v);
    return vec3(0.5, 0.25, 0.15) * (cos_l / 3.1415927) * (0.73913044 + 0.35999998 * max(s, 0.0));
}

vec2 mx_latlong(const vec3 direction)
{
    vec3 d = normalize((u_envMatrix * vec4(direction, 0.0)).xyz);
    return vec2(atan(d.x, -d.z), -2.0 * asin(d.y)) * 0.15915494 + 0.5;
}

void main()
{
    vec3 color = vec3(0.0);
    vec3 normal = normalize(vd.normalWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    for (int i = 0; i < min(u_numActiveLightSources, 3); ++i) {
        int type = u_lightData[i].type;
        vec3 spot_light = u_lightData[i].position - vd.positionWorld;
        float spot_light_2 = u_lightData[i].intensity / pow(length(spot_light) + 1.0, u_lightData[i].decay_rate);
        float spot_light_3 = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle);
        vec3 spot_light_4 = normalize(spot_light);
        float light = spot_light_2 * smoothstep(spot_light_3, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, spot_light_4)) * (type == 3 ? 1.0 : 0.0);
        vec3 light_2 = u_lightData[i].color * (type == 1 ? u_lightData[i].intensity : type == 2 ? spot_light_2 : light);
        vec3 directional_light = -u_lightData[i].direction;
        color += light_2 * mx_oren_nayar_diffuse_bsdf_eval(normal, V, type == 1 ? directional_light : spot_light_4);
    }
    // SR_clay
    vec3 diffuse = faceforward(normal, -V, normal);
    vec3 diffuse_2 = textureLod(u_envIrradiance, mx_latlong(diffuse), 0.0).xyz * u_envLightIntensity * vec3(0.5, 0.25, 0.15);
    vec2 diffuse_3 = (max(dot(V, diffuse), 1e-8) * vec2(-0.7632, -0.4993) + vec2(-0.4297, -0.6076) + vec2(0.86310005, 1.2189001)) * 0.6 + vec2(1.0);
    color += diffuse_2 * clamp(diffuse_3.x / diffuse_3.y, 0.0, 1.0);
    out1 = vec4(color, 1.0);
}
