// SPDX-License-Identifier: Apache-2.0
// chiang_hair_bsdf and what chooses its parameters: Chiang et al. 2016, "A Practical and Controllable Hair and Fur
// Model for Production Path Tracing", built on d'Eon et al. 2011, "An Energy-Conserving Hair Reflectance Model".

#include "ggx.glsl"
#include "sampling.glsl"

// ---- parameters -----------------------------------------------------------------------------------------------------

// d'Eon et al. 2011, section 6.1: pigments as colours exp(-absorption).
vec3 mx_deon_hair_absorption_from_melanin(float melanin_concentration, float melanin_redness, vec3 eumelanin_color, vec3 pheomelanin_color)
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
void mx_chiang_hair_roughness(float longitudinal, float azimuthal, float scale_TT, float scale_TRT, out vec2 roughness_R,
                              out vec2 roughness_TT, out vec2 roughness_TRT)
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
    for (int i = 1; i < 16; ++i)
    {
        term *= x * x / (4.0 * float(i * i));
        sum += term;
    }
    return sum;
}

// Longitudinal scattering M_p (d'Eon et al. 2011, equation 7) between tilts given as (sin, cos), through logarithms: 2 sinh(1/v) is
// exp(1/v) (1 - exp(-2/v)). Bessel's function of a large argument is asymptotic.
float mx_hair_longitudinal(vec2 i, vec2 o, float v)
{
    float a = i.y * o.y / v;
    float log_bessel = a > 12.0 ? a + 0.125 / a - 0.5 * log(2.0 * MX_PI * a) : log(mx_hair_bessel(a));
    return exp(log_bessel - (i.x * o.x + 1.0) / v) / (v * (1.0 - exp(-2.0 / v)));
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

// Azimuths where the light of v enters the circular section (x) and, refracted, crosses it (y); reflectance there, and what a
// crossing lets through.
vec2 mx_hair_section(vec3 v, float ior, vec3 absorption, out float reflected, out vec3 through)
{
    float cos_o = mx_hair_cosine(v.x);
    float sin_o = -v.y / max(length(v.yz), MX_EPSILON);
    float ior_seen = sqrt(max(ior * ior - v.x * v.x, 0.0)) / max(cos_o, MX_EPSILON);
    float sin_t = clamp(sin_o / ior_seen, -1.0, 1.0);
    through = exp(-2.0 * absorption * (mx_hair_cosine(sin_t) / mx_hair_cosine(v.x / ior)));
    reflected = mx_fresnel_dielectric(cos_o * mx_hair_cosine(sin_o), ior);
    return asin(vec2(sin_o, sin_t));
}

// The part A_p of the light on path p: R, TT, TRT, and all longer ones as the fourth (Chiang et al. 2016, section 3.3).
vec3 mx_hair_attenuation(int p, vec3 tint_R, vec3 tint_TT, vec3 tint_TRT, float reflected, vec3 through)
{
    vec3 crossed = (1.0 - reflected) * (1.0 - reflected) * through;
    vec3 again = reflected * through;
    vec3 longer = p == 2 ? again : again * again / (1.0 - again);
    return p == 0 ? max(tint_R, 0.0) * reflected
         : p == 1 ? max(tint_TT, 0.0) * crossed : max(tint_TRT, 0.0) * crossed * longer;
}

vec2 mx_hair_width(int p, vec2 roughness_R, vec2 roughness_TT, vec2 roughness_TRT)
{
    return clamp(p == 0 ? roughness_R : p == 1 ? roughness_TT : roughness_TRT, 0.001, 1.0);
}

// (sin, cos) of a tilt, turned by the slope that the cuticle's scales have on path p.
vec2 mx_hair_tilt(int p, float sine, float cuticle_angle)
{
    float angle = (p < 3 ? 2.0 - 3.0 * float(p) : 0.0) * (cuticle_angle - 0.5) * MX_PI;
    vec2 tilt = vec2(sine, mx_hair_cosine(sine));
    return tilt * cos(angle) + vec2(tilt.y, -tilt.x) * sin(angle);
}

float mx_hair_mean(vec3 color)
{
    return max(dot(color, vec3(1.0 / 3.0)), MX_EPSILON);
}

// N_p for azimuth phi of L around V.
float mx_hair_around(int p, float phi, vec2 gamma, float roughness)
{
    float direct = phi - float(p) * (2.0 * gamma.y + MX_PI) + 2.0 * gamma.x;
    return p == 3 ? 0.5 / MX_PI : mx_hair_azimuthal(direct, roughness);
}

vec3 mx_chiang_hair_bsdf_eval(vec3 tint_R, vec3 tint_TT, vec3 tint_TRT, float ior, vec2 roughness_R, vec2 roughness_TT, vec2 roughness_TRT,
                              float cuticle_angle, vec3 absorption, vec3 N, vec3 curve_direction, vec3 V, vec3 L)
{
    vec3 Nf = mx_facing(N, V);
    vec3 x = mx_tangent(Nf, curve_direction);
    vec3 v = mx_enter_frame(V, Nf, x);
    vec3 l = mx_enter_frame(L, Nf, x);
    float phi = atan(l.z * v.y - v.z * l.y, l.y * v.y + l.z * v.z);
    float reflected;
    vec3 through;
    vec2 gamma = mx_hair_section(v, ior, absorption, reflected, through);
    vec3 sum = vec3(0.0);
    for (int p = 0; p < 4; ++p)
    {
        vec2 width = mx_hair_width(p, roughness_R, roughness_TT, roughness_TRT);
        sum += mx_hair_attenuation(p, tint_R, tint_TT, tint_TRT, reflected, through)
             * (mx_hair_longitudinal(mx_hair_tilt(p, l.x, cuticle_angle), vec2(v.x, mx_hair_cosine(v.x)), width.x)
                * mx_hair_around(p, phi, gamma, width.y));
    }
    return sum / MX_PI;
}

// M_p and N_p are densities, but for the tilt of M_p: what is left are the paths' parts.
vec3 mx_chiang_hair_bsdf_albedo(vec3 tint_R, vec3 tint_TT, vec3 tint_TRT, float ior, vec2 roughness_R, vec2 roughness_TT,
                                vec2 roughness_TRT, float cuticle_angle, vec3 absorption, vec3 N, vec3 curve_direction, vec3 V)
{
    float reflected;
    vec3 through;
    mx_hair_section(V * mx_frame(mx_facing(N, V), curve_direction), ior, absorption, reflected, through);
    vec3 sum = vec3(0.0);
    for (int p = 0; p < 4; ++p)
        sum += mx_hair_attenuation(p, tint_R, tint_TT, tint_TRT, reflected, through);
    return sum / MX_PI;
}

// A path is chosen by its mean part, and tilts V instead of L, so that M_p stays a density.
float mx_chiang_hair_bsdf_pdf(vec3 tint_R, vec3 tint_TT, vec3 tint_TRT, float ior, vec2 roughness_R, vec2 roughness_TT, vec2 roughness_TRT,
                              float cuticle_angle, vec3 absorption, vec3 N, vec3 curve_direction, vec3 V, vec3 L)
{
    mat3 frame = mx_frame(mx_facing(N, V), curve_direction);
    vec3 v = V * frame;
    vec3 l = L * frame;
    float phi = atan(l.z * v.y - v.z * l.y, l.y * v.y + l.z * v.z);
    float reflected;
    vec3 through;
    vec2 gamma = mx_hair_section(v, ior, absorption, reflected, through);
    vec2 sum = vec2(0.0);
    for (int p = 0; p < 4; ++p)
    {
        vec2 width = mx_hair_width(p, roughness_R, roughness_TT, roughness_TRT);
        float density = mx_hair_longitudinal(vec2(l.x, mx_hair_cosine(l.x)), mx_hair_tilt(p, v.x, cuticle_angle), width.x)
                      * mx_hair_around(p, phi, gamma, width.y);
        sum += mx_hair_mean(mx_hair_attenuation(p, tint_R, tint_TT, tint_TRT, reflected, through)) * vec2(density, 1.0);
    }
    return sum.x / sum.y;
}

// M_p after d'Eon et al. 2013, "Importance Sampling for Physically-Based Hair Fiber Models", N_p by inversion; xi.z chooses the path,
// and what is left of it the angle around the cone of M_p.
void mx_chiang_hair_bsdf_sample(vec3 tint_R, vec3 tint_TT, vec3 tint_TRT, float ior, vec2 roughness_R, vec2 roughness_TT,
                                vec2 roughness_TRT, float cuticle_angle, vec3 absorption, vec3 N, vec3 curve_direction, vec3 V, vec3 xi,
                                out vec3 L, out vec3 weight, out float pdf)
{
    mat3 frame = mx_frame(mx_facing(N, V), curve_direction);
    vec3 v = V * frame;
    float reflected;
    vec3 through;
    vec2 gamma = mx_hair_section(v, ior, absorption, reflected, through);
    vec4 ends; // of the paths' ranges in xi.z
    float end = 0.0;
    for (int q = 0; q < 4; ++q)
    {
        end += mx_hair_mean(mx_hair_attenuation(q, tint_R, tint_TT, tint_TRT, reflected, through));
        ends[q] = end;
    }
    float chosen = xi.z * end;
    int p = chosen < ends.x ? 0 : chosen < ends.y ? 1 : chosen < ends.z ? 2 : 3;
    float begin = p == 0 ? 0.0 : ends[p - 1];
    float turn = (chosen - begin) / (ends[p] - begin);

    vec2 width = mx_hair_width(p, roughness_R, roughness_TT, roughness_TRT);
    vec2 o = mx_hair_tilt(p, v.x, cuticle_angle);
    float cone = clamp(1.0 + width.x * log(max(xi.x + (1.0 - xi.x) * exp(-2.0 / width.x), 1e-30)), -1.0, 1.0);
    float sin_i = clamp(-cone * o.x + mx_hair_cosine(cone) * cos(2.0 * MX_PI * turn) * o.y, -1.0, 1.0);

    float s = 0.626657 * width.y; // as in mx_hair_azimuthal
    float tail = 1.0 / (1.0 + exp(MX_PI / s));
    float phi = float(p) * (2.0 * gamma.y + MX_PI) - 2.0 * gamma.x - s * log(1.0 / mix(tail, 1.0 - tail, xi.y) - 1.0);
    if (p == 3)
        phi = 2.0 * MX_PI * xi.y;
    phi += atan(v.z, v.y);
    L = frame * vec3(sin_i, mx_hair_cosine(sin_i) * cos(phi), mx_hair_cosine(sin_i) * sin(phi));

    pdf = mx_chiang_hair_bsdf_pdf(tint_R, tint_TT, tint_TRT, ior, roughness_R, roughness_TT, roughness_TRT,
                                  cuticle_angle, absorption, N, curve_direction, V, L);
    weight = mx_chiang_hair_bsdf_eval(tint_R, tint_TT, tint_TRT, ior, roughness_R, roughness_TT, roughness_TRT,
                                      cuticle_angle, absorption, N, curve_direction, V, L)
           / max(pdf, MX_EPSILON);
}

// A rough dielectric stands in for the lobes where they are not sampled.
vec3 mx_chiang_hair_bsdf_environment(vec3 tint_R, vec3 tint_TT, vec3 tint_TRT, float ior, vec2 roughness_R, vec2 roughness_TT,
                                     vec2 roughness_TRT, float cuticle_angle, vec3 absorption, vec3 N, vec3 curve_direction, vec3 V,
                                     int sample_index, vec2 sample_turn)
{
    if (option_integrator == 1 && option_environment == 2)
    {
        vec3 L, weight;
        float pdf;
        mx_chiang_hair_bsdf_sample(tint_R, tint_TT, tint_TRT, ior, roughness_R, roughness_TT, roughness_TRT, cuticle_angle,
                                   absorption, N, curve_direction, V, mx_lobe_random(sample_index), L, weight, pdf);
        return mx_lobe_light(L, weight, pdf);
    }
    return (tint_R + tint_TT + tint_TRT) / 3.0 * mx_ggx_environment((roughness_R + roughness_TT + roughness_TRT) / 3.0, N, curve_direction,
                                                                    V, sample_index, sample_turn, "dielectric", vec3(ior), vec3(0.0),
                                                                    vec3(1.0), 0.0, 0.0, 1.0);
}
