// SPDX-License-Identifier: Apache-2.0
// Reflectance of smooth interfaces.
//
// An interface travels as plain parameters, which stay visible to specialisation:
//   model            "dielectric", "conductor" or "schlick"
//   n, k             complex index of refraction; for Schlick the colours at 0 and at 82 degrees
//   f90              reflectance at grazing incidence
//   exponent         of Schlick's curve
//   film, film_ior   thickness in nanometres and index of a thin film on top; thickness 0 is no film

#include "frame.glsl"

// ---- bare interfaces ------------------------------------------------------------------------------------------------

// Unpolarised Fresnel equations of a dielectric; the clamped root makes total internal reflection come out as 1.
float mx_fresnel_dielectric(float cosine, float ior)
{
    float g = sqrt(max(ior * ior + cosine * cosine - 1.0, 0.0));
    vec2 a = cosine * vec2(1.0, ior * ior);
    vec2 r = (a - g) / (a + g);
    return 0.5 * dot(r, r);
}

// The index n + ik times the cosine behind its interface: (u + iv)^2 = (n + ik)^2 - sin^2.
void mx_fresnel_refract(float cosine, vec3 n, vec3 k, out vec3 u, out vec3 v)
{
    vec3 t = n * n - k * k + (cosine * cosine - 1.0);
    vec3 norm = sqrt(t * t + 4.0 * n * n * k * k);
    u = sqrt(max(0.5 * (norm + t), 0.0));
    v = sqrt(max(0.5 * (norm - t), 0.0));
}

// Reflectance and phase of the amplitude (x + iy - u - iv) / (x + iy + u + iv).
vec3 mx_fresnel_amplitude(vec3 x, vec3 y, vec3 u, vec3 v, out vec3 phase)
{
    vec3 a = x - u;
    vec3 b = y - v;
    vec3 c = x + u;
    vec3 d = y + v;
    phase = atan(b * c - a * d, a * c + b * d);
    return (a * a + b * b) / (c * c + d * d);
}

// Fresnel equations for the index n + ik (Pharr et al. 2023, section 9.3.6): reflectance and phase of the perpendicular part,
// where the cosine, and of the parallel part, where (n + ik)^2 times the cosine stands against u + iv.
vec3 mx_fresnel_polarized(float cosine, vec3 n, vec3 k, out vec3 phase, out vec3 parallel, out vec3 parallel_phase)
{
    vec3 u;
    vec3 v;
    mx_fresnel_refract(cosine, n, k, u, v);
    parallel = mx_fresnel_amplitude(cosine * (n * n - k * k), 2.0 * cosine * n * k, u, v, parallel_phase);
    return mx_fresnel_amplitude(vec3(cosine), vec3(0.0), u, v, phase);
}

vec3 mx_fresnel_conductor(float cosine, vec3 n, vec3 k)
{
    vec3 phase;
    vec3 parallel;
    vec3 parallel_phase;
    vec3 perpendicular = mx_fresnel_polarized(cosine, n, k, phase, parallel, parallel_phase);
    return 0.5 * (perpendicular + parallel);
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

// XYZ after interference of one polarisation: amplitude `a` of the film's own interface, reflectance and phase of the one
// behind it; two terms of the series (section 3.3).
vec3 mx_film_series(float a, vec3 r23, vec3 phase, float d)
{
    float r12 = a * a;
    float t = 1.0 - r12;
    vec3 r = r12 * r23;
    vec3 shift = phase + (a > 0.0 ? MX_PI : 0.0); // from behind, the amplitude is -a
    vec3 constant = t * t * r23 / (1.0 - r);
    vec3 terms = sqrt(r) * mx_film_sensitivity(d, shift) + r * mx_film_sensitivity(2.0 * d, 2.0 * shift);
    return r12 + constant + 2.0 * (constant - t) * terms;
}

// Cosine inside of a film.
float mx_film_cosine(float cosine, float ior)
{
    return sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
}

// Reflectance of a film in front of an interface with the given perpendicular and parallel parts.
vec3 mx_film(float cosine, float film, float ior, vec3 r, vec3 phase, vec3 parallel, vec3 parallel_phase)
{
    const mat3 XYZ_TO_RGB = mat3(2.3706743, -0.5138850, 0.0052982, -0.9000405, 1.4253036, -0.0146949,
                                 -0.4706338, 0.0885814, 1.0093968);
    float inside = mx_film_cosine(cosine, ior);
    vec2 a = vec2(cosine, ior * cosine);
    vec2 b = vec2(ior * inside, inside);
    vec2 amplitude = (a - b) / (a + b);
    float d = 0.004 * MX_PI * ior * inside * film; // what the light travels further
    vec3 xyz = mx_film_series(amplitude.x, r, phase, d) + mx_film_series(amplitude.y, parallel, parallel_phase, d);
    return clamp(XYZ_TO_RGB * (0.5 * xyz), 0.0, 1.0);
}

vec3 mx_film_index(float cosine, vec3 n, vec3 k, float film, float film_ior)
{
    float ior = max(film_ior, 1.0);
    vec3 phase;
    vec3 parallel;
    vec3 parallel_phase;
    vec3 r = mx_fresnel_polarized(mx_film_cosine(cosine, ior), n / ior, k / ior, phase, parallel, parallel_phase);
    return mx_film(cosine, film, ior, r, phase, parallel, parallel_phase);
}

// A colour has no phase; light turns where its colour says that the index behind the film is lower.
vec3 mx_film_schlick(float cosine, vec3 f0, vec3 f82, vec3 f90, float exponent, float film, float film_ior)
{
    float ior = max(film_ior, 1.0);
    vec3 r = 0.5 * mx_fresnel_schlick(mx_film_cosine(cosine, ior), f0, f82, f90, exponent);
    vec3 phase = MX_PI * step(sqrt(clamp(f0, 0.01, 0.99)), vec3((ior - 1.0) / (ior + 1.0)));
    return mx_film(cosine, film, ior, r, phase + MX_PI, r, phase);
}

// ---- all of them ----------------------------------------------------------------------------------------------------

vec3 mx_fresnel(float cosine, string model, vec3 n, vec3 k, vec3 f90, float exponent, float film, float film_ior)
{
    if (model == "schlick")
        return film > 0.0 ? mx_film_schlick(cosine, n, k, f90, exponent, film, film_ior)
                          : mx_fresnel_schlick(cosine, n, k, f90, exponent);
    if (film > 0.0)
        return mx_film_index(cosine, n, k, film, film_ior);
    return model == "dielectric" ? vec3(mx_fresnel_dielectric(cosine, n.x)) : mx_fresnel_conductor(cosine, n, k);
}

// Reflectance facing the viewer of the bare interface.
vec3 mx_fresnel_f0(string model, vec3 n, vec3 k)
{
    vec3 a = n - 1.0;
    vec3 b = n + 1.0;
    return model == "schlick" ? n : (a * a + k * k) / (b * b + k * k);
}
