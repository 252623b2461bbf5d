// SPDX-License-Identifier: Apache-2.0
// Interfaces. The compiler calls these functions for closures of a renderer (leaves.c of generators/osl and generators/mdl).

// Index of refraction of a dielectric with that reflectance facing the viewer.
float mx_index_of_frontal(float frontal)
{
    float root = sqrt(clamp(frontal, 0.0, 0.98));
    return (1.0 + root) / (1.0 - root);
}

// Cosine at which facets that send light back reflect it: light meets them head-on at every angle to the surface.
float mx_rise_cosine(vec3 N, vec3 V)
{
    return min(abs(dot(N, V)), 1.0);
}

// Reflectance that Schlick's curve adds to that facing the viewer.
vec3 mx_rise_above(vec3 f0, vec3 f90)
{
    return max(f90 - f0, 0.0);
}

// Reflectance of Schlick's curve at a cosine, over that facing the viewer, `frontal`.
vec3 mx_rise_schlick(vec3 frontal, vec3 edge, float exponent, float cosine)
{
    return mix(frontal, edge, pow(1.0 - cosine, exponent)) / frontal;
}

// Reflectance of a conductor at a cosine, over that facing the viewer, by Schlick's curve.
//
// The index is n + ik.
vec3 mx_rise_conductor(vec3 n, vec3 k, float cosine)
{
    vec3 frontal = ((n - 1.0) * (n - 1.0) + k * k) / ((n + 1.0) * (n + 1.0) + k * k);
    return mx_rise_schlick(frontal, vec3(1.0), 5.0, cosine);
}

// Reflectance of a dielectric at a cosine, over that facing the viewer (Cook and Torrance 1982, "A Reflectance Model
// for Computer Graphics").
//
// For the index n and the cosine c: F = ((d - c) / (d + c))^2 (1 + ((c (d + c) - 1) / (c (d - c) + 1))^2) / 2 with d^2 = n^2 - 1 + c^2
float mx_rise_dielectric(float n, float cosine)
{
    float d = sqrt(n * n - 1.0 + cosine * cosine);
    float across = (d - cosine) / (d + cosine);
    float ratio = (cosine * (d + cosine) - 1.0) / (cosine * (d - cosine) + 1.0);
    float root = (n - 1.0) / (n + 1.0);
    return across * across * (ratio * ratio + 1.0) * 0.5 / (root * root);
}

// Colour at 90 degrees of the plain Schlick curve with the reflectance, at 82 degrees, of a curve that color82 bends
// (Hoffman 2019, "Fresnel Equations Considered Harmful").
vec3 mx_rise_edge(vec3 color0, vec3 color82, vec3 color90, float exponent)
{
    float q = pow(6.0 / 7.0, exponent);
    return max(color90 - (1.0 - color82) * mix(color0, color90, q) / q, 0.0);
}
