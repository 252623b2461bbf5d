#version 450
// S · slab_surface · mxgen 0.1 · vulkan · reduced · 3 closures · 0 textures

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
    vec3 positionWorld;
    vec3 normalWorld;
    vec3 tangentWorld;
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

// A polynomial of two variables, what directional albedos are fitted by (the programs in fits/).
float mx_bicubic(const mat4 m, const float x)
{
    return dot(vec4(1.0, x, x * x, x * x * x), m * vec4(1.0, 0.25, 0.0625, 0.015625));
}

// The program fits/ggx.c makes the constants. x is never too small by more than 0.001, so that giving lost energy back
// adds none. `u` follows what happens where light grazes the facets.
vec2 mx_ggx_albedo_fit(const float u, const float c)
{
    float x = clamp(1.0 - c - 0.25 * mx_bicubic(mat4(-0.2006, 5.2916, -3.7565, 0.218, -10.2439, 6.6203, -0.9657, 2.5694,
        38.3042, -80.8059, 71.731, -28.5214, -34.2, 89.1079, -88.4065, 33.782), u), 0.0, 1.0);
    return vec2(min(1.0046 - u * mx_bicubic(mat4(-0.1447, 2.759, -5.4314, 2.8497, -0.9366, 1.4766, 0.5911, -1.0905,
        11.8506, -30.2645, 27.3289, -8.9414, -4.3199, 8.2596, -3.1648, -0.8054), u), 1.0), x * x * x * x * x);
}

vec3 mx_fresnel_schlick(const float cosine)
{
    float x = 1.0 - cosine;
    return mix(vec3(0.04), vec3(1.0), x * x * x * x * x);
}

// Zeltner et al.: clamped cosine under the linear transform M^-1 = [a 0 b; 0 a 0; 0 0 1] in the plane of V and N.
vec2 mx_sheen_transform(const float c)
{
    return vec2((2.58126 * c + 0.4068515) * 0.5 / (1.0 + 0.310327 * c * c + 2.60994 * c * 0.5), sqrt(1.0 - c) * -0.5
        * 0.5 * 0.5 * 0.5 / (0.0000254053 + 1.71228 * c - 1.71506 * c * 0.5 + 0.335435));
}

// Directional albedo: for Conty and Kulla by the program fits/sheen.c, for Zeltner et al. their Gaussian fit.
float mx_sheen_albedo(const float c)
{
    float x = (c - -0.34768447) / 0.42837164;
    return max(exp(-0.5 * x * x) / 1.0737685 + 0.018264338, 0.0);
}

// Into the tangent space around N with x along the unit tangent `x`, and out of it.
vec3 mx_enter_frame(const vec3 w, const vec3 N, const vec3 x)
{
    return vec3(dot(w, x), dot(w, cross(N, x)), dot(w, N));
}

// Unit tangent along X.
vec3 mx_tangent(const vec3 N, const vec3 X)
{
    return normalize(X - dot(X, N) * N);
}

float mx_sheen_zeltner(const vec3 N, const vec3 V, const vec3 L, const float c)
{
    vec2 m = mx_sheen_transform(c);
    vec3 l = mx_enter_frame(L, N, mx_tangent(N, V + 0.00001 * N.yzx));
    vec3 w = vec3(m.x * l.x + m.y * l.z, m.x * l.y, l.z);
    float scale = m.x / dot(w, w);
    return max(w.z, 0.0) / 3.1415927 * scale * scale;
}

// Distribution of normals (Burley 2012, appendix B.2, equation 13) at a normal that is stretched to that of a unit
// sphere; `area` is the product of the roughness along x and y.
float mx_ggx_distribution(const vec3 e)
{
    return 1.0 / (0.19634955 * dot(e, e) * dot(e, e));
}

