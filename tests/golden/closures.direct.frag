#version 450
// Varnish · surfacematerial · mxgen 0.1 · glsl · reduced · 2 closures · 0 textures

uniform vec3 u_viewPosition = vec3(0.0);
uniform int u_numActiveLightSources = 0;
struct LightData {
    int type;
    vec3 direction;
    vec3 color;
    float intensity;
};
uniform LightData u_lightData[1];
in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
    vec3 tangentWorld;
} vd;
out vec4 out1;

vec2 mx_ggx_albedo(const float c)
{
    float u = 0.04 / (0.04 + c);
    vec4 powers_u = vec4(1.0, u, u * u, u * u * u);
    float x = clamp(1.0 - c - 0.04 * dot(powers_u, vec4(-0.5512581, 5.4328256, -3.6860163, 0.27730379)), 0.0, 1.0);
    return vec2(min(1.0046 - u * dot(powers_u, vec4(-0.16347954, 2.7701693, -5.364232, 2.791722)), 1.0), x * x * x * x * x);
}

float mx_ggx_distribution(const vec3 h)
{
    vec3 e = vec3(h.xy / vec2(0.04), h.z);
    float d = dot(e, e);
    return 1.0 / (0.005026548 * d * d);
}

float mx_ggx_visibility(const float cos_v, const float cos_l)
{
    return 0.5 * cos_l / (cos_v * sqrt(mix(cos_l * cos_l, 1.0, 0.0016)) + cos_l * sqrt(mix(cos_v * cos_v, 1.0, 0.0016)));
}

float mx_ggx_lobe(const vec3 N, const vec3 x, const float cos_v, const vec3 L, const vec3 H)
{
    return mx_ggx_distribution(vec3(dot(H, x), dot(H, cross(N, x)), dot(H, N))) * mx_ggx_visibility(cos_v, max(dot(N, L), 1e-8));
}

float mx_fresnel_dielectric(const float cosine)
{
    float g = sqrt(max(2.1025002 + cosine * cosine - 1.0, 0.0));
    vec2 a = cosine * vec2(1.0, 2.1025002);
    vec2 r = (a - g) / (a + g);
    return 0.5 * dot(r, r);
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
    vec3 tangent = normalize(vd.tangentWorld);
    vec3 coat_5 = normalize(tangent - coat_4 * dot(tangent, coat_4));
    vec3 paint = (1.0 - mix(0.033735953, 1.0, coat_2.y) * coat_2.x * coat_3) * 0.75 * vec3(0.6, 0.1, 0.05);
    for (int i = 0; i < min(u_numActiveLightSources, 1); ++i) {
        float intensity = u_lightData[i].intensity;
        vec3 directional_light = -u_lightData[i].direction;
        vec3 coat_6 = normalize(V - u_lightData[i].direction);
        float coat_7 = coat_3 * mx_ggx_lobe(coat_4, coat_5, coat, directional_light, coat_6);
        float paint_2 = max(dot(directional_light, coat_4), 1e-8);
        vec3 paint_3 = paint * (paint_2 / 3.1415927 * (max(dot(V, directional_light) - coat * paint_2, 0.0) * 0.225 / max(paint_2, coat) + 0.89285713));
        vec3 t = coat_7 * mx_fresnel_dielectric(clamp(dot(V, coat_6), 1e-8, 1.0)) + paint_3;
        color += u_lightData[i].color * (u_lightData[i].type == 1 ? intensity : 0.0) * t;
    }
    out1 = vec4(color, 1.0);
}
