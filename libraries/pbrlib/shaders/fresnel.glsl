// SPDX-License-Identifier: Apache-2.0
// Reflectance of smooth interfaces.
//
// An interface travels as plain parameters, which stay visible to specialisation:
//   model            "dielectric", "conductor" or "schlick"
//   n, k             complex index of refraction; for Schlick the colour facing the viewer and mx_schlick_bend
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

// |(x + iy - u - iv) / (x + iy + u + iv)|^2
vec3 mx_fresnel_ratio(vec3 x, vec3 y, vec3 u, vec3 v)
{
    return ((x - u) * (x - u) + (y - v) * (y - v)) / ((x + u) * (x + u) + (y + v) * (y + v));
}

// Fresnel equations for the index n + ik (Pharr et al. 2023, section 9.3.6): against u + iv stands the cosine in the
// perpendicular part, (n + ik)^2 times the cosine in the parallel part.
vec3 mx_fresnel_conductor(float cosine, vec3 n, vec3 k)
{
    vec3 u, v;
    mx_fresnel_refract(cosine, n, k, u, v);
    return 0.5 * (mx_fresnel_ratio(vec3(cosine), vec3(0.0), u, v)
                + mx_fresnel_ratio(cosine * (n * n - k * k), 2.0 * cosine * n * k, u, v));
}

// What bends Schlick's curve towards f82 at cos = 1/7 (Hoffman 2019, "Fresnel Equations Considered Harmful"): the factor of cos (1 - cos)^6.
vec3 mx_schlick_bend(vec3 f0, vec3 f82, vec3 f90, float exponent)
{
    const float LIFT = 17.6513846; // 7 (7/6)^6, the inverse of cos (1 - cos)^6 there
    return mix(max(f0, 0.0), max(f90, 0.0), pow(6.0 / 7.0, exponent)) * (1.0 - max(f82, 0.0)) * LIFT;
}

vec3 mx_fresnel_schlick(float cosine, vec3 f0, vec3 bend, vec3 f90, float exponent)
{
    float x = 1.0 - cosine;
    float x3 = x * x * x;
    return mix(f0, f90, exponent == 5.0 ? x3 * x * x : pow(x, exponent)) - bend * (cosine * x3 * x3);
}

// ---- thin films -----------------------------------------------------------------------------------------------------
// Belcour and Barla 2017, "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence".

// XYZ of light that has gone further by d / (2 pi) micrometre and changed by the amplitude re + i im: the Fourier transform
// of the CIE sensitivities, a sum of Gaussians.
vec3 mx_film_response(float d, vec3 re, vec3 im)
{
    vec4 a = vec4(1.6810, 1.7953, 2.2084, 2.2399) * d;
    vec4 g = vec4(0.846590, 1.000222, 1.001122, 0.153868)
           * exp(vec4(-0.0043278, -0.0093046, -0.0066121, -0.0045282) * (d * d));
    vec4 xyzx = g * (vec4(re, re.x) * cos(a) - vec4(im, im.x) * sin(a));
    return xyzx.xyz + vec3(xyzx.w, 0.0, 0.0);
}

// XYZ after interference of one polarisation: real amplitude `a` of the film's own interface, which from behind is -a, and
// re + i im of the one below; two terms of the series (section 3.3).
vec3 mx_film_series(float a, vec3 re, vec3 im, float d)
{
    vec3 r23 = re * re + im * im;
    float r12 = a * a;
    float t = 1.0 - r12;
    vec3 constant = t * t * r23 / (1.0 - r12 * r23);
    vec3 terms = r12 * mx_film_response(2.0 * d, re * re - im * im, 2.0 * re * im) - a * mx_film_response(d, re, im);
    return r12 + constant + 2.0 * (constant - t) * terms;
}

