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
// A tilt is (cos, sin) of the angle to the section of the hair, a turn (cos, sin) of an angle around the hair. Angles add up as complex
// numbers multiply.

// The sum of two angles, each as (cos, sin).
vec2 mx_hair_add(vec2 a, vec2 b)
{
    return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

// The angle of a sine, as (cos, sin).
vec2 mx_hair_tilt(float sine)
{
    return vec2(sqrt(max(1.0 - sine * sine, 0.0)), sine);
}

float mx_hair_width(float roughness)
{
    return clamp(roughness, 0.001, 1.0);
}

// Longitudinal scattering M_p from the tilt i to the tilt o, with the variance `roughness` (d'Eon et al. 2011,
// equation 7).
//
// 2 sinh(k) is exp(k) (1 - exp(-2 k)). The program fits/bessel.c makes the constants of Bessel's function times
// exp(-x).
float mx_hair_longitudinal(vec2 i, vec2 o, float roughness)
{
    float k = 1.0 / mx_hair_width(roughness);
    float x = abs(k * i.x * o.x);
    float bessel = sqrt((1.0 + x * (0.3840 + x * 0.5689)) / (1.0 + x * (2.5181 + x * (1.9457 + x * 2.0 * MX_PI * 0.5689))));
    return k * bessel * exp(x - k * (i.y * o.y + 1.0)) / (1.0 - exp(-2.0 * k));
}

// Azimuthal scattering N_p: a logistic around 0, trimmed to one turn (Chiang et al. 2016, appendix A).
//
// The angle is twice the arcsine of half a chord (Abramowitz and Stegun 1964, equation 4.4.45).
float mx_hair_azimuthal(vec2 turn, float roughness)
{
    float s = 0.626657 * mx_hair_width(roughness); // sqrt(pi / 8)
    float chord = 0.5 * length(turn - vec2(1.0, 0.0));
    float arc = 1.5707288 + chord * (-0.2121144 + chord * (0.0742610 - 0.0187293 * chord));
    float f = exp((2.0 * sqrt(max(1.0 - chord, 0.0)) * arc - MX_PI) / s);
    float tail = exp(-MX_PI / s);
    return f * (1.0 + tail) / (s * (1.0 + f) * (1.0 + f) * (1.0 - tail));
}

// The lobe for a viewer: how light enters and crosses the circular section.
struct mx_HairLobe {
    vec3 N;          // faces the viewer
    vec3 x;          // unit tangent along the hair
    vec3 v;          // the viewer in the frame
    vec2 slope;      // of the scales of the cuticle, as a tilt
    vec2 crossing;   // turn by one crossing
    float reflected; // part where light enters
    vec3 through;    // part that one crossing lets through
};

// How light from a viewer enters the hair and crosses its circular section.
mx_HairLobe mx_hair_lobe(float ior, float cuticle_angle, vec3 absorption, vec3 N, vec3 curve_direction, vec3 V)
{
    vec3 Nf = mx_facing(N, V);
    vec3 x = mx_tangent(Nf, curve_direction);
    vec3 v = mx_enter_frame(V, Nf, x);
    float slope = (cuticle_angle - 0.5) * MX_PI;
    vec2 entry = v.zy / max(length(v.yz), MX_EPSILON);
    float cos_o = mx_hair_tilt(v.x).x;
    float sin_t = clamp(entry.y * max(cos_o, MX_EPSILON) * inversesqrt(max(ior * ior - v.x * v.x, MX_EPSILON)), -1.0, 1.0);
    float cos_t = mx_hair_tilt(sin_t).x;
    return mx_HairLobe(Nf, x, v, vec2(cos(slope), sin(slope)), vec2(2.0 * sin_t * sin_t - 1.0, -2.0 * sin_t * cos_t),
                       mx_fresnel_dielectric(cos_o * entry.x, ior), exp(absorption * (-2.0 * cos_t / mx_hair_tilt(v.x / ior).x)));
}

// The parts A_p of the light by path: R, TT, TRT, and all longer ones (Chiang et al. 2016, section 3.3).
struct mx_HairParts {
    vec3 R;
    vec3 TT;
    vec3 TRT;
    vec3 longer;
};

// Parts A_p of the light by path: R, TT, TRT, and all longer ones (Chiang et al. 2016, section 3.3).
mx_HairParts mx_hair_parts(mx_HairLobe lobe, vec3 tint_R, vec3 tint_TT, vec3 tint_TRT)
{
    float entered = 1.0 - lobe.reflected;
    vec3 crossed = entered * entered * lobe.through;
    vec3 again = lobe.reflected * lobe.through;
    vec3 TRT = max(tint_TRT, 0.0) * crossed * again;
    return mx_HairParts(max(tint_R, 0.0) * lobe.reflected, max(tint_TT, 0.0) * crossed, TRT, TRT * again / (1.0 - again));
}

// A tilt, as (cos, sin), after the cuticle changed it on path p (Chiang et al. 2016, section 3.4).
vec2 mx_hair_tilted(int p, vec2 tilt, vec2 slope)
{
    vec2 twice = mx_hair_add(slope, slope);
    vec2 four = mx_hair_add(twice, twice);
    vec2 turn = p == 0 ? twice : p == 1 ? vec2(slope.x, -slope.y) : p == 2 ? vec2(four.x, -four.y) : vec2(1.0, 0.0);
    return mx_hair_add(tilt, turn);
}

// M_p N_p of the paths from l, where `tilted` is the tilt of l or of the viewer, and `other` that of the other one.
vec4 mx_hair_densities(mx_HairLobe lobe, vec3 l, vec2 tilted, vec2 other, vec2 roughness_R, vec2 roughness_TT, vec2 roughness_TRT)
{
    vec2 turn_R = mx_hair_add(l.yz, -lobe.v.yz) / max(tilted.x * other.x, MX_EPSILON);
    vec2 turn_TT = mx_hair_add(turn_R, lobe.crossing);
    vec2 s = lobe.slope;
    return vec4(mx_hair_longitudinal(mx_hair_tilted(0, tilted, s), other, roughness_R.x) * mx_hair_azimuthal(turn_R, roughness_R.y),
                mx_hair_longitudinal(mx_hair_tilted(1, tilted, s), other, roughness_TT.x) * mx_hair_azimuthal(turn_TT, roughness_TT.y),
                mx_hair_longitudinal(mx_hair_tilted(2, tilted, s), other, roughness_TRT.x)
                    * mx_hair_azimuthal(mx_hair_add(turn_TT, lobe.crossing), roughness_TRT.y),
                mx_hair_longitudinal(tilted, other, roughness_TRT.x) * 0.5 / MX_PI);
}

vec3 mx_hair_light(mx_HairLobe lobe, vec3 tint_R, vec3 tint_TT, vec3 tint_TRT, vec2 roughness_R, vec2 roughness_TT,
                   vec2 roughness_TRT, vec3 L)
{
    vec3 l = mx_enter_frame(L, lobe.N, lobe.x);
    mx_HairParts parts = mx_hair_parts(lobe, tint_R, tint_TT, tint_TRT);
    vec4 d = mx_hair_densities(lobe, l, mx_hair_tilt(l.x), mx_hair_tilt(lobe.v.x), roughness_R, roughness_TT, roughness_TRT);
    return (parts.R * d.x + parts.TT * d.y + parts.TRT * d.z + parts.longer * d.w) / MX_PI;
}

vec3 mx_chiang_hair_bsdf_eval(vec3 tint_R, vec3 tint_TT, vec3 tint_TRT, float ior, vec2 roughness_R, vec2 roughness_TT, vec2 roughness_TRT,
                              float cuticle_angle, vec3 absorption, vec3 N, vec3 curve_direction, vec3 V, vec3 L)
{
    return mx_hair_light(mx_hair_lobe(ior, cuticle_angle, absorption, N, curve_direction, V), tint_R, tint_TT, tint_TRT, roughness_R,
                         roughness_TT, roughness_TRT, L);
}

// M_p and N_p are densities, but for the tilt of M_p: what is left are the paths' parts.
vec3 mx_chiang_hair_bsdf_albedo(vec3 tint_R, vec3 tint_TT, vec3 tint_TRT, float ior, vec2 roughness_R, vec2 roughness_TT,
                                vec2 roughness_TRT, float cuticle_angle, vec3 absorption, vec3 N, vec3 curve_direction, vec3 V)
{
    mx_HairLobe lobe = mx_hair_lobe(ior, cuticle_angle, absorption, N, curve_direction, V);
    mx_HairParts parts = mx_hair_parts(lobe, tint_R, tint_TT, tint_TRT);
    return (parts.R + parts.TT + parts.TRT + parts.longer) / MX_PI;
}

// A path is chosen by its mean part.
vec4 mx_hair_chances(mx_HairParts parts)
{
    const vec3 mean = vec3(1.0 / 3.0);
    return max(vec4(dot(parts.R, mean), dot(parts.TT, mean), dot(parts.TRT, mean), dot(parts.longer, mean)), MX_EPSILON);
}

// The paths tilt V instead of L, so that M_p stays a density.
float mx_chiang_hair_bsdf_pdf(vec3 tint_R, vec3 tint_TT, vec3 tint_TRT, float ior, vec2 roughness_R, vec2 roughness_TT, vec2 roughness_TRT,
                              float cuticle_angle, vec3 absorption, vec3 N, vec3 curve_direction, vec3 V, vec3 L)
{
    mx_HairLobe lobe = mx_hair_lobe(ior, cuticle_angle, absorption, N, curve_direction, V);
    vec3 l = mx_enter_frame(L, lobe.N, lobe.x);
    vec4 chances = mx_hair_chances(mx_hair_parts(lobe, tint_R, tint_TT, tint_TRT));
    vec4 d = mx_hair_densities(lobe, l, mx_hair_tilt(lobe.v.x), mx_hair_tilt(l.x), roughness_R, roughness_TT, roughness_TRT);
    return dot(chances, d) / dot(chances, vec4(1.0));
}

// M_p after d'Eon et al. 2013, "Importance Sampling for Physically-Based Hair Fiber Models", N_p by inversion; xi.z chooses the path,
// and what is left of it the angle around the cone of M_p.
void mx_chiang_hair_bsdf_sample(vec3 tint_R, vec3 tint_TT, vec3 tint_TRT, float ior, vec2 roughness_R, vec2 roughness_TT,
                                vec2 roughness_TRT, float cuticle_angle, vec3 absorption, vec3 N, vec3 curve_direction, vec3 V, vec3 xi,
                                out vec3 L, out vec3 weight, out float pdf)
{
    mx_HairLobe lobe = mx_hair_lobe(ior, cuticle_angle, absorption, N, curve_direction, V);
    vec4 chances = mx_hair_chances(mx_hair_parts(lobe, tint_R, tint_TT, tint_TRT));
    float chosen = xi.z * dot(chances, vec4(1.0));
    int p = 0;
    for (; p < 3 && chosen >= chances[p]; ++p)
        chosen -= chances[p];
    float around = clamp(chosen / chances[p], 0.0, 1.0);

    vec2 roughness = p == 0 ? roughness_R : p == 1 ? roughness_TT : roughness_TRT;
    vec2 o = mx_hair_tilted(p, mx_hair_tilt(lobe.v.x), lobe.slope);
    float width = mx_hair_width(roughness.x);
    float cone = clamp(1.0 + width * log(max(xi.x + (1.0 - xi.x) * exp(-2.0 / width), 1e-30)), -1.0, 1.0);
    float sin_i = clamp(-cone * o.y + mx_hair_tilt(cone).x * cos(2.0 * MX_PI * around) * o.x, -1.0, 1.0);

    float s = 0.626657 * mx_hair_width(roughness.y); // as in mx_hair_azimuthal
    float tail = 1.0 / (1.0 + exp(MX_PI / s));
    float phi = p == 3 ? 2.0 * MX_PI * xi.y : -s * log(1.0 / mix(tail, 1.0 - tail, xi.y) - 1.0);
    phi -= atan(-lobe.v.z, -lobe.v.y) + float(p) * atan(lobe.crossing.y, lobe.crossing.x); // path R mirrors the azimuth of V
    L = mx_leave_frame(vec3(sin_i, mx_hair_tilt(sin_i).x * cos(phi), mx_hair_tilt(sin_i).x * sin(phi)), lobe.N, lobe.x);

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
    if (option_path == 1 && option_environment == 2)
    {
        vec3 L, weight;
        float pdf;
        mx_chiang_hair_bsdf_sample(tint_R, tint_TT, tint_TRT, ior, roughness_R, roughness_TT, roughness_TRT, cuticle_angle,
                                   absorption, N, curve_direction, V, mx_lobe_random(sample_index), L, weight, pdf);
        return mx_lobe_light(L, weight, pdf);
    }
    return (tint_R + tint_TT + tint_TRT) / 3.0
         * mx_ggx_environment((roughness_R + roughness_TT + roughness_TRT) / 3.0, "ggx", false, N, curve_direction, V, sample_index, sample_turn,
                              "dielectric", vec3(ior), vec3(0.0), vec3(1.0), 0.0, 0.0, 1.0);
}
