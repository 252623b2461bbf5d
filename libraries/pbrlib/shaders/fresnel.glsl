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
vec2 mx_fresnel_refract(float cosine, float n, float k)
{
    float t = n * n - k * k + (cosine * cosine - 1.0);
    float norm = sqrt(t * t + 4.0 * n * n * k * k);
    return sqrt(max(0.5 * vec2(norm + t, norm - t), 0.0));
}

// |(x + iy - u - iv) / (x + iy + u + iv)|^2
float mx_fresnel_ratio(vec2 x, vec2 u)
{
    return dot(x - u, x - u) / dot(x + u, x + u);
}

// Fresnel equations for the index n + ik (Pharr et al. 2023, section 9.3.6): against u + iv stands the cosine in the
// perpendicular part, (n + ik)^2 times the cosine in the parallel part.
float mx_fresnel_conductor(float cosine, float n, float k)
{
    vec2 u = mx_fresnel_refract(cosine, n, k);
    return 0.5 * (mx_fresnel_ratio(vec2(cosine, 0.0), u)
                + mx_fresnel_ratio(cosine * vec2(n * n - k * k, 2.0 * n * k), u));
}

// One channel after the other, which needs a third of the registers.
vec3 mx_fresnel_conductor(float cosine, vec3 n, vec3 k)
{
    return vec3(mx_fresnel_conductor(cosine, n.x, k.x), mx_fresnel_conductor(cosine, n.y, k.y),
                mx_fresnel_conductor(cosine, n.z, k.z));
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

// The channels of XYZ come one after the other, which needs a third of the registers. In each vec2 stand both polarisations:
// perpendicular, parallel.

// The CIE sensitivities, sums of Gaussians, after a Fourier transform: (frequency, height, -1 / width). X has two.
const vec3 MX_FILM_X = vec3(1.6810, 0.846590, -0.0043278);
const vec3 MX_FILM_X2 = vec3(2.2399, 0.153868, -0.0045282);
const vec3 MX_FILM_Y = vec3(1.7953, 1.000222, -0.0093046);
const vec3 MX_FILM_Z = vec3(2.2084, 1.001122, -0.0066121);

// Two terms of the series (section 3.3) for one Gaussian: amplitude `a` of the film's own interface, which from behind is -a, and
// re + i im of the one below, and light that goes further by d / (2 pi) micrometre. The second term is of the first one's square:
// its distance is twice as long.
vec2 mx_film_terms(vec2 a, vec2 re, vec2 im, float d, vec3 gauss)
{
    float c = cos(gauss.x * d);
    float s = sin(gauss.x * d);
    float decay = exp(gauss.z * d * d);
    vec2 x = re * c - im * s;
    vec2 y = re * s + im * c;
    return gauss.y * decay * a * (a * (decay * decay * decay) * (x * x - y * y) - x);
}

// A channel after interference, the mean of both polarisations.
float mx_film_channel(vec2 a, vec2 re, vec2 im, vec2 terms)
{
    vec2 r23 = re * re + im * im;
    vec2 t = 1.0 - a * a;
    vec2 even = t * t * r23 / (1.0 - a * a * r23);
    vec2 both = a * a + even + 2.0 * (even - t) * terms;
    return 0.5 * (both.x + both.y);
}

// Cosine inside of the film.
float mx_film_cosine(float cosine, float ior)
{
    return sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
}

// Amplitudes of the film's own interface.
vec2 mx_film_amplitudes(float cosine, float inside, float ior)
{
    vec2 x = vec2(cosine, ior * cosine);
    vec2 u = vec2(ior * inside, inside);
    return (x - u) / (x + u);
}

// Amplitudes re + i im of the interface below: (x + iy - u - iv) / (x + iy + u + iv), as in mx_fresnel_conductor.
void mx_film_base(float cosine, float n, float k, out vec2 re, out vec2 im)
{
    vec2 u = mx_fresnel_refract(cosine, n, k);
    vec2 x = cosine * vec2(1.0, n * n - k * k);
    vec2 y = vec2(0.0, 2.0 * cosine * n * k);
    vec2 norm = (x + u.x) * (x + u.x) + (y + u.y) * (y + u.y);
    re = (x * x + y * y - dot(u, u)) / norm;
    im = 2.0 * (y * u.x - x * u.y) / norm;
}

vec3 mx_film_rgb(vec3 xyz)
{
    const mat3 XYZ_TO_RGB = mat3(2.3706743, -0.5138850, 0.0052982, -0.9000405, 1.4253036, -0.0146949,
                                 -0.4706338, 0.0885814, 1.0093968);
    return clamp(XYZ_TO_RGB * xyz, 0.0, 1.0);
}

// A film on the index n + ik.
vec3 mx_film_index(float cosine, vec3 n, vec3 k, float film, float film_ior)
{
    float ior = max(film_ior, 1.0);
    float c = mx_film_cosine(cosine, ior);
    vec2 a = mx_film_amplitudes(cosine, c, ior);
    float d = 0.004 * MX_PI * ior * c * film;
    vec2 re, im;
    mx_film_base(c, n.x / ior, k.x / ior, re, im);
    float x = mx_film_channel(a, re, im, mx_film_terms(a, re, im, d, MX_FILM_X) + mx_film_terms(a, re, im, d, MX_FILM_X2));
    mx_film_base(c, n.y / ior, k.y / ior, re, im);
    float y = mx_film_channel(a, re, im, mx_film_terms(a, re, im, d, MX_FILM_Y));
    mx_film_base(c, n.z / ior, k.z / ior, re, im);
    float z = mx_film_channel(a, re, im, mx_film_terms(a, re, im, d, MX_FILM_Z));
    return mx_film_rgb(vec3(x, y, z));
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
    vec2 none = vec2(0.0);
    vec2 re = vec2(-r.x, r.x);
    float x = mx_film_channel(a, re, none, mx_film_terms(a, re, none, d, MX_FILM_X) + mx_film_terms(a, re, none, d, MX_FILM_X2));
    re = vec2(-r.y, r.y);
    float y = mx_film_channel(a, re, none, mx_film_terms(a, re, none, d, MX_FILM_Y));
    re = vec2(-r.z, r.z);
    return mx_film_rgb(vec3(x, y, mx_film_channel(a, re, none, mx_film_terms(a, re, none, d, MX_FILM_Z))));
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
