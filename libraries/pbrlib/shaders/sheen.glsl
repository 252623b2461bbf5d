// SPDX-License-Identifier: Apache-2.0
// sheen_bsdf: Conty and Kulla 2017, or Zeltner, Burley and Chiang 2022.

#include "environment.glsl"
#include "sampling.glsl"

// Directional albedo of the sheen lobe at the cosine c of the viewer.
//
// For Conty and Kulla by the program fits/sheen.c, for Zeltner et al. their Gaussian fit.
float mx_sheen_albedo(float c, float roughness, string mode)
{
    if (mode == "conty_kulla")
    {
        const mat4 FIT = mat4(3.7341, -15.9587, 23.6210, -11.0989, -8.2265, 35.1081, -49.7137, 23.2945,
                              4.0691, -17.8820, 25.6639, -12.0167, -0.5833, 2.6552, -3.9393, 1.8999);
        return clamp(mx_bicubic(FIT, 1.0 / (1.0 + c), 1.0 / (0.2 + roughness)), 0.0, 1.0);
    }
    float r = clamp(roughness, 0.01, 1.0);
    float width = r * (0.0206607 + 1.58491 * r) / (0.0379424 + r * (1.32227 + r));
    float mean = r * (-0.193854 + r * (-1.14885 + r * (1.7932 - 0.95943 * r * r))) / (0.046391 + r);
    float offset = r * (0.000654023 + r * (-0.0207818 + 0.119681 * r)) / (1.26264 + r * (-1.92021 + r));
    float x = (c - mean) / width;
    return max(exp(-0.5 * x * x) / (width * sqrt(2.0 * MX_PI)) + offset, 0.0);
}

// The numbers a and b of the linear transform that makes the sheen lobe of roughness r, at the cosine c of the
// viewer, of a clamped cosine (Zeltner, Burley and Chiang 2022):
//     M^-1 = [a 0 b; 0 a 0; 0 0 1] in the plane of V and N
vec2 mx_sheen_transform(float c, float r)
{
    return vec2((2.58126 * c + 0.813703 * r) * r / (1.0 + 0.310327 * c * c + 2.60994 * c * r),
                sqrt(1.0 - c) * (r - 1.0) * r * r * r
                    / (0.0000254053 + 1.71228 * c - 1.71506 * c * r + 1.34174 * r * r));
}

// Axes of the tangent space around N with V above x.
mat3 mx_sheen_frame(vec3 N, vec3 V)
{
    return mx_frame(N, V + 1e-5 * N.yzx);
}

// The sheen lobe of roughness r from L to V, where V has the cosine c (Zeltner, Burley and Chiang 2022).
float mx_sheen_zeltner(vec3 N, vec3 V, vec3 L, float c, float r)
{
    vec2 m = mx_sheen_transform(c, r);
    vec3 l = mx_enter_frame(L, N, mx_tangent(N, V + 1e-5 * N.yzx));
    vec3 w = vec3(m.x * l.x + m.y * l.z, m.x * l.y, l.z);
    float scale = m.x / dot(w, w);
    return max(w.z, 0.0) / MX_PI * scale * scale;
}

vec3 mx_sheen_bsdf_eval(vec3 color, float roughness, vec3 N, string mode, vec3 V, vec3 L)
{
    vec3 Nf = mx_facing(N, V);
    float cos_v = mx_view_cosine(N, V);
    if (mode == "zeltner")
        return color * (mx_sheen_albedo(cos_v, roughness, mode)
                        * mx_sheen_zeltner(Nf, V, L, min(cos_v, 1.0), clamp(roughness, 0.01, 1.0)));

    // Distribution of Conty and Kulla, equation 2, over the smooth denominator of Neubelt and Pettineo 2013
    float cos_l = max(dot(Nf, L), MX_EPSILON);
    float along = dot(Nf, L) + cos_v; // the half vector's, before it is scaled to length 1
    float s = 1.0 / max(roughness, 0.005);
    float d = (2.0 + s) * pow(clamp(1.0 - along * along / max(2.0 + 2.0 * dot(L, V), MX_EPSILON), 0.0, 1.0), 0.5 * s) / (2.0 * MX_PI);
    return color * (d * cos_l / (4.0 * (cos_l + cos_v - cos_l * cos_v)));
}

vec3 mx_sheen_bsdf_albedo(vec3 color, float roughness, vec3 N, string mode, vec3 V)
{
    return color * mx_sheen_albedo(mx_view_cosine(N, V), roughness, mode);
}

vec3 mx_sheen_bsdf_throughput(vec3 color, float roughness, vec3 N, string mode, vec3 V)
{
    return vec3(1.0 - mx_sheen_albedo(mx_view_cosine(N, V), roughness, mode));
}

// Zeltner's lobe as it is; Conty and Kulla's is so wide that even directions serve it (their section 3).
float mx_sheen_bsdf_pdf(vec3 color, float roughness, vec3 N, string mode, vec3 V, vec3 L)
{
    vec3 Nf = mx_facing(N, V);
    if (mode == "zeltner")
        return mx_sheen_zeltner(Nf, V, L, clamp(dot(Nf, V), MX_EPSILON, 1.0), clamp(roughness, 0.01, 1.0));
    return dot(Nf, L) > 0.0 ? 0.5 / MX_PI : 0.0;
}

void mx_sheen_bsdf_sample(vec3 color, float roughness, vec3 N, string mode, vec3 V, vec3 xi, out vec3 L, out vec3 weight, out float pdf)
{
    vec3 Nf = mx_facing(N, V);
    if (mode == "zeltner")
    {
        vec2 m = mx_sheen_transform(clamp(dot(Nf, V), MX_EPSILON, 1.0), clamp(roughness, 0.01, 1.0));
        vec3 w = mx_sample_cosine(xi.xy);
        L = mx_sheen_frame(Nf, V) * normalize(vec3(w.x - m.y * w.z, w.y, m.x * w.z));
    }
    else
    {
        L = mx_any_frame(Nf) * vec3(mx_polar(sqrt(1.0 - xi.x * xi.x), xi.y), xi.x);
    }
    pdf = mx_sheen_bsdf_pdf(color, roughness, N, mode, V, L);
    weight = mx_sheen_bsdf_eval(color, roughness, N, mode, V, L) / max(pdf, MX_EPSILON);
}

vec3 mx_sheen_bsdf_environment(vec3 color, float roughness, vec3 N, string mode, vec3 V, int sample_index)
{
    if (option_path == 1 && option_environment == 2)
    {
        vec3 L, weight;
        float pdf;
        mx_sheen_bsdf_sample(color, roughness, N, mode, V, mx_lobe_random(sample_index), L, weight, pdf);
        return mx_lobe_light(L, weight, pdf);
    }
    return mx_sheen_bsdf_albedo(color, roughness, N, mode, V) * mx_environment_irradiance(mx_facing(N, V));
}
