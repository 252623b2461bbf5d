#version 450
// Varnish · surfacematerial · mxgen 0.1 · glsl · reduced · 2 closures · 0 textures

struct mx_GgxLobe {
    mat3 frame;
    vec3 stretch;
    float area;
    vec3 v;
    float masking;
    vec3 cap;
    float step;
    float weight;
    float level;
    mat4 map;
};
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
uniform sampler2D u_albedoTable;
in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
    vec3 tangentWorld;
} vd;
out vec4 out1;

vec2 mx_ggx_albedo(const float c)
{
    vec2 scales = textureLod(u_albedoTable, vec2(c, 0.04), 0.0).xy;
    float sum = clamp(scales.x + scales.y, 1e-8, 1.0);
    return vec2(sum, scales.y / sum);
}

mx_GgxLobe mx_ggx_lobe_at(const mat3 frame, const vec3 v)
{
    return mx_GgxLobe(frame, vec3(0.04, 0.04, 1.0), 0.0016, v, sqrt(mix(v.z * v.z, 1.0, 0.0016)), normalize(v * vec3(0.04, 0.04, 1.0)), 0.0, 0.0, 0.0, mat4(1.0));
}

mat3 mx_frame(const vec3 N, const vec3 X)
{
    mat3 frame;
    frame[0] = normalize(X - dot(X, N) * N);
    frame[1] = cross(N, frame[0]);
    frame[2] = N;
    return frame;
}

mx_GgxLobe mx_ggx_lobe(const vec3 N, const vec3 X, const vec3 V)
{
    mat3 frame = mx_frame(N, X);
    return mx_ggx_lobe_at(frame, max(V * frame, vec3(-1.0, -1.0, 1e-8)));
}

float mx_ggx_distribution(const vec3 e, const float area)
{
    return 1.0 / (3.1415927 * area * dot(e, e) * dot(e, e));
}

float mx_ggx_visibility(const mx_GgxLobe lobe, const float cos_l)
{
    return cos_l / (lobe.v.z * sqrt(mix(cos_l * cos_l, 1.0, lobe.area)) + cos_l * lobe.masking);
}

float mx_ggx_light(const mx_GgxLobe lobe, const vec3 L, const vec3 H)
{
    return 0.5 * mx_ggx_distribution(H * lobe.frame / lobe.stretch, lobe.area) * mx_ggx_visibility(lobe, max(dot(L, lobe.frame[2]), 1e-8));
}

float mx_fresnel_dielectric(const float cosine)
{
    float g = sqrt(max(2.1025002 + cosine * cosine - 1.0, 0.0));
    vec2 a = cosine * vec2(1.0, 2.1025002);
    vec2 r = (a - g) / (a + g);
    return 0.5 * dot(r, r);
}

vec2 mx_latlong(const mat4 map, const vec3 direction)
{
    vec3 d = normalize((map * vec4(direction, 0.0)).xyz);
    return vec2(atan(d.x, -d.z), -2.0 * asin(clamp(d.y, -1.0, 1.0))) * 0.15915494 + vec2(0.5);
}

vec3 mx_ggx_prefiltered(const vec3 N, const vec3 V)
{
    vec2 albedo = mx_ggx_albedo(max(abs(dot(N, V)), 1e-8));
    return mix(vec3(0.033735953), vec3(1.0), albedo.y) * albedo.x * (textureLod(u_envRadiance, mx_latlong(u_envMatrix, reflect(-V, faceforward(N, -V, N))), 0.2 * float(u_envRadianceMips - 1)).xyz * u_envLightIntensity);
}

void main()
{
    vec3 color = vec3(0.0);
    vec3 normal = normalize(vd.normalWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    float coat = max(abs(dot(normal, V)), 1e-8);
    vec2 coat_2 = mx_ggx_albedo(coat);
    float coat_3 = (1.0 / coat_2.x - 1.0) * 0.079748526 + 1.0;
    vec3 coat_4 = faceforward(normal, -V, normal);
    mx_GgxLobe coat_5 = mx_ggx_lobe(coat_4, normalize(vd.tangentWorld), V);
    float paint = (1.0 - mix(0.033735953, 1.0, coat_2.y) * coat_2.x * coat_3) * 0.75;
    vec3 paint_2 = paint * vec3(0.6, 0.1, 0.05);
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
        vec3 coat_6 = normalize(V + L);
        float coat_7 = mx_fresnel_dielectric(clamp(dot(V, coat_6), 1e-8, 1.0));
        float paint_3 = max(dot(L, coat_4), 1e-8);
        vec3 paint_4 = paint_2 * (paint_3 / 3.1415927 * (max(dot(V, L) - coat * paint_3, 0.0) * 0.225 / max(paint_3, coat) + 0.89285713));
        vec3 t = coat_3 * mx_ggx_light(coat_5, L, coat_6) * coat_7 + paint_4;
        color += u_lightData[i].color * (type == 1 ? intensity : light_2) * t;
    }
    vec2 paint_5 = (coat * vec2(-0.7632, -0.4993) - vec2(0.4297, 0.6076) + vec2(0.43155003, 0.60945004)) * 0.3 + vec2(1.0);
    vec3 paint_6 = paint * clamp(paint_5.x / paint_5.y, 0.0, 1.0) * vec3(0.6, 0.1, 0.05);
    vec3 paint_7 = textureLod(u_envIrradiance, mx_latlong(u_envMatrix, coat_4), 0.0).xyz * u_envLightIntensity * paint_6;
    color += coat_3 * mx_ggx_prefiltered(normal, V) + paint_7;
    out1 = vec4(color, 1.0);
}
