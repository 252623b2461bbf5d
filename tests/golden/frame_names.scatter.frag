#version 450
// surface · surface · mxgen 0.1 · glsl · reduced · 1 closure · 0 textures

uniform float u_time = 0.0;
uniform int u_numActiveLightSources = 0;
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
struct VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
    vec3 viewWorld;
    vec4 random;
    vec4 lightWorld;
    vec2 texcoord_0;
};
VertexData vd;
vec4 out1;
vec4 out2;
vec4 out3;
vec4 out4;
vec4 out5;
vec4 out6;
vec4 out7;

float scatter_2()
{
    float sum = 0.0;
    for (int i = 0; i < 3; ++i)
        sum += sin(u_time * float(i));
    return sum;
}

// Here count = 4.
float vd_2(const float x)
{
    float product = 1.0;
    for (int i = 0; i < 4; ++i)
        product *= cos(x * float(i));
    return product;
}

// Axes of the tangent space around N with x along X: `w * frame` enters it, `frame * w` leaves it.
mat3 mx_frame(const vec3 N, const vec3 X)
{
    mat3 frame;
    frame[0] = normalize(X - dot(X, N) * N);
    frame[1] = cross(N, frame[0]);
    frame[2] = N;
    return frame;
}

void scatter()
{
    float diffuse_weight = clamp(scatter_2(), 0.0, 1.0);
    float PublicUniforms_2 = vd_2(vd.texcoord_0.y);
    vec3 N = normalize(vd.normalWorld);
    float cos_v = max(abs(dot(N, vd.viewWorld)), 1e-8);
    vec2 fit = PublicUniforms_2 * (cos_v * vec2(-0.7632, -0.4993) - vec2(0.4297, 0.6076)
        + PublicUniforms_2 * vec2(1.4385, 2.0315)) + vec2(1.0);
    float diffuse_share = max(diffuse_weight * (clamp(fit.x / fit.y, 0.0, 1.0) * 0.18 * 0.9 + 0.1), 0.0);
    float pick = diffuse_share * vd.random.w;
    vec3 L = vec3(0.0);
    float inside = 0.0;
    vec3 weight = vec3(0.0);
    float density = 0.0;
    vec3 medium = vec3(1.0);
    vec3 facing = faceforward(N, -vd.viewWorld, N);
    vec2 ab = PublicUniforms_2 * PublicUniforms_2 * vec2(-0.5, 0.45)
        / (PublicUniforms_2 * PublicUniforms_2 + vec2(0.33, 0.09)) + vec2(1.0, 0.0);
    float scaled_diffuse_share = diffuse_share / diffuse_share;
    if (pick >= 0.0 && pick < diffuse_share) {
        mat3 any_frame = mx_frame(facing, abs(facing.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
        vec2 polar = sqrt(vd.random.x) * cos((vd.random.y - vec2(0.0, 0.25)) * 6.2831855);
        vec3 diffuse_L = any_frame * vec3(polar, sqrt(1.0 - vd.random.x));
        L = diffuse_L;
        float facing_dot_diffuse_l = dot(facing, diffuse_L);
        float diffuse_cos_l = max(facing_dot_diffuse_l, 1e-8);
        float diffuse_sum = ab.x + ab.y * max(dot(vd.viewWorld, diffuse_L) - cos_v * diffuse_cos_l, 0.0)
            / max(diffuse_cos_l, cos_v);
        float pdf = max(facing_dot_diffuse_l, 0.0) / 3.1415927;
        weight = vec3(diffuse_weight * (diffuse_cos_l * 0.31830987 * 0.18 * diffuse_sum / max(pdf, 1e-8))
            * scaled_diffuse_share);
        density = pdf * scaled_diffuse_share;
    }
    out1 = vec4(0.0, 0.0, 0.0, 1.0);
    out2 = vec4(L, inside);
    out3 = vec4(weight, density);
    out4 = vec4(medium, 0.0);
    float facing_dot_l = dot(facing, vd.lightWorld.xyz);
    float diffuse_cos_l = max(facing_dot_l, 1e-8);
    float diffuse_sum = ab.x + ab.y * max(dot(vd.viewWorld, vd.lightWorld.xyz) - cos_v * diffuse_cos_l, 0.0)
        / max(diffuse_cos_l, cos_v);
    float both = vd.lightWorld.w * (scaled_diffuse_share * (max(facing_dot_l, 0.0) / 3.1415927)) + 1.0;
    float diffuse_response = diffuse_weight * (diffuse_cos_l * 0.31830987 * 0.18 * diffuse_sum) / both;
    out5 = vec4(diffuse_response, diffuse_response, diffuse_response, 0.0);
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
        float diffuse_cos_l_2 = max(dot(facing, L_2), 1e-8);
        float diffuse_sum_2 = ab.x + ab.y * max(dot(vd.viewWorld, L_2) - cos_v * diffuse_cos_l_2, 0.0)
            / max(diffuse_cos_l_2, cos_v);
        float diffuse_response_2 = diffuse_weight * (diffuse_cos_l_2 * 0.31830987 * 0.18 * diffuse_sum_2);
        vec3 lit = u_lightData[i].color * intensity * diffuse_response_2;
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
}
