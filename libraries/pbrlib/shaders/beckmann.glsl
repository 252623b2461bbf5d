// SPDX-License-Identifier: Apache-2.0
// Beckmann's distribution of facets. Slopes are normally distributed, so lobes have no long tails. The
// kernel in ggx.glsl calls it where the input `distribution` asks for it. Roughness is that along X and Y, already squared; directions are in
// the frame of the lobe, and masking and albedo follow them.

#include "frame.glsl"

// The integral of the normal distribution from -x to x for x >= 0, within 1.5e-7 (Abramowitz and Stegun 1964, 7.1.26).
float mx_erf(float x)
{
    float t = 1.0 / (1.0 + 0.3275911 * x);
    float sum = 0.254829592 + t * (t * (1.421413741 + t * (1.061405429 * t - 1.453152027)) - 0.284496736);
    return 1.0 - t * sum * exp(-x * x);
}

// The x with mx_erf(x) = y, for y in (-1, 1) (Giles 2010, "Approximating the erfinv function").
float mx_erf_inverse(float y)
{
    float w = -log((1.0 - y) * (1.0 + y));
    if (w < 5.0)
    {
        w -= 2.5;
        float p = w * (w * (w * (2.81022636e-8 * w + 3.43273939e-7) - 3.5233877e-6) - 4.39150654e-6) + 0.00021858087;
        return y * (w * (w * (w * (w * p - 0.00125372503) - 0.00417768164) + 0.246640727) + 1.50140941);
    }
    w = sqrt(w) - 3.0;
    float p = w * (w * (w * (0.000100950558 - 0.000200214257 * w) + 0.00134934322) - 0.00367342844) + 0.00573950773;
    return y * (w * (w * (w * (w * p - 0.0076224613) + 0.00943887047) + 1.00167406) + 2.83297682);
}

// Beckmann's distribution of normals, at the unit normal h (Walter et al. 2007, equation 25, with two widths as in Heitz 2014, equation 76).
float mx_beckmann_distribution(vec3 h, vec2 alpha)
{
    float square = max(h.z * h.z, 1e-8);
    vec2 slope = h.xy / alpha;
    return exp(-dot(slope, slope) / square) / (MX_PI * alpha.x * alpha.y * square * square);
}

// cos (1 + 2 Lambda) of the direction v (Walter et al. 2007, equation 26, before its approximation; Heitz 2014, equations 66 and 80).
float mx_beckmann_smith(vec3 v, vec2 alpha)
{
    float side = max(length(v.xy * alpha), MX_EPSILON);
    float a = v.z / side;
    return v.z * mx_erf(a) + side * (exp(-a * a) * 0.56418958);
}

// Slopes of roughness 1 towards v and across it, of those that v sees, from two random numbers xi; v is stretched by the roughness and has
// any length.
//
// The slope across is independent. Of that along v, the part below x is proportional to 1 + erf(x) + tan exp(-x^2) / sqrt(pi). Newton's method
// finds erf(x), from the start by Jakob 2014, "An Improved Visible Normal Sampling Routine for the Beckmann Distribution"; after two
// steps the part errs by 3e-6.
vec2 mx_beckmann_slopes(vec3 v, vec2 xi)
{
    float side = max(length(v.xy), MX_EPSILON);
    float most = mx_erf(v.z / side);
    float lean = side / v.z;
    float all = 1.0 + most + lean * (exp(-1.0 / (lean * lean)) * 0.56418958);
    float angle = atan(side, v.z);
    float e = most - (1.0 + most) * pow(1.0 - xi.x, 1.0 + angle * (angle * (0.4265 - 0.0594 * angle) - 0.876));
    float x = mx_erf_inverse(clamp(e, -0.9999999, min(most, 0.9999999)));
    for (int i = 0; i < 2; ++i) {
        float part = 1.0 + e + lean * (exp(-x * x) * 0.56418958);
        e = clamp(e - (part - xi.x * all) / (1.0 - x * lean), -0.9999999, min(most, 0.9999999));
        x = mx_erf_inverse(e);
    }
    return vec2(x, mx_erf_inverse(clamp(2.0 * xi.y - 1.0, -0.9999999, 0.9999999)));
}

// A normal of those visible from v, of height 1.
vec3 mx_beckmann_visible(vec2 alpha, vec3 v, vec2 xi)
{
    vec2 stretched = v.xy * alpha;
    vec2 slope = mx_beckmann_slopes(vec3(stretched, v.z), xi);
    vec2 along = stretched / max(length(stretched), MX_EPSILON);
    return vec3(-alpha * (slope.x * along + slope.y * vec2(-along.y, along.x)), 1.0);
}

// The light that a white lobe of roughness a reflects at the viewer's cosine c (x), and the mean of (1 - cos)^5 over it (y).
//
// The program fits/beckmann.c makes the constants. x is never too small by more than 0.001, and 0.014 too large at most. Where the surface is
// smooth nearly no facet hides another, so the light lost is a polynomial times an exponential.
vec2 mx_beckmann_albedo(float a, float c)
{
    const mat4 LOST = mat4(-0.2264, 2.2030, -3.5715, 1.5932, 2.3911, -10.3612, 13.6851, -4.9976,
                           -11.3595, 50.5444, -62.6097, 20.8429, 3.4293, -1.3937, -26.8177, 31.8712);
    const mat4 COSINE = mat4(-0.0045, 0.4991, 1.9532, -1.6144, -4.4713, 20.6340, -35.4073, 19.0775,
                             -6.8409, 9.3460, 10.6210, -13.8787, 11.7592, -33.6146, 28.6826, -6.3337);
    float u = exp(-0.6 * c / a);
    float x = clamp(1.0 - c - a * mx_bicubic(COSINE, a / (a + c), a), 0.0, 1.0);
    return vec2(min(1.0067 - u * mx_bicubic(LOST, u, a * c), 1.0), x * x * x * x * x);
}

// The round lobe that stands for an anisotropic one towards v: its roughness (x), its cosine of v (y), and how far facets face v more than
// those of the round lobe (z).
//
// As mx_ggx_round_like: divided by the roughness, slopes have one distribution whatever the roughness is. By fits/beckmann.c the albedo is
// within 0.0148, relatively.
vec3 mx_beckmann_round_like(vec2 alpha, vec3 v)
{
    vec2 slope = v.xy * alpha;
    float square = dot(slope, slope) + v.z * v.z;
    float m = 0.5 * (alpha.x + alpha.y);
    float shape = 0.5 * (alpha.x - alpha.y) / m;
    float d = shape * shape;
    float w = shape * (slope.x * slope.x - slope.y * slope.y) / square;
    float z = v.z * inversesqrt(square);
    float by_shape = 0.0883 + z * (5.2636 - z * 1.2035 - m * 10.8315) + m * (5.9148 + m * 1.1081)
                   + d * (-4.8074 + z * 1.8151 + m * 2.3433 - w * 1.8723 + d * 1.0750);
    float by_turn = 2.0117 + z * (-3.6491 + z * (-1.5406 + z * 0.8121) + m * 7.7620) + m * (-13.6303 + m * 8.8637)
                  + d * (0.4470 + z * 1.2715 + m * 2.8989) + w * (6.7137 - z * 0.8381 - m * 12.0082 - d * 0.3036 + w * 0.3055);
    float a = m * sqrt(max(1.0 + d * by_shape + w * by_turn, 0.05));
    float stretch = sqrt(v.z * v.z + dot(slope, slope) / (a * a));
    return vec3(a, v.z / stretch, stretch);
}
