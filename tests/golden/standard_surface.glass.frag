#version 450
// Glass · surfacematerial · mxgen 0.1 · glsl · reduced · 3 closures · 0 textures

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

float mx_fresnel_dielectric(const float cosine)
{
    float g = sqrt(max(2.3104 + cosine * cosine - 1.0, 0.0));
    vec2 a = cosine * vec2(1.0, 2.3104);
    vec2 r = (a - g) / (a + g);
    return 0.5 * dot(r, r);
}

vec3 mx_ggx_compensation(const vec2 albedo)
{
    return 1.0 + vec3(0.08817143) * (1.0 / (albedo.x + albedo.y) - 1.0);
}

vec2 mx_ggx_albedo(const vec3 N, const vec3 V)
{
    float c = max(abs(dot(N, V)), 1e-8);
    vec4 r = vec4(0.101274714, 0.9347229, 1.0008262, 1.0015944) + c * (vec4(-0.6305036, -2.3233747, -1.7638469, 0.22252001) + c * vec4(29.337357, 1.4241437, 28.956388, 13.085487));
    return clamp(r.xy / r.zw, 0.0, 1.0);
}

float mx_ggx_distribution(const vec3 h)
{
    vec3 e = vec3(h.xy / 0.0001, h.z);
    float d = dot(e, e);
    return 1.0 / (3.1415926e-8 * d * d);
}

mat3 mx_frame(const vec3 N, const vec3 X)
{
    vec3 x = normalize(X - dot(X, N) * N);
    return mat3(x, cross(N, x), N);
}

float mx_ggx_visibility(const float cos_v, const float cos_l)
{
    return 0.5 * cos_l / (cos_v * sqrt(mix(cos_l * cos_l, 1.0, 9.999999e-9)) + cos_l * sqrt(mix(cos_v * cos_v, 1.0, 9.999999e-9)));
}

vec2 mx_ggx_lobe(const vec3 Z, const vec3 X, const vec3 V, const vec3 L)
{
    vec3 H = normalize(V + L);
    return vec2(mx_ggx_distribution(H * mx_frame(Z, X)) * mx_ggx_visibility(max(dot(Z, V), 1e-8), max(dot(Z, L), 1e-8)), clamp(dot(V, H), 1e-8, 1.0));
}

vec3 mx_ggx_eval(const vec3 N, const vec3 X, const vec3 V, const vec3 L)
{
    vec2 lobe = mx_ggx_lobe(faceforward(N, -V, N), X, V, L);
    return lobe.x * vec3(mx_fresnel_dielectric(lobe.y)) * mx_ggx_compensation(mx_ggx_albedo(N, V));
}

vec2 mx_latlong(const vec3 direction)
{
    vec3 d = normalize((u_envMatrix * vec4(direction, 0.0)).xyz);
    return vec2(atan(d.x, -d.z), -2.0 * asin(d.y)) * 0.15915494 + 0.5;
}

vec3 mx_refract_sphere(const vec3 v, const vec3 h, const float ior)
{
    vec3 inside = refract(-v, h, 1.0 / ior);
    return refract(inside, normalize(inside * dot(inside, h) - 0.5 * h), ior);
}

vec3 mx_ggx_normal(const int i, const vec3 v)
{
    float phi = 6.2831855 * (float(i) + 0.5) / float(u_envRadianceSamples);
    float top = (1.0 - fract((float(i) + 1.0) * 1.618034)) * (1.0 + v.z);
    float z = top - v.z;
    vec2 around = sqrt(max(1.0 - z * z, 0.0)) * cos(phi - vec2(0.0, 1.5707964));
    return normalize(vec3((v.xy + around) * 0.0001, top));
}

vec4 mx_ggx_sample(const int i, const mat3 frame, const vec3 v, const float refract_ior)
{
    vec3 h = mx_ggx_normal(i, normalize(vec3(v.xy * 0.0001, v.z)));
    vec3 l = refract_ior > 0.0 ? mx_refract_sphere(v, h, refract_ior) : reflect(-v, h);
    vec3 L = frame * l;
    float cos_v = max(v.z, 1e-8);
    float masking = 2.0 * (cos_v + sqrt(mix(cos_v * cos_v, 1.0, 9.999999e-9)));
    float count = float(u_envRadianceSamples);
    float solid = length(L.xz) * count * mx_ggx_distribution(h) / masking;
    float weight = refract_ior > 0.0 ? 0.25 / cos_v : mx_ggx_visibility(cos_v, max(l.z, 1e-8));
    return vec4(weight * masking / count * (textureLod(u_envRadiance, mx_latlong(L), max(float(u_envRadianceMips) - 2.5 - 0.5 * log2(solid), 0.0)).xyz * u_envLightIntensity), clamp(dot(v, h), 1e-8, 1.0));
}

vec3 mx_ggx_environment(const vec3 N, const vec3 X, const vec3 V, const float refract_ior)
{
    vec3 light = vec3(0.0);
    mat3 frame = mx_frame(faceforward(N, -V, N), X);
    for (int i = 0; i < u_envRadianceSamples; ++i) {
        vec4 s = mx_ggx_sample(i, frame, V * frame, refract_ior);
        vec3 f = vec3(mx_fresnel_dielectric(s.w));
        light += s.xyz * (refract_ior > 0.0 ? 1.0 - f : f);
    }
    if (refract_ior > 0.0)
        return light;
    return light * mx_ggx_compensation(mx_ggx_albedo(N, V));
}

vec3 mx_ggx_reflectance(const vec3 N, const vec3 V)
{
    vec2 albedo = mx_ggx_albedo(N, V);
    return (vec3(0.04258) * albedo.x + vec3(albedo.y)) * (1.0 + vec3(0.08817143) * (1.0 / (albedo.x + albedo.y) - 1.0));
}

void main()
{
    vec3 color = vec3(0.0);
    vec3 normal = normalize(vd.normalWorld);
    vec3 tangent = normalize(vd.tangentWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    for (int i = 0; i < min(u_numActiveLightSources, 3); ++i) {
        vec3 L = u_lightData[i].color * (u_lightData[i].intensity / pow(distance(vd.positionWorld, u_lightData[i].position) + 1.0, u_lightData[i].decay_rate));
        vec3 L_2 = normalize(u_lightData[i].position - vd.positionWorld);
        vec3 L_3 = L * smoothstep(min(u_lightData[i].inner_angle, u_lightData[i].outer_angle), u_lightData[i].inner_angle, -dot(u_lightData[i].direction, L_2));
        vec3 light = u_lightData[i].type == 2 ? L : u_lightData[i].type == 3 ? L_3 : vec3(0.0);
        // SR_glass/reflection
        vec3 reflection = mx_ggx_eval(normal, tangent, V, u_lightData[i].type == 1 ? -u_lightData[i].direction : L_2);
        color += (u_lightData[i].type == 1 ? u_lightData[i].color * u_lightData[i].intensity : light) * reflection;
    }
    // SR_glass/refraction
    vec3 refraction = (1.0 - mx_ggx_reflectance(normal, V)) * mx_ggx_environment(normal, tangent, V, 1.52);
    color += mx_ggx_environment(normal, tangent, V, 0.0) + refraction;
    out1 = vec4(color, 1.0);
}
