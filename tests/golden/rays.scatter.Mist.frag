#version 450
// Mist · volumematerial · mxgen 0.1 · vulkan · reduced · 1 closure · 0 textures

layout(set = 0, binding = 0, std140) uniform PrivateUniforms {
    int u_numActiveLightSources;
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
struct VertexData {
    vec3 positionObject;
    vec3 positionWorld;
    vec3 viewWorld;
    vec4 random;
    vec4 lightWorld;
};
VertexData vd;
vec4 out1;
vec4 out2;
vec4 out3;
vec4 out4;
vec4 out5;
vec4 out6;
vec4 out7;
vec4 out10;
vec4 out9;

// Axes of the tangent space around N with x along X: `w * frame` enters it, `frame * w` leaves it.
mat3 mx_frame(const vec3 N, const vec3 X)
{
    mat3 frame;
    frame[0] = normalize(X - dot(X, N) * N);
    frame[1] = cross(N, frame[0]);
    frame[2] = N;
    return frame;
}

// A direction by the phase function, which is its own density.
// Here anisotropy = 0.0.
void mx_anisotropic_vdf_sample(const vec3 scattering, const vec3 V, const vec3 xi, out vec3 L, out vec3 weight,
    out float pdf)
{
    float cosine = 2.0 * xi.x - 1.0;
    L = mx_frame(-V, abs(-V.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0))
        * vec3(sqrt(1.0 - cosine * cosine) * cos(6.2831855 * (xi.y - vec2(0.0, 0.25))), cosine);
    weight = scattering;
    pdf = 0.07957747;
}

void scatter()
{
    float mist_share = max(dot(vd.positionObject, vec3(0.33333334)), 0.0);
    float pick = mist_share * vd.random.w;
    vec3 L = vec3(0.0);
    float inside = 0.0;
    vec3 weight = vec3(0.0);
    float density = 0.0;
    vec3 medium = vec3(1.0);
    float scaled_mist_share = mist_share / mist_share;
    if (pick >= 0.0 && pick < mist_share) {
        vec3 mist_L, mist_weight;
        float mist_pdf;
        mx_anisotropic_vdf_sample(vd.positionObject, vd.viewWorld, vd.random.xyz, mist_L, mist_weight, mist_pdf);
        L = mist_L;
        weight = mist_weight * scaled_mist_share;
        density = mist_pdf * scaled_mist_share;
    }
    out1 = vec4(0.0, 0.0, 0.0, 1.0);
    out2 = vec4(L, inside);
    out3 = vec4(weight, density);
    out4 = vec4(medium, 0.0);
    out5 = vec4(vd.positionObject * 0.07957747 / (vd.lightWorld.w * (scaled_mist_share * 0.07957747) + 1.0), 0.0);
    float chance = fract(vd.random.w * 4096.0);
    float brightness_sum = 0.0;
    vec3 light = vec3(0.0);
    vec3 light_L = vec3(0.0);
    float light_distance = 0.0;
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        vec3 L_2;
        float intensity;
        float away;
        int light_type = u_lightData[i].type;
        if (light_type == 1) {
            L_2 = -u_lightData[i].direction;
            intensity = u_lightData[i].intensity;
            away = 1e30;
        } else {
            vec3 d = u_lightData[i].position - vd.positionWorld;
            vec3 to_light = normalize(d);
            L_2 = to_light;
            float magnitude_d = length(d);
            float falloff = u_lightData[i].intensity / pow(magnitude_d + 1.0, u_lightData[i].decay_rate);
            if (light_type == 2) {
                intensity = falloff;
                away = magnitude_d;
            } else {
                float edge = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
                intensity = light_type == 3
                    ? smoothstep(edge, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, to_light)) * falloff
                    : 0.0;
                away = magnitude_d;
            }
        }
        vec3 lit = vd.positionObject * 0.07957747 * (u_lightData[i].color * intensity);
        float brightness = max(dot(lit, vec3(0.33333334)), 0.0);
        brightness_sum += brightness;
        if (brightness_sum * chance < brightness) {
            light_L = L_2;
            light_distance = away;
            light = lit / brightness;
        }
        if (brightness > 0.0) {
            float ratio = (brightness_sum * chance - brightness) / (brightness_sum - brightness);
            chance = brightness_sum * chance < brightness ? brightness_sum * chance / brightness : ratio;
        }
    }
    out6 = vec4(light_L, light_distance);
    out7 = vec4(brightness_sum * light, 0.0);
    out9 = vec4(vd.positionObject, 0.0);
    out10 = vec4(vd.positionObject, 0.0);
}
