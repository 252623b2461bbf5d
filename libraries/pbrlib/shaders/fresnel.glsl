// SPDX-License-Identifier: Apache-2.0
// Reflectance of smooth interfaces.
//
// An interface travels as plain parameters, which stay visible to specialisation:
//   model      one of the MX_FRESNEL_ constants
//   n, k       complex index of refraction; for Schlick the colours at 0 and at 82 degrees
//   f90        reflectance at grazing incidence
//   exponent   of the Schlick curve
//   film, film_ior   thickness in nanometres (0: no film) and index of a thin film on top

#include "frame.glsl"

const int MX_FRESNEL_DIELECTRIC = 0;
const int MX_FRESNEL_CONDUCTOR = 1;
const int MX_FRESNEL_SCHLICK = 2;

// Unpolarised Fresnel equations of a dielectric; the clamped root makes total internal reflection come out as 1.
float mx_fresnel_dielectric(float cosine, float ior)
{
    float g = sqrt(max(ior * ior + cosine * cosine - 1.0, 0.0));
    float s = (g - cosine) / (g + cosine);
    float t = ((g + cosine) * cosine - 1.0) / ((g - cosine) * cosine + 1.0);
    return 0.5 * s * s * (1.0 + t * t);
}

// R = |(x - r) / (x + r)|^2 of a complex root r with real part `re` and squared modulus `norm`.
vec3 mx_fresnel_ratio(float x, vec3 re, vec3 norm)
{
    vec3 cross_term = 2.0 * x * re;
    return (norm + x * x - cross_term) / (norm + x * x + cross_term);
}

// Fresnel equations for a complex index n + ik (PBRT 4th edition, section 9.3.6); returns the perpendicular part.
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

// Schlick's curve bent to pass through f82 at cos = 1/7 (Hoffman 2019, "Fresnel Equations Considered Harmful").
vec3 mx_fresnel_schlick(float cosine, vec3 f0, vec3 f82, vec3 f90, float exponent)
{
    const float LIFT = 17.6513846; // 7 (7/6)^6, the inverse of cos (1 - cos)^6 there
    float x = 1.0 - cosine;
    float x3 = x * x * x;
    return mix(f0, f90, pow(x, exponent))
         - mix(f0, f90, pow(6.0 / 7.0, exponent)) * (1.0 - f82) * (LIFT * cosine * x3 * x3);
}

vec3 mx_fresnel_interface(float cosine, int model, vec3 n, vec3 k, vec3 f90, float exponent)
{
    if (model == MX_FRESNEL_DIELECTRIC)
        return vec3(mx_fresnel_dielectric(cosine, n.x));
    if (model == MX_FRESNEL_SCHLICK)
        return mx_fresnel_schlick(cosine, n, k, f90, exponent);
    vec3 parallel;
    vec3 perpendicular = mx_fresnel_polarized(cosine, n, k, parallel);
    return 0.5 * (parallel + perpendicular);
}

// Thin films: Belcour and Barla 2017, "A Practical Extension to Microfacet Theory for the Modeling of Varying
// Iridescence".

// Fourier transform of the CIE XYZ sensitivities as Gaussians, for a path of `d` micrometres times 2 pi.
vec3 mx_film_sensitivity(float d, vec3 shift)
{
    return vec3(0.846590, 1.000222, 1.001122) * cos(vec3(1.6810, 1.7953, 2.2084) * d + shift)
               * exp(vec3(-0.0043278, -0.0093046, -0.0066121) * (d * d))
         + vec3(0.153868 * cos(2.2399 * d + shift.x) * exp(-0.0045282 * d * d), 0.0, 0.0);
}

// Interference of one polarisation between reflectances r12 and r23, first two terms of the series (section 3.3).
vec3 mx_film_series(float r12, vec3 r23, vec3 shift, float d)
{
    float t = 1.0 - r12;
    vec3 r = r12 * r23;
    vec3 constant = t * t * r23 / (1.0 - r);
    vec3 terms = sqrt(r) * mx_film_sensitivity(d, shift) + r * mx_film_sensitivity(2.0 * d, 2.0 * shift);
    return r12 + constant + 2.0 * (constant - t) * terms;
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

vec3 mx_fresnel_film(float cosine, int model, vec3 n, vec3 k, vec3 f90, float exponent, float film, float film_ior)
{
    const mat3 HALF_XYZ_TO_RGB = mat3(1.18533715, -0.2569425, 0.0026491, -0.45002025, 0.7126518, -0.00734745,
                                      -0.2353169, 0.0442907, 0.5046984);
    float ior = max(film_ior, 1.0);
    float inside = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));

    vec3 r12p;
    vec3 r12s = mx_fresnel_polarized(cosine, vec3(ior), vec3(0.0), r12p);
    vec3 r23p;
    vec3 r23s;
    vec3 phase_p;
    vec3 phase_s;
    if (model == MX_FRESNEL_SCHLICK)
    {
        r23p = 0.5 * mx_fresnel_schlick(inside, n, k, f90, exponent);
        r23s = r23p;
        phase_p = MX_PI * step(sqrt(clamp(n, 0.01, 0.99)), vec3((ior - 1.0) / (ior + 1.0)));
        phase_s = phase_p;
    }
    else
    {
        r23s = mx_fresnel_polarized(inside, n / ior, k / ior, r23p);
        phase_s = mx_film_phase(inside, n / ior, k / ior, phase_p);
    }

    // Below Brewster's angle the parallel part keeps its phase at the first interface, all else turns by pi.
    float shift = cosine * cosine * (1.0 + ior * ior) < 1.0 ? 0.0 : MX_PI;
    float d = 0.004 * MX_PI * ior * inside * film;
    vec3 xyz = mx_film_series(r12p.x, r23p, phase_p + shift, d) + mx_film_series(r12s.x, r23s, phase_s + MX_PI, d);
    return clamp(HALF_XYZ_TO_RGB * xyz, 0.0, 1.0);
}

vec3 mx_fresnel(float cosine, int model, vec3 n, vec3 k, vec3 f90, float exponent, float film, float film_ior)
{
    if (film > 0.0)
        return mx_fresnel_film(cosine, model, n, k, f90, exponent, film, film_ior);
    return mx_fresnel_interface(cosine, model, n, k, f90, exponent);
}
