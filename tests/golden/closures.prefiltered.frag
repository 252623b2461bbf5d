#version 450
// Varnish · surfacematerial · mxgen 0.1 · glsl · authored · 3 closures · 0 textures

uniform vec3 u_viewPosition = vec3(0.0);
uniform int u_numActiveLightSources = 0;
uniform mat4 u_envMatrix = mat4(-1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
uniform int u_envRadianceMips = 1;
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
uniform sampler2D u_envIrradiance;
in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
    vec3 tangentWorld;
} vd;
out vec4 out1;

float mx_fresnel_dielectric(const float cosine)
{
    float g = sqrt(max(2.1025002 + cosine * cosine - 1.0, 0.0));
    vec2 a = cosine * vec2(1.0, 2.1025002);
    vec2 r = (a - g) / (a + g);
    return 0.5 * dot(r, r);
}

vec3 mx_ggx_compensation(const vec2 albedo)
{
    return 1.0 + vec3(0.079748526) * (1.0 / (albedo.x + albedo.y) - 1.0);
}

vec2 mx_ggx_albedo(const vec3 N, const vec3 V)
{
    float c = max(abs(dot(N, V)), 1e-8);
    vec4 r = vec4(0.477028, 1.0224305, 1.3185087, 1.7036159) + c * (vec4(-0.679836, -2.4724538, -1.278424, -1.52478) + c * vec4(28.273684, 1.4824458, 27.56899, 14.8198395));
    return clamp(r.xy / r.zw, 0.0, 1.0);
}

float mx_ggx_distribution(const vec3 h)
{
    vec3 e = vec3(h.xy / 0.04, h.z);
    float d = dot(e, e);
    return 1.0 / (0.005026548 * d * d);
}

mat3 mx_frame(const vec3 N, const vec3 X)
{
    vec3 x = normalize(X - dot(X, N) * N);
    return mat3(x, cross(N, x), N);
}

float mx_ggx_visibility(const float cos_v, const float cos_l)
{
    return 0.5 * cos_l / (cos_v * sqrt(mix(cos_l * cos_l, 1.0, 0.0016)) + cos_l * sqrt(mix(cos_v * cos_v, 1.0, 0.0016)));
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

vec3 mx_oren_nayar_diffuse_bsdf_eval(const vec3 N, const vec3 V, const vec3 L)
{
    float cos_l = max(dot(faceforward(N, -V, N), L), 1e-8);
    vec3 lambert = vec3(0.6, 0.1, 0.05) * (cos_l / 3.1415927);
    float cos_v = max(dot(faceforward(N, -V, N), V), 1e-8);
    float s = max(dot(L, V), 1e-8) - cos_l * cos_v;
    if (s > 0.0)
        s /= max(cos_l, cos_v);
    return lambert * (0.89285713 + 0.225 * max(s, 0.0));
}

vec3 mx_ggx_reflectance(const vec3 N, const vec3 V)
{
    vec2 albedo = mx_ggx_albedo(N, V);
    return (vec3(0.033735957) * albedo.x + vec3(albedo.y)) * (1.0 + vec3(0.079748526) * (1.0 / (albedo.x + albedo.y) - 1.0));
}

vec2 mx_latlong(const vec3 direction)
{
    vec3 d = normalize((u_envMatrix * vec4(direction, 0.0)).xyz);
    return vec2(atan(d.x, -d.z), -2.0 * asin(d.y)) * 0.15915494 + 0.5;
}

vec3 mx_ggx_prefiltered(const vec3 N, const vec3 V)
{
    vec3 h = faceforward(N, -V, N);
    vec2 albedo = mx_ggx_albedo(N, V);
    vec3 f = vec3(0.033735957) * albedo.x + vec3(albedo.y);
    float lod = 0.2 * float(u_envRadianceMips - 1);
    return f * (textureLod(u_envRadiance, mx_latlong(reflect(-V, h)), lod).xyz * u_envLightIntensity);
}

vec3 mx_ggx_environment(const vec3 N, const vec3 V)
{
    vec3 light = mx_ggx_prefiltered(N, V);
    return light * mx_ggx_compensation(mx_ggx_albedo(N, V));
}

vec3 mx_oren_nayar_diffuse_bsdf_environment(const vec3 N, const vec3 V)
{
    vec3 light = vec3(0.6, 0.1, 0.05) * (textureLod(u_envIrradiance, mx_latlong(faceforward(N, -V, N)), 0.0).xyz * u_envLightIntensity);
    float cos_v = max(dot(faceforward(N, -V, N), V), 1e-8);
    vec2 fit = 1.0 + 0.3 * (vec2(-0.4297, -0.6076) + vec2(-0.7632, -0.4993) * cos_v + vec2(0.43155003, 0.60945004));
    return light * clamp(fit.x / fit.y, 0.0, 1.0);
}

void main()
{
    vec3 color = vec3(0.0);
    vec3 normal = normalize(vd.normalWorld);
    vec3 tangent = normalize(vd.tangentWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    // paint
    vec3 paint = (1.0 - mx_ggx_reflectance(normal, V)) * 0.75;
    for (int i = 0; i < min(u_numActiveLightSources, 3); ++i) {
        vec3 L = u_lightData[i].color * (u_lightData[i].intensity / pow(distance(vd.positionWorld, u_lightData[i].position) + 1.0, u_lightData[i].decay_rate));
        vec3 L_2 = normalize(u_lightData[i].position - vd.positionWorld);
        vec3 L_3 = L * smoothstep(min(u_lightData[i].inner_angle, u_lightData[i].outer_angle), u_lightData[i].inner_angle, -dot(u_lightData[i].direction, L_2));
        vec3 light = u_lightData[i].type == 2 ? L : u_lightData[i].type == 3 ? L_3 : vec3(0.0);
        vec3 light_2 = u_lightData[i].type == 1 ? u_lightData[i].color * u_lightData[i].intensity : light;
        vec3 L_4 = u_lightData[i].type == 1 ? -u_lightData[i].direction : L_2;
        vec3 paint_2 = mx_oren_nayar_diffuse_bsdf_eval(normal, V, L_4) * paint;
        color += light_2 * (mx_ggx_eval(normal, tangent, V, L_4) + paint_2);
    }
    color += mx_ggx_environment(normal, V) + paint * mx_oren_nayar_diffuse_bsdf_environment(normal, V);
    out1 = vec4(color, 1.0);
}
