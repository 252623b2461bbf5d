// SPDX-License-Identifier: Apache-2.0
// Reflectance of smooth interfaces.
//
// An interface travels as plain parameters, which stay visible to specialisation:
//   model            "dielectric", "conductor" or "schlick"
//   n, k             index of refraction and 0; of conductors the permittivity, real and imaginary; for Schlick the colour facing the viewer
//                    and mx_schlick_bend
//   f90              reflectance at grazing incidence
//   exponent         of Schlick's curve
//   film, film_ior   thickness in nanometres and index of a thin film on top; thickness 0 is no film

#include "frame.glsl"

// ---- bare interfaces ------------------------------------------------------------------------------------------------

// Unpolarised reflectance of an interface whose squared index is `re`, with c for the cosine in front of it:
//     F = ((c - g)^2 / (c + g)^2) (1 + (cg - s)^2 / (cg + s)^2) / 2
//     s = 1 - c^2,  g^2 = c^2 + 2k,  2k = re - 1
//
// g is the cosine behind the interface, times the index. Since (c - g)(c + g) = -2k, all of it is over one square,
// with one root. The least c^2 makes total internal reflection come out as 1.
float mx_fresnel_permittivity(float cosine, float re)
{
    float k = 0.5 * (re - 1.0);
    float c2 = mx_known(re >= 1.0) ? cosine * cosine : max(cosine * cosine, -2.0 * k);
    float s = 1.0 - c2;
    float cg2 = c2 * (c2 + 2.0 * k);
    float divisor = (1.0 + k) * (c2 + sqrt(cg2)) + k;
    float r = k / (mx_known(re > 1.0) ? divisor : max(divisor, MX_EPSILON));
    return (cg2 + s * s) * (r * r);
}

// Unpolarised reflectance of a dielectric at a cosine.
float mx_fresnel_dielectric(float cosine, float ior)
{
    return mx_fresnel_permittivity(cosine, ior * ior);
}

// Reflectance of a dielectric that faces the viewer.
float mx_fresnel_dielectric_facing(float ior)
{
    float r = (1.0 - ior) / (1.0 + ior);
    return r * r;
}

// The square of the complex index n + ik: re + i im.
//
// It is all that the equations need.
void mx_permittivity(vec3 n, vec3 k, out vec3 re, out vec3 im)
{
    re = n * n - k * k;
    im = 2.0 * n * k;
}

// The index times the cosine behind an interface, u + iv, from the cosine in front of it and the permittivity:
//     (u + iv)^2 = re + i im - sin^2
vec2 mx_fresnel_refract(float cosine, float re, float im)
{
    float t = re + (cosine * cosine - 1.0);
    float norm = sqrt(t * t + im * im);
    return sqrt(max(0.5 * vec2(norm + t, norm - t), 0.0));
}

// Unpolarised reflectance of an interface with the permittivity re + i im, with c for the cosine and u + iv for the
// index times the cosine behind (Born and Wolf 1999, "Principles of Optics", section 14.4):
//     F = (P + P Q) / 2,  P = (a - g) / (a + g),  Q = (b - g s) / (b + g s)
//     a = |u + iv|^2 + c^2,  g = 2uc,  s = 1 - c^2,  b = |u + iv|^2 c^2 + s^2
float mx_fresnel_conductor(float cosine, float re, float im)
{
    if (mx_known(im == 0.0))
        return mx_fresnel_permittivity(cosine, re);
    float c2 = cosine * cosine;
    float s = 1.0 - c2;
    float t = re - s;
    float norm = sqrt(t * t + im * im);
    float g = cosine * sqrt(max(2.0 * (norm + t), 0.0));
    float b = norm * c2 + s * s;
    float a = norm + c2;
    return (a - g) * b / ((a + g) * (b + g * s));
}

// Unpolarised reflectance of a conductor with the permittivity re + i im of each channel.
//
// One channel after the other needs a third of the registers.
vec3 mx_fresnel_conductor(float cosine, vec3 re, vec3 im)
{
    if (mx_known(re.x == re.y) && mx_known(re.y == re.z) && mx_known(im.x == im.y) && mx_known(im.y == im.z))
        return vec3(mx_fresnel_conductor(cosine, re.x, im.x));
    vec3 color = vec3(0.0);
    for (int i = 0; i < 3; ++i)
        color[i] = mx_fresnel_conductor(cosine, re[i], im[i]);
    return color;
}

// The factor of cos (1 - cos)^6 that bends Schlick's curve so that f82 tints it at cos = 1/7 (Hoffman 2019,
// "Fresnel Equations Considered Harmful").
vec3 mx_schlick_bend(vec3 f0, vec3 f82, vec3 f90, float exponent)
{
    const float LIFT = 17.6513846; // 7 (7/6)^6, the inverse of cos (1 - cos)^6 there
    return mix(max(f0, 0.0), max(f90, 0.0), pow(6.0 / 7.0, exponent)) * (1.0 - max(f82, 0.0)) * LIFT;
}

