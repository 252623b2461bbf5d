// SPDX-License-Identifier: Apache-2.0
// Reflectance of smooth interfaces.
//
// An interface travels as plain parameters, which stay visible to specialisation:
//   model            one of the MX_FRESNEL_ constants
//   n, k             complex index of refraction; for Schlick the colours at 0 and at 82 degrees
//   f90              reflectance at grazing incidence
//   exponent         of Schlick's curve
//   film, film_ior   thickness in nanometres and index of a thin film on top; thickness 0 is no film

#include "frame.glsl"

const int MX_FRESNEL_DIELECTRIC = 0;
const int MX_FRESNEL_CONDUCTOR = 1;
const int MX_FRESNEL_SCHLICK = 2;

// ---- bare interfaces ------------------------------------------------------------------------------------------------

// Unpolarised Fresnel equations of a dielectric; the clamped root makes total internal reflection come out as 1.
float mx_fresnel_dielectric(float cosine, float ior)
{
    float g = sqrt(max(ior * ior + cosine * cosine - 1.0, 0.0));
    vec2 a = cosine * vec2(1.0, ior * ior);
    vec2 r = (a - g) / (a + g);
    return 0.5 * dot(r, r);
}

// |(x - z) / (x + z)|^2 for a complex z with real part `re` and squared modulus `norm`.
vec3 mx_fresnel_ratio(float x, vec3 re, vec3 norm)
{
    vec3 twice = 2.0 * x * re;
    return (norm + x * x - twice) / (norm + x * x + twice);
}

// Fresnel equations for the index n + ik (Pharr et al. 2023, section 9.3.6); returns the perpendicular reflectance.
vec3 mx_fresnel_polarized(float cosine, vec3 n, vec3 k, out vec3 parallel)
{
    float sine2 = 1.0 - cosine * cosine;
    vec3 t = n * n - k * k - sine2;
    vec3 norm = sqrt(t * t + 4.0 * n * n * k * k);
    vec3 re = sqrt(max(0.5 * (norm + t), 0.0));
    vec3 perpendicular = mx_fresnel_ratio(cosine, re, norm);
    parallel = perpendicular * mx_fresnel_ratio(sine2 / cosine, re, norm);
    return perpendicular;
}

// Schlick's curve bent towards f82 at cos = 1/7 (Hoffman 2019, "Fresnel Equations Considered Harmful").
vec3 mx_fresnel_schlick(float cosine, vec3 f0, vec3 f82, vec3 f90, float exponent)
{
    const float LIFT = 17.6513846; // 7 (7/6)^6, the inverse of cos (1 - cos)^6 there
    float x = 1.0 - cosine;
    float x3 = x * x * x;
    return mix(f0, f90, pow(x, exponent))
         - mix(f0, f90, pow(6.0 / 7.0, exponent)) * (1.0 - f82) * (LIFT * cosine * x3 * x3);
}

// ---- thin films -----------------------------------------------------------------------------------------------------
// Belcour and Barla 2017, "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence".

// Fourier transform of the CIE XYZ sensitivities, a sum of Gaussians; the path d is in units of 1/(2 pi) micrometre.
vec3 mx_film_sensitivity(float d, vec3 shift)
{
    return vec3(0.846590, 1.000222, 1.001122) * cos(vec3(1.6810, 1.7953, 2.2084) * d + shift)
               * exp(vec3(-0.0043278, -0.0093046, -0.0066121) * (d * d))
         + vec3(0.153868 * cos(2.2399 * d + shift.x) * exp(-0.0045282 * d * d), 0.0, 0.0);
}

// XYZ after interference of one polarisation between reflectances r12 and r23: two terms of the series (section 3.3).
vec3 mx_film_series(float r12, vec3 r23, vec3 shift, float d)
{
    float t = 1.0 - r12;
    vec3 r = r12 * r23;
    vec3 constant = t * t * r23 / (1.0 - r);
    vec3 terms = sqrt(r) * mx_film_sensitivity(d, shift) + r * mx_film_sensitivity(2.0 * d, 2.0 * shift);
    return r12 + constant + 2.0 * (constant - t) * terms;
}

vec3 mx_film_rgb(vec3 xyz)
{
    const mat3 XYZ_TO_RGB = mat3(2.3706743, -0.5138850, 0.0052982, -0.9000405, 1.4253036, -0.0146949,
                                 -0.4706338, 0.0885814, 1.0093968);
    return clamp(XYZ_TO_RGB * xyz, 0.0, 1.0);
}