// The same with the amplitude (x + iy - u - iv) / (x + iy + u + iv).
vec3 mx_film_polarized(float a, vec3 x, vec3 y, vec3 u, vec3 v, float d)
{
    vec3 norm = (x + u) * (x + u) + (y + v) * (y + v);
    return mx_film_series(a, (x * x + y * y - u * u - v * v) / norm, 2.0 * (y * u - x * v) / norm, d);
}

// Cosine inside of the film.
float mx_film_cosine(float cosine, float ior)
{
    return sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
}

// Amplitudes of the film's own interface: perpendicular, parallel.
vec2 mx_film_amplitudes(float cosine, float inside, float ior)
{
    vec2 x = vec2(cosine, ior * cosine);
    vec2 u = vec2(ior * inside, inside);
    return (x - u) / (x + u);
}

// Mean of both polarisations.
vec3 mx_film_rgb(vec3 perpendicular, vec3 parallel)
{
    const mat3 XYZ_TO_RGB = mat3(2.3706743, -0.5138850, 0.0052982, -0.9000405, 1.4253036, -0.0146949,
                                 -0.4706338, 0.0885814, 1.0093968);
    return clamp(XYZ_TO_RGB * (0.5 * (perpendicular + parallel)), 0.0, 1.0);
}

// A film on the index n + ik.
vec3 mx_film_index(float cosine, vec3 n, vec3 k, float film, float film_ior)
{
    float ior = max(film_ior, 1.0);
    float c = mx_film_cosine(cosine, ior);
    vec2 a = mx_film_amplitudes(cosine, c, ior);
    float d = 0.004 * MX_PI * ior * c * film;
    vec3 m = n / ior;
    vec3 l = k / ior;
    vec3 u, v;
    mx_fresnel_refract(c, m, l, u, v);
    return mx_film_rgb(mx_film_polarized(a.x, vec3(c), vec3(0.0), u, v, d),
                       mx_film_polarized(a.y, c * (m * m - l * l), 2.0 * c * m * l, u, v, d));
}

// A film on a colour, which has no phase: light turns where its colour says that the index behind the film is lower.
vec3 mx_film_schlick(float cosine, vec3 f0, vec3 bend, vec3 f90, float exponent, float film, float film_ior)
{
    float ior = max(film_ior, 1.0);
    float c = mx_film_cosine(cosine, ior);
    vec2 a = mx_film_amplitudes(cosine, c, ior);
    float d = 0.004 * MX_PI * ior * c * film;
    vec3 turn = 1.0 - 2.0 * step(sqrt(clamp(f0, 0.01, 0.99)), vec3((ior - 1.0) / (ior + 1.0)));
    vec3 r = turn * sqrt(max(0.5 * mx_fresnel_schlick(c, f0, bend, f90, exponent), 0.0));
    return mx_film_rgb(mx_film_series(a.x, -r, vec3(0.0), d), mx_film_series(a.y, r, vec3(0.0), d));
}

// ---- all of them ----------------------------------------------------------------------------------------------------

vec3 mx_fresnel_bare(float cosine, string model, vec3 n, vec3 k, vec3 f90, float exponent)
{
    if (model == "schlick")
        return mx_fresnel_schlick(cosine, n, k, f90, exponent);
    return model == "dielectric" ? vec3(mx_fresnel_dielectric(cosine, n.x)) : mx_fresnel_conductor(cosine, n, k);
}

vec3 mx_fresnel(float cosine, string model, vec3 n, vec3 k, vec3 f90, float exponent, float film, float film_ior)
{
    if (film > 0.0)
        return model == "schlick" ? mx_film_schlick(cosine, n, k, f90, exponent, film, film_ior)
                                  : mx_film_index(cosine, n, k, film, film_ior);
    return mx_fresnel_bare(cosine, model, n, k, f90, exponent);
}

// Reflectance facing the viewer of the bare interface.
vec3 mx_fresnel_f0(string model, vec3 n, vec3 k)
{
    return model == "schlick" ? n : mx_fresnel_bare(1.0, model, n, k, vec3(1.0), 0.0);
}