// Schlick's curve from f0 to f90 at a cosine, less `bend` times cos (1 - cos)^6.
vec3 mx_fresnel_schlick(float cosine, vec3 f0, vec3 bend, vec3 f90, float exponent)
{
    float x = 1.0 - cosine;
    float x3 = x * x * x;
    return mix(f0, f90, exponent == 5.0 ? x3 * x * x : pow(x, exponent)) - bend * (cosine * x3 * x3);
}

// ---- thin films -----------------------------------------------------------------------------------------------------
// Belcour and Barla 2017, "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence".

// The CIE sensitivities, sums of Gaussians, after a Fourier transform: (frequency, height, -1 / width, 0). X is the sum of two.
const mat4 MX_FILM_GAUSSIANS = mat4(1.6810, 0.846202, -0.0043278, 0.0, // X
                                    2.2399, 0.153798, -0.0045282, 0.0,
                                    1.7953, 1.0, -0.0093046, 0.0,  // Y
                                    2.2084, 1.0, -0.0066121, 0.0); // Z

// Light of one polarisation that interferes in a film, as Gaussian i of the CIE curves sees it: `a` is the amplitude
// of the film's interface, r that of the interface below, and light in the film goes further by d / (2 pi) micrometres.
//
// From behind, the film's own interface has the amplitude -a. Path m of Airy's series is z^m D^(m^2), with the decay D.
// From the second path on, it is summed as a geometric series, z^2 D^4 / (1 - z D^5): paths one to three are exact.
// `path` is the real part of z D, and `square` the square of its length.
float mx_film_light(float a, vec2 r, float d, int i)
{
    vec4 gaussian = MX_FILM_GAUSSIANS[i];
    float decay = exp(gaussian.z * d * d);
    float d2 = decay * decay;
    float d4 = d2 * d2;
    float r23 = dot(r, r);
    float path = -a * decay * (r.x * cos(gaussian.x * d) - r.y * sin(gaussian.x * d));
    float square = a * a * r23 * d2;
    float rest = (2.0 * path * path - square - d4 * square * path) / (1.0 - 2.0 * d4 * path + d4 * d4 * square);
    float t = 1.0 - a * a;
    float even = t * t * r23 / (1.0 - a * a * r23);
    return gaussian.y * (a * a + even + 2.0 * (even - t) * (path + d2 * rest));
}

// Cosine inside of a film of index `ior`.
float mx_film_cosine(float cosine, float ior)
{
    return sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
}

// Amplitudes of a film's own interface, of perpendicular and parallel light; `inside` is the cosine in the film.
vec2 mx_film_amplitudes(float cosine, float inside, float ior)
{
    vec2 x = vec2(cosine, ior * cosine);
    vec2 u = vec2(ior * inside, inside);
    return (x - u) / (x + u);
}

// Complex amplitude (x - u) / (x + u) of an interface in one polarisation: u is the index times the cosine behind
// it; x is the cosine for perpendicular light, and the permittivity times the cosine for parallel light.
vec2 mx_film_amplitude(vec2 x, vec2 u)
{
    return vec2(dot(x, x) - dot(u, u), 2.0 * (x.y * u.x - x.x * u.y)) / dot(x + u, x + u);
}

// Linear RGB of the CIE XYZ of interference; the primaries are those of CIE 1931, and white has even energy.
vec3 mx_film_rgb(vec3 xyz)
{
    const mat3 XYZ_TO_RGB = mat3(2.3706743, -0.5138850, 0.0052982, -0.9000405, 1.4253036, -0.0146949,
                                 -0.4706338, 0.0885814, 1.0093968);
    return clamp(XYZ_TO_RGB * xyz, 0.0, 1.0);
}

// Reflectance of a film on an interface with the permittivity re + i im.
//
// Gaussians and polarisations come one after the other: together they would need eight times the registers.
vec3 mx_film_index(float cosine, vec3 re, vec3 im, float film, float film_ior)
{
    float ior = max(film_ior, 1.0);
    float c = mx_film_cosine(cosine, ior);
    vec2 a = mx_film_amplitudes(cosine, c, ior);
    float d = 0.004 * MX_PI * ior * c * film;
    vec3 xyz = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        int channel = max(i - 1, 0);
        vec2 below = vec2(re[channel], im[channel]) / (ior * ior);
        vec2 u = mx_fresnel_refract(c, below.x, below.y);
        vec2 x = vec2(c, 0.0);
        for (int p = 0; p < 2; ++p) {
            xyz[channel] += mx_film_light(a[p], mx_film_amplitude(x, u), d, i);
            x = c * below;
        }
    }
    return mx_film_rgb(0.5 * xyz);
}