// Path that light travels further in the film, where it goes at `cosine`.
float mx_film_path(float cosine, float film, float ior)
{
    return 0.004 * MX_PI * ior * cosine * film;
}

// Phase shifts of a reflection off n + ik; returns the perpendicular one.
vec3 mx_film_phase(float cosine, vec3 n, vec3 k, out vec3 parallel)
{
    vec3 t = n * n - k * k + cosine * cosine - 1.0;
    vec3 norm = sqrt(t * t + 4.0 * n * n * k * k);
    vec3 re = sqrt(0.5 * (norm + t));
    vec3 im = sqrt(max(0.5 * (norm - t), 0.0));
    vec3 s = (n * n + k * k) * cosine;
    parallel = atan(2.0 * cosine * (2.0 * n * k * re - (n * n - k * k) * im), s * s - norm);
    return atan(2.0 * cosine * im, norm - cosine * cosine);
}

// A colour has no phase; light turns where its colour says that the index behind the film is lower.
vec3 mx_film_schlick_phase(vec3 f0, float ior)
{
    return MX_PI * step(sqrt(clamp(f0, 0.01, 0.99)), vec3((ior - 1.0) / (ior + 1.0)));
}

vec3 mx_fresnel_film(float cosine, int model, vec3 n, vec3 k, vec3 f90, float exponent, float film, float film_ior)
{
    float ior = max(film_ior, 1.0);
    float inside = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
    float d = mx_film_path(inside, film, ior);
    vec3 p12;
    vec3 s12 = mx_fresnel_polarized(cosine, vec3(ior), vec3(0.0), p12);

    // Below Brewster's angle the parallel part keeps its phase at the first interface, all else turns by pi.
    float turn = cosine * cosine * (1.0 + ior * ior) < 1.0 ? 0.0 : MX_PI;
    if (model == MX_FRESNEL_SCHLICK)
    {
        vec3 r = 0.5 * mx_fresnel_schlick(inside, n, k, f90, exponent);
        vec3 phase = mx_film_schlick_phase(n, ior);
        return mx_film_rgb(0.5 * mx_film_series(p12.x, r, phase + turn, d)
                         + 0.5 * mx_film_series(s12.x, r, phase + MX_PI, d));
    }
    vec3 p23;
    vec3 s23 = mx_fresnel_polarized(inside, n / ior, k / ior, p23);
    vec3 phase_p;
    vec3 phase_s = mx_film_phase(inside, n / ior, k / ior, phase_p);
    return mx_film_rgb(0.5 * mx_film_series(p12.x, p23, phase_p + turn, d)
                     + 0.5 * mx_film_series(s12.x, s23, phase_s + MX_PI, d));
}

// ---- all of them ----------------------------------------------------------------------------------------------------

vec3 mx_fresnel(float cosine, int model, vec3 n, vec3 k, vec3 f90, float exponent, float film, float film_ior)
{
    if (film > 0.0)
        return mx_fresnel_film(cosine, model, n, k, f90, exponent, film, film_ior);
    if (model == MX_FRESNEL_DIELECTRIC)
        return vec3(mx_fresnel_dielectric(cosine, n.x));
    if (model == MX_FRESNEL_SCHLICK)
        return mx_fresnel_schlick(cosine, n, k, f90, exponent);
    vec3 parallel;
    vec3 perpendicular = mx_fresnel_polarized(cosine, n, k, parallel);
    return 0.5 * (parallel + perpendicular);
}

// Reflectance facing the viewer of the bare interface.
vec3 mx_fresnel_f0(int model, vec3 n, vec3 k)
{
    return model == MX_FRESNEL_SCHLICK ? n : mx_fresnel_ratio(1.0, n, n * n + k * k);
}

// mx_fresnel for cosine 1, where both polarisations are alike.
vec3 mx_fresnel_facing(int model, vec3 n, vec3 k, float film, float film_ior)
{
    if (film <= 0.0)
        return mx_fresnel_f0(model, n, k);
    float ior = max(film_ior, 1.0);
    vec3 r;
    vec3 phase;
    if (model == MX_FRESNEL_SCHLICK)
    {
        r = 0.5 * n;
        phase = mx_film_schlick_phase(n, ior);
    }
    else
    {
        vec3 norm = (n * n + k * k) / (ior * ior);
        r = mx_fresnel_ratio(1.0, n / ior, norm);
        phase = atan(2.0 * k / ior, norm - 1.0);
    }
    float r12 = (ior - 1.0) / (ior + 1.0);
    return mx_film_rgb(mx_film_series(r12 * r12, r, phase + MX_PI, mx_film_path(1.0, film, ior)));
}