// Solid angle of normals for that of refracted directions (Walter et al. 2007, equation 17).
float mx_refraction_jacobian(const vec3 v, const vec3 l, const vec3 h)
{
    float cos_l = dot(l, h);
    float sum = dot(v, h) + 1.5 * cos_l;
    return 2.25 * abs(cos_l) / (sum * sum);
}

float mx_ggx_smith_visibility(const vec3 v, const vec3 l)
{
    return 0.5 * l.z / (v.z * length(vec3(l.xy * 0.25, l.z)) + l.z * length(vec3(v.xy * 0.25, v.z)));
}

// A normal of those visible from v, which is stretched by the roughness, before it is scaled to length 1 (Dupuy and
// Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps"): (cos, sin) of its turn around z, and how far the
// cap is below its top, `top` = v + z.
vec3 mx_ggx_cap(const vec2 around, const float depth, const vec3 top)
{
    return vec3(top.xy + sqrt(depth * (2.0 - depth)) * around, top.z - depth);
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

// What mx_ggx_eval and mx_ggx_refracted are over mx_ggx_pdf, without the numbers that become huge where the surface is
// smooth.
void mx_ggx_scatter(const vec3 N, const vec3 X, const vec3 V, const vec3 xi, out vec3 L, out vec3 weight, out float pdf)
{
    mat3 frame = mx_frame(faceforward(N, -V, N), X);
    vec3 v = max(V * frame, vec3(-1.0, -1.0, 1e-8));
    vec3 stretch = vec3(0.25, 0.25, 1.0);
    vec3 top = normalize(v * stretch) + vec3(0.0, 0.0, 1.0);
    vec3 h = normalize(mx_ggx_cap(cos(6.2831855 * (xi.x - vec2(0.0, 0.25))), xi.y * top.z, top) * stretch);
    float cos_h = clamp(dot(v, h), 1e-8, 1.0);
    vec3 f = mx_fresnel_schlick(cos_h);
    float share = 1.0;
    bool is_reflected = xi.z < share;
    vec3 l = is_reflected ? reflect(-v, h) : refract(-v, h, 0.6666667);
    float density = 2.0 / (v.z + length(vec3(v.xy * 0.25, v.z)));
    L = frame * l;
    weight = vec3(0.0);
    pdf = 0.0;
    if (is_reflected ? l.z <= 0.0 : l.z >= 0.0)
        return;
    if (is_reflected) {
        weight = f * (mx_ggx_smith_visibility(v, l) * 4.0 / (density * share))
            * (vec3(1.0) + vec3(0.08571428) * (1.0 / mx_ggx_albedo_fit(0.25 / (0.25 + v.z), v.z).x - 1.0));
        pdf = 0.25 * share;
    } else {
        weight = (vec3(1.0) - f) * (2.0 / ((-l).z + length(vec3((-l).xy * 0.25, (-l).z))) * -l.z / (1.0 - share));
        pdf = (1.0 - share) * cos_h * mx_refraction_jacobian(v, l, h);
    }
    pdf *= density * mx_ggx_distribution(h / vec3(0.25, 0.25, 1.0));
}

float mx_power5(const float x)
{
    return x * x * x * x * x;
}

// The program fits/chan.c makes the constants; within 0.0012.
float mx_chan_albedo(const float c)
{
    vec4 fit = mat4(0.7111, 0.0005, 0.4749, 0.0263, 0.1526, 0.0031, 1.026, -0.7185, 0.1026, -0.0048, -2.2232, 0.3473,
        -0.0538, 0.0016, 2.0696, -0.4921) * vec4(1.0, c, c * c, c * c * c);
    return mix(fit.x, 0.9642857 - 0.7232143 * mx_power5(1.0 - c), 0.10551292) + 10.874733 * fit.y / (fit.w + c);
}

// The lobe times the light's cosine, for albedo 1.
float mx_chan(const vec3 N, const vec3 V, const vec3 L)
{
    float cos_l = max(dot(N, L), 0.0);
    float cos_v = max(abs(dot(N, V)), 1e-8);
    float cos_d = sqrt(max(0.5 + 0.5 * dot(V, L), 1e-8));
    float lobe = mix(cos_d + mx_power5(1.0 - cos_d), (1.0 - 0.75 * mx_power5(1.0 - cos_v))
        * (1.0 - 0.75 * mx_power5(1.0 - cos_l)), 0.10551292) + 10.874733 * cos_d
        * exp2(-8.9 * sqrt(min((cos_l + cos_v) / (2.0 * cos_d), 1.0)));
    return max(lobe, 0.0) * cos_l / (3.1415927 * mx_chan_albedo(cos_v));
}

float mx_ggx_smith_lobe(const mat3 frame, const vec3 V, const vec3 L)
{
    return mx_ggx_distribution(normalize(V + L) * frame / vec3(0.25, 0.25, 1.0))
        * mx_ggx_smith_visibility(max(V * frame, vec3(-1.0, -1.0, 1e-8)), max(L * frame, vec3(-1.0, -1.0, 1e-8)));
}

// Normal of the facet that refracts l, below the horizon, towards v (Walter et al. 2007, equation 16).
vec3 mx_refracting_normal(const vec3 v, const vec3 l)
{
    vec3 h = normalize(v + 1.5 * l);
    return h.z < 0.0 ? -h : h;
}

float mx_ggx_pdf(const vec3 N, const vec3 X, const vec3 V, const vec3 L)
{
    mat3 frame = mx_frame(faceforward(N, -V, N), X);
    vec3 v = max(V * frame, vec3(-1.0, -1.0, 1e-8));
    vec3 l = L * frame;
    bool is_reflected = l.z > 0.0;
    vec3 h = is_reflected ? normalize(v + l) : mx_refracting_normal(v, l);
    float cos_h = dot(v, h);
    if (cos_h <= 0.0 || !is_reflected && dot(l, h) >= 0.0)
        return 0.0;
    float share = 1.0;
    return 2.0 / (v.z + length(vec3(v.xy * 0.25, v.z))) * mx_ggx_distribution(h / vec3(0.25, 0.25, 1.0))
        * (is_reflected ? 0.25 * share : (1.0 - share) * cos_h * mx_refraction_jacobian(v, l, h));
}

void scatter()
{
    vec3 N = normalize(vd.normalWorld);
    // s
    float cos_v = max(abs(dot(N, vd.viewWorld)), 1e-8);
    float x = (cos_v + 0.34768447) / 0.42837164;
    float sheen_bsdf_albedo = max(exp(x * (x * -0.5)) / 1.0737685 + 0.018264338, 0.0);
    float greater = max(dot(vec3((sheen_bsdf_albedo * 0.9 + 0.1) * 0.3), vec3(0.33333334)), 0.0);
    float s_fuzz_difference = 1.0 - sheen_bsdf_albedo * 0.3;
    vec2 albedo = mx_ggx_albedo_fit(0.25 / (cos_v + 0.25), cos_v);
    vec3 f = mx_fresnel_schlick(max(1.0 - pow(albedo.y, 0.2), 1e-8));
    float ggx_compensation = (1.0 / albedo.x - 1.0) * 0.08571428 + 1.0;
    float s_second_reflection_product = albedo.x * ggx_compensation;
    float greater_2 = max(dot(s_fuzz_difference * (f * (s_second_reflection_product * 0.9) + vec3(0.1)),
        vec3(0.33333334)), 0.0);
    vec3 s_second_reflection_throughput = max(vec3(1.0) - f * s_second_reflection_product, 0.0);
    float greater_3 = max(dot(s_second_reflection_throughput * (s_fuzz_difference * 0.262), vec3(0.33333334)), 0.0);
    float sum = greater + greater_2 + greater_3;
    float pick = sum * vd.random.w;
    vec3 L = vec3(0.0);
    float inside = 0.0;
    vec3 weight = vec3(0.0);
    float density = 0.0;
    vec3 medium = vec3(1.0);
    vec3 Nf = faceforward(N, -vd.viewWorld, N);
    vec3 s_fuzz_X = vd.viewWorld + Nf.yzx * 0.00001;
    vec3 tangent = normalize(s_fuzz_X - Nf * dot(Nf, s_fuzz_X));
    vec3 s_fuzz_cross_product = cross(Nf, tangent);
    vec2 product = sqrt(vd.random.x) * cos((vd.random.y - vec2(0.0, 0.25)) * 6.2831855);
    float root = sqrt(1.0 - vd.random.x);
    float s_fuzz_c = clamp(dot(vd.viewWorld, Nf), 1e-8, 1.0);
    vec2 m = mx_sheen_transform(s_fuzz_c);
    float s_fuzz_c_2 = min(cos_v, 1.0);
    if (pick >= 0.0 && pick < greater) {
        float s_fuzz_difference_2 = product.x - root * m.y;
        vec3 s_fuzz_direction = normalize(vec3(s_fuzz_difference_2, product.y, root * m.x));
        vec3 s_fuzz_L = mat3(tangent, s_fuzz_cross_product, Nf) * s_fuzz_direction;
        L = s_fuzz_L;
        float s_fuzz_pdf = mx_sheen_zeltner(Nf, vd.viewWorld, s_fuzz_L, s_fuzz_c);
        weight = vec3(mx_sheen_albedo(cos_v) * mx_sheen_zeltner(Nf, vd.viewWorld, s_fuzz_L, s_fuzz_c_2)
            / max(s_fuzz_pdf, 1e-8) * 0.3 * (sum / greater));
        density = s_fuzz_pdf * (greater / sum);
    }
    pick += -greater;
    vec3 tangent_X = normalize(vd.tangentWorld);
    if (pick >= 0.0 && pick < greater_2) {
        vec3 s_second_reflection_L, s_second_reflection_weight;
        float s_second_reflection_pdf;
        mx_ggx_scatter(N, tangent_X, vd.viewWorld, vd.random.xyz, s_second_reflection_L, s_second_reflection_weight,
            s_second_reflection_pdf);
        L = s_second_reflection_L;
        weight = s_second_reflection_weight * (s_fuzz_difference * (sum / greater_2));
        density = s_second_reflection_pdf * (greater_2 / sum);
    }
    pick += -greater_2;
    if (pick >= 0.0 && pick < greater_3) {
        mat3 any_frame = mx_frame(Nf, abs(Nf.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
        vec3 s_medium_L = any_frame * vec3(product, root);
        L = s_medium_L;
        float s_medium_pdf = max(dot(Nf, s_medium_L), 0.0) / 3.1415927;
        weight = s_second_reflection_throughput
            * (s_fuzz_difference * (mx_chan(Nf, vd.viewWorld, s_medium_L) * 0.18 / max(s_medium_pdf, 1e-8))
            * (sum / greater_3));
        density = s_medium_pdf * (greater_3 / sum);
    }
    pick += -greater_3;
    out1 = vec4(0.0, 0.0, 0.0, 1.0);
    out2 = vec4(L, inside);
    out3 = vec4(weight, density);
    out4 = vec4(medium, 0.0);
    float nf_dot_l = dot(Nf, vd.lightWorld.xyz);
    float s_fuzz_sum = m.x * dot(tangent, vd.lightWorld.xyz) + m.y * nf_dot_l;
    vec3 w = vec3(s_fuzz_sum, m.x * dot(s_fuzz_cross_product, vd.lightWorld.xyz), nf_dot_l);
    float scale = m.x / dot(w, w);
    float slab_medium_bsdf_pdf = max(nf_dot_l, 0.0) / 3.1415927;
    float sum_2 = vd.lightWorld.w * (greater / sum * (scale * (scale * slab_medium_bsdf_pdf))) + 1.0;
    vec3 s_second_reflection_fresnel = mx_fresnel_schlick(sqrt(clamp(dot(vd.viewWorld, vd.lightWorld.xyz) * 0.5 + 0.5,
        1e-8, 1.0)));
    mat3 frame = mx_frame(Nf, tangent_X);
    float sum_3 = vd.lightWorld.w * (greater_2 / sum * mx_ggx_pdf(N, tangent_X, vd.viewWorld, vd.lightWorld.xyz)) + 1.0;
    vec3 ratio = s_second_reflection_fresnel
        * (s_fuzz_difference * (ggx_compensation * mx_ggx_smith_lobe(frame, vd.viewWorld, vd.lightWorld.xyz))) / sum_3;
    vec3 sum_4 = sheen_bsdf_albedo * mx_sheen_zeltner(Nf, vd.viewWorld, vd.lightWorld.xyz, s_fuzz_c_2) * 0.3 / sum_2
        + ratio;
    vec3 product_2 = s_second_reflection_throughput
        * (s_fuzz_difference * (mx_chan(Nf, vd.viewWorld, vd.lightWorld.xyz) * 0.18));
    out5 = vec4(sum_4 + product_2 / (vd.lightWorld.w * (greater_3 / sum * slab_medium_bsdf_pdf) + 1.0), 0.0);
    float chance = fract(vd.random.w * 4096.0);
    float sum_5 = 0.0;
    vec3 light = vec3(0.0);
    vec3 L_2 = vec3(0.0);
    float distance_ = 0.0;
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        int type = u_lightData[i].type;
        vec3 d = u_lightData[i].position - vd.positionWorld;
        float magnitude_d = length(d);
        float ratio_2 = u_lightData[i].intensity / pow(magnitude_d + 1.0, u_lightData[i].decay_rate);
        float spot_light_difference = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
        vec3 to_light = normalize(d);
        float spot_light_choice = type == 3
            ? smoothstep(spot_light_difference, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, to_light))
            * ratio_2 : 0.0;
        float point_light_choice = type == 2 ? ratio_2 : spot_light_choice;
        vec3 directional_light_L = type == 1 ? -u_lightData[i].direction : to_light;
        vec3 s_second_reflection_fresnel_2 = mx_fresnel_schlick(sqrt(clamp(dot(vd.viewWorld, directional_light_L) * 0.5
            + 0.5, 1e-8, 1.0)));
        vec3 product_3 = s_second_reflection_fresnel_2
            * (s_fuzz_difference * (ggx_compensation * mx_ggx_smith_lobe(frame, vd.viewWorld, directional_light_L)));
        vec3 sum_6 = sheen_bsdf_albedo * mx_sheen_zeltner(Nf, vd.viewWorld, directional_light_L, s_fuzz_c_2) * 0.3
            + product_3;
        vec3 sum_7 = sum_6 + s_fuzz_difference * s_second_reflection_throughput
            * (mx_chan(Nf, vd.viewWorld, directional_light_L) * 0.18);
        vec3 product_4 = u_lightData[i].color * (type == 1 ? u_lightData[i].intensity : point_light_choice) * sum_7;
        float greater_4 = max(dot(product_4, vec3(0.33333334)), 0.0);
        sum_5 += greater_4;
        if (sum_5 * chance < greater_4) {
            L_2 = directional_light_L;
            distance_ = type == 1 ? 1e30 : type == 2 ? magnitude_d : type == 3 ? magnitude_d : 1e30;
            light = product_4 / greater_4;
        }
        if (greater_4 > 0.0) {
            float ratio_3 = (sum_5 * chance - greater_4) / (sum_5 - greater_4);
            chance = sum_5 * chance < greater_4 ? sum_5 * chance / greater_4 : ratio_3;
        }
    }
    out6 = vec4(L_2, distance_);
    out7 = vec4(sum_5 * light, 0.0);
}
