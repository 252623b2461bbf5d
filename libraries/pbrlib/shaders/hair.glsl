// SPDX-License-Identifier: Apache-2.0
// chiang_hair_bsdf and what chooses its parameters: Chiang et al. 2016, "A Practical and Controllable Hair and Fur
// Model for Production Path Tracing", built on d'Eon et al. 2011, "An Energy-Conserving Hair Reflectance Model".

#include "ggx.glsl"

// ---- parameters -----------------------------------------------------------------------------------------------------

// d'Eon et al. 2011, section 6.1: pigments as colours exp(-absorption).
vec3 mx_deon_hair_absorption_from_melanin(float melanin_concentration, float melanin_redness, vec3 eumelanin_color,
                                          vec3 pheomelanin_color)
{
    float melanin = -log(max(1.0 - melanin_concentration, 0.0001));
    return max(-melanin * mix(log(eumelanin_color), log(pheomelanin_color), melanin_redness), 0.0);
}

// Chiang et al. 2016, equation 9.
vec3 mx_chiang_hair_absorption_from_color(vec3 color, float azimuthal_roughness)
{
    float b = azimuthal_roughness;
    float scale = 5.969 + b * (-0.215 + b * (2.532 + b * (-10.73 + b * (5.574 + b * 0.245))));
    vec3 s = log(clamp(color, 0.001, 1.0)) / scale;
    return s * s;
}

// Chiang et al. 2016, equations 7 and 8: variance along the hair, logistic scale around it.
void mx_chiang_hair_roughness(float longitudinal, float azimuthal, float scale_TT, float scale_TRT,
                              out vec2 roughness_R, out vec2 roughness_TT, out vec2 roughness_TRT)
{
    float m = clamp(longitudinal, 0.001, 1.0);
    float n = clamp(azimuthal, 0.001, 1.0);
    float v = 0.726 * m + 0.812 * m * m + 3.7 * pow(m, 20.0);
    float s = 0.265 * n + 1.194 * n * n + 5.372 * pow(n, 22.0);
    roughness_R = vec2(v * v, s);
    roughness_TT = vec2(v * v * scale_TT * scale_TT, s);
    roughness_TRT = vec2(v * v * scale_TRT * scale_TRT, s);
}

// ---- scattering -----------------------------------------------------------------------------------------------------

float mx_hair_cosine(float sine)
{
    return sqrt(max(1.0 - sine * sine, 0.0));
}

// Modified Bessel function of the first kind, by its power series.
float mx_hair_bessel(float x)
{
    float term = 1.0;
    float sum = 1.0;
    for (int i = 1; i < 10; ++i)
    {
        term *= x * x / (4.0 * float(i * i));
        sum += term;
    }
    return sum;
}

// Longitudinal scattering M_p (d'Eon et al. 2011, equation 7) between tilts given as (sin, cos); small variances v
// are taken through logarithms.
float mx_hair_longitudinal(vec2 i, vec2 o, float v)
{
    float a = i.y * o.y / v;
    float b = i.x * o.x / v;
    if (v >= 0.1)
        return exp(-b) * mx_hair_bessel(a) / (2.0 * v * sinh(1.0 / v));
    float log_bessel = a > 12.0 ? a + 0.5 * (1.0 / (8.0 * a) - log(2.0 * MX_PI * a)) : log(mx_hair_bessel(a));
    return exp(log_bessel - b - 1.0 / v + 0.6931 + log(0.5 / v));
}

// Azimuthal scattering N_p: a logistic around 0, trimmed to one turn (Chiang et al. 2016, appendix A).
float mx_hair_azimuthal(float angle, float roughness)
{
    float s = 0.626657 * roughness; // sqrt(pi / 8)
    float x = abs(mod(angle + MX_PI, 2.0 * MX_PI) - MX_PI);
    float f = exp(-x / s);
    float tail = exp(-MX_PI / s);
    return f * (1.0 + tail) / (s * (1.0 + f) * (1.0 + f) * (1.0 - tail));
}

vec3 mx_chiang_hair_bsdf_eval(vec3 tint_R, vec3 tint_TT, vec3 tint_TRT, float ior, vec2 roughness_R,
                              vec2 roughness_TT, vec2 roughness_TRT, float cuticle_angle, vec3 absorption, vec3 N,
                              vec3 curve_direction, vec3 V, vec3 L)
{
    vec3 n = mx_facing(N, V);
    vec3 x = mx_tangent(n, curve_direction);
    vec3 v = mx_enter_frame(V, n, x);
    vec3 l = mx_enter_frame(L, n, x);
    vec2 o = vec2(v.x, mx_hair_cosine(v.x));
    float phi = atan(l.z * v.y - v.z * l.y, l.y * v.y + l.z * v.z);

    // Azimuths where the light enters (o) and, refracted, crosses (t) the circular section
    float sin_o = -v.y / max(length(v.yz), MX_EPSILON);
    float ior_seen = sqrt(max(ior * ior - o.x * o.x, 0.0)) / max(o.y, MX_EPSILON);
    float sin_t = clamp(sin_o / ior_seen, -1.0, 1.0);
    float gamma_o = asin(sin_o);
    float gamma_t = asin(sin_t);
    vec3 through = exp(-2.0 * absorption * (mx_hair_cosine(sin_t) / mx_hair_cosine(o.x / ior)));
    float f = mx_fresnel_dielectric(o.y * mx_hair_cosine(sin_o), ior);

    // R, TT, TRT and the rest: their attenuation A_p, widths, and the tilt of the cuticle scales
    vec3 attenuation = max(tint_R, 0.0) * f;
    vec2 width = roughness_R;
    float tilt = 2.0;
    vec3 sum = vec3(0.0);
    for (int p = 0; p < 4; ++p)
    {
        vec2 w = clamp(width, 0.001, 1.0);
        float angle = tilt * (cuticle_angle - 0.5) * MX_PI;
        vec2 i = vec2(l.x, mx_hair_cosine(l.x));
        i = i * cos(angle) + vec2(i.y, -i.x) * sin(angle);
        float n = 0.5 / MX_PI;
        if (p < 3)
            n = mx_hair_azimuthal(phi - float(p) * (2.0 * gamma_t + MX_PI) + 2.0 * gamma_o, w.y);
        sum += attenuation * (mx_hair_longitudinal(i, o, w.x) * n);

        tilt = p < 2 ? tilt - 3.0 : 0.0;
        width = p == 0 ? roughness_TT : roughness_TRT;
        if (p == 0)
            attenuation = max(tint_TT, 0.0) * (1.0 - f) * (1.0 - f) * through;
        else
            attenuation = max(tint_TRT, 0.0) * (1.0 - f) * (1.0 - f) * f * through * through;
        if (p == 2)
            attenuation *= f * through / (1.0 - f * through);
    }
    return sum / MX_PI;
}

// A rough dielectric stands in for the lobes.
vec3 mx_chiang_hair_bsdf_environment(vec3 tint_R, vec3 tint_TT, vec3 tint_TRT, float ior, vec2 roughness_R,
                                     vec2 roughness_TT, vec2 roughness_TRT, float cuticle_angle, vec3 absorption,
                                     vec3 N, vec3 curve_direction, vec3 V, int sample_index)
{
    return (tint_R + tint_TT + tint_TRT) / 3.0
         * mx_ggx_environment((roughness_R + roughness_TT + roughness_TRT) / 3.0, N, curve_direction, V,
                              "dielectric", vec3(ior), vec3(0.0), vec3(1.0), 0.0, 0.0, 1.0, sample_index);
}
