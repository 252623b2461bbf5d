#version 450
// Glass · surfacematerial · mxgen 0.1 · glsl · reduced · 2 closures · 0 textures

uniform vec3 u_viewPosition = vec3(0.0);
uniform int u_numActiveLightSources = 0;
uniform mat4 u_envMatrix = mat4(-1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
uniform int u_envRadianceMips = 1;
uniform int u_envRadianceSamples = 16;
uniform float u_envLightIntensity = 1.0;
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
uniform sampler2D u_envRadiance;
in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
    vec3 tangentWorld;
} vd;
out vec4 out1;

vec2 mx_ggx_albedo(const float c)
{
    float u = 0.0001 / (0.0001 + c);
    vec4 powers_u = vec4(1.0, u, u * u, u * u * u);
    float x = clamp(1.0 - c - 0.0001 * dot(powers_u, vec4(-0.201624, 5.292261, -3.7565958, 0.21825665)), 0.0, 1.0);
    return vec2(min(1.0046 - u * dot(powers_u, vec4(-0.14479354, 2.7591474, -5.43134, 2.849591)), 1.0), x * x * x * x * x);
}

float mx_ggx_distribution(const vec3 h)
{
    vec3 e = vec3(h.xy / vec2(0.0001), h.z);
    float d = dot(e, e);
    return 1.0 / (3.1415926e-8 * d * d);
}

float mx_ggx_visibility(const float cos_v, const float cos_l)
{
    return 0.5 * cos_l / (cos_v * sqrt(mix(cos_l * cos_l, 1.0, 9.999999e-9)) + cos_l * sqrt(mix(cos_v * cos_v, 1.0, 9.999999e-9)));
}

float mx_ggx_lobe(const vec3 N, const vec3 x, const float cos_v, const vec3 L, const vec3 H)
{
    return mx_ggx_distribution(vec3(dot(H, x), dot(H, cross(N, x)), dot(H, N))) * mx_ggx_visibility(cos_v, max(dot(N, L), 1e-8));
}

float mx_fresnel_dielectric(const float cosine)
{
    float g = sqrt(max(2.3104 + cosine * cosine - 1.0, 0.0));
    vec2 a = cosine * vec2(1.0, 2.3104);
    vec2 r = (a - g) / (a + g);
    return 0.5 * dot(r, r);
}

vec2 mx_latlong(const vec3 direction)
{
    vec3 d = normalize((u_envMatrix * vec4(direction, 0.0)).xyz);
    return vec2(atan(d.x, -d.z), -2.0 * asin(d.y)) * 0.15915494 + vec2(0.5);
}

vec3 mx_refract_sphere(const vec3 v, const vec3 h, const float ior)
{
    vec3 inside = refract(-v, h, 1.0 / ior);
    return refract(inside, normalize(inside * dot(inside, h) - 0.5 * h), ior);
}

vec3 mx_leave_frame(const vec3 w, const vec3 N, const vec3 x)
{
    return w.x * x + w.y * cross(N, x) + w.z * N;
}

vec3 mx_ggx_visible_normal(const vec2 xi, const vec3 v)
{
    float top = (1.0 - xi.y) * (1.0 + v.z);
    float z = top - v.z;
    return normalize(vec3((v.xy + sqrt(max(1.0 - z * z, 0.0)) * cos(6.2831855 * (xi.x - vec2(0.0, 0.25)))) * 0.0001, top));
}

vec4 mx_ggx_sample(const int i, const vec3 N, const vec3 x, const vec3 V, const float cos_v, const float refract_ior)
{
    float count = float(u_envRadianceSamples);
    vec3 h = mx_ggx_visible_normal(vec2((float(i) + 0.5) / count, fract((float(i) + 1.0) * 1.618034)), normalize(vec3(dot(V, x) * 0.0001, dot(V, cross(N, x)) * 0.0001, cos_v)));
    vec3 H = mx_leave_frame(h, N, x);
    float masking = 2.0 * (cos_v + sqrt(mix(cos_v * cos_v, 1.0, 9.999999e-9))) / count;
    vec3 L = reflect(-V, H);
    float weight = 0.25 / cos_v;
    if (refract_ior > 0.0)
        L = mx_refract_sphere(V, H, refract_ior);
    else
        weight = mx_ggx_visibility(cos_v, max(dot(N, L), 1e-8));
    float solid = length(L.xz) * mx_ggx_distribution(h) / masking;
    return vec4(weight * masking * (textureLod(u_envRadiance, mx_latlong(L), max(float(u_envRadianceMips) - 2.5 - 0.5 * log2(solid), 0.0)).xyz * u_envLightIntensity), clamp(dot(V, H), 1e-8, 1.0));
}

void main()
{
    vec3 color = vec3(0.0);
    vec3 normal = normalize(vd.normalWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    // SR_glass
    float reflection = max(abs(dot(normal, V)), 1e-8);
    vec2 reflection_2 = mx_ggx_albedo(reflection);
    float reflection_3 = (1.0 / reflection_2.x - 1.0) * 0.08817142 + 1.0;
    vec3 reflection_4 = faceforward(normal, -V, normal);
    vec3 tangent = normalize(vd.tangentWorld);
    vec3 reflection_5 = normalize(tangent - reflection_4 * dot(tangent, reflection_4));
    for (int i = 0; i < min(u_numActiveLightSources, 3); ++i) {
        int type = u_lightData[i].type;
        float intensity = u_lightData[i].intensity;
        vec3 spot_light = u_lightData[i].position - vd.positionWorld;
        float spot_light_2 = intensity / pow(length(spot_light) + 1.0, u_lightData[i].decay_rate);
        float spot_light_3 = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
        vec3 spot_light_4 = normalize(spot_light);
        float spot_light_5 = smoothstep(spot_light_3, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, spot_light_4)) * spot_light_2;
        float light = type == 3 ? spot_light_5 : 0.0;
        float light_2 = type == 2 ? spot_light_2 : light;
        vec3 directional_light = -u_lightData[i].direction;
        vec3 L = type == 1 ? directional_light : spot_light_4;
        vec3 reflection_6 = normalize(V + L);
        float reflection_7 = reflection_3 * mx_ggx_lobe(reflection_4, reflection_5, reflection, L, reflection_6);
        float reflection_8 = reflection_7 * mx_fresnel_dielectric(clamp(dot(V, reflection_6), 1e-8, 1.0));
        color += u_lightData[i].color * (type == 1 ? intensity : light_2) * reflection_8;
    }
    float reflection_9 = 1.0 - mix(0.042579994, 1.0, reflection_2.y) * reflection_2.x * reflection_3;
    for (int i = 0; i < u_envRadianceSamples; ++i) {
        vec4 reflection_10 = mx_ggx_sample(i, reflection_4, reflection_5, V, reflection, 0.0);
        vec4 refraction = mx_ggx_sample(i, reflection_4, reflection_5, V, reflection, 1.52);
        vec3 refraction_2 = refraction.xyz * (reflection_9 * (1.0 - mx_fresnel_dielectric(refraction.w)));
        color += reflection_3 * reflection_10.xyz * mx_fresnel_dielectric(reflection_10.w) + refraction_2;
    }
    out1 = vec4(color, 1.0);
}