// Reflectance, facing the viewer, of a film on an interface with the permittivity re + i im.
//
// Both polarisations are alike there.
vec3 mx_film_index_facing(vec3 re, vec3 im, float film, float film_ior)
{
    float ior = max(film_ior, 1.0);
    float a = (1.0 - ior) / (1.0 + ior);
    float d = 0.004 * MX_PI * ior * film;
    vec3 xyz = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        int channel = max(i - 1, 0);
        vec2 u = mx_fresnel_refract(1.0, re[channel] / (ior * ior), im[channel] / (ior * ior));
        xyz[channel] += mx_film_light(a, mx_film_amplitude(vec2(1.0, 0.0), u), d, i);
    }
    return mx_film_rgb(xyz);
}

// Amplitudes of an interface of reflectance f below a film of index `ior`: negative where f0 says that the index
// behind the film is lower.
//
// A colour has no phase.
vec3 mx_film_turned(vec3 f0, vec3 f, float ior)
{
    vec3 turn = 1.0 - 2.0 * step(sqrt(clamp(f0, 0.01, 0.99)), vec3((ior - 1.0) / (ior + 1.0)));
    return turn * sqrt(max(0.5 * f, 0.0));
}

// Reflectance of a film on an interface with Schlick's curve.
vec3 mx_film_schlick(float cosine, vec3 f0, vec3 bend, vec3 f90, float exponent, float film, float film_ior)
{
    float ior = max(film_ior, 1.0);
    float c = mx_film_cosine(cosine, ior);
    vec2 a = mx_film_amplitudes(cosine, c, ior);
    float d = 0.004 * MX_PI * ior * c * film;
    vec3 r = mx_film_turned(f0, mx_fresnel_schlick(c, f0, bend, f90, exponent), ior);
    vec3 xyz = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        int channel = max(i - 1, 0);
        float below = r[channel];
        for (int p = 0; p < 2; ++p) {
            below = -below;
            xyz[channel] += mx_film_light(a[p], vec2(below, 0.0), d, i);
        }
    }
    return mx_film_rgb(0.5 * xyz);
}

// Reflectance, facing the viewer, of a film on an interface of colour f0.
vec3 mx_film_schlick_facing(vec3 f0, float film, float film_ior)
{
    float ior = max(film_ior, 1.0);
    float a = (1.0 - ior) / (1.0 + ior);
    float d = 0.004 * MX_PI * ior * film;
    vec3 r = mx_film_turned(f0, f0, ior);
    vec3 xyz = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        int channel = max(i - 1, 0);
        xyz[channel] += mx_film_light(a, vec2(-r[channel], 0.0), d, i);
    }
    return mx_film_rgb(xyz);
}

// ---- all of them ----------------------------------------------------------------------------------------------------

// Reflectance of an interface without a film at a cosine.
vec3 mx_fresnel_bare(float cosine, string model, vec3 n, vec3 k, vec3 f90, float exponent)
{
    if (model == "schlick")
        return mx_fresnel_schlick(cosine, n, k, f90, exponent);
    return model == "dielectric" ? vec3(mx_fresnel_dielectric(cosine, n.x)) : mx_fresnel_conductor(cosine, n, k);
}

// Reflectance of an interface with a film at a cosine.
vec3 mx_fresnel_film(float cosine, string model, vec3 n, vec3 k, vec3 f90, float exponent, float film, float film_ior)
{
    if (model == "schlick")
        return mx_film_schlick(cosine, n, k, f90, exponent, film, film_ior);
    return mx_film_index(cosine, model == "dielectric" ? n * n : n, k, film, film_ior);
}

// Reflectance of an interface at a cosine.
vec3 mx_fresnel(float cosine, string model, vec3 n, vec3 k, vec3 f90, float exponent, float film, float film_ior)
{
    if (film > 0.0)
        return mx_fresnel_film(cosine, model, n, k, f90, exponent, film, film_ior);
    return mx_fresnel_bare(cosine, model, n, k, f90, exponent);
}

// Reflectance, facing the viewer, of an interface without a film.
vec3 mx_fresnel_f0(string model, vec3 n, vec3 k)
{
    if (model == "schlick")
        return n;
    return model == "dielectric" ? vec3(mx_fresnel_dielectric_facing(n.x)) : mx_fresnel_conductor(1.0, n, k);
}

// Reflectance, facing the viewer, of an interface.
vec3 mx_fresnel_facing(string model, vec3 n, vec3 k, float film, float film_ior)
{
    if (film > 0.0)
        return model == "schlick" ? mx_film_schlick_facing(n, film, film_ior)
                                  : mx_film_index_facing(model == "dielectric" ? n * n : n, k, film, film_ior);
    return mx_fresnel_f0(model, n, k);
}
