// SPDX-License-Identifier: Apache-2.0
// absorption_vdf and anisotropic_vdf.

#include "environment.glsl"

vec3 mx_absorption_vdf_absorption(vec3 absorption)
{
    return absorption;
}

vec3 mx_anisotropic_vdf_absorption(vec3 absorption, vec3 scattering, float anisotropy)
{
    return absorption;
}

vec3 mx_anisotropic_vdf_scattering(vec3 absorption, vec3 scattering, float anisotropy)
{
    return scattering;
}

float mx_anisotropic_vdf_anisotropy(vec3 absorption, vec3 scattering, float anisotropy)
{
    return anisotropy;
}

// Light from L that a unit length of the medium scatters to V, by the phase function of Henyey and Greenstein 1941,
// "Diffuse radiation in the galaxy".
vec3 mx_anisotropic_vdf_eval(vec3 absorption, vec3 scattering, float anisotropy, vec3 V, vec3 L)
{
    float g = clamp(anisotropy, -0.99, 0.99);
    float d = 1.0 + g * g + 2.0 * g * dot(V, L);
    return scattering * ((1.0 - g * g) / (4.0 * MX_PI * d * sqrt(d)));
}

// Light of the environment that a unit length of the medium scatters to V: a share from behind, the rest from in
// front.
//
// A cosine lobe has the mean cosine 2/3, so that shares of 1/2 +- 3/4 g have that of the phase function.
vec3 mx_anisotropic_vdf_environment(vec3 absorption, vec3 scattering, float anisotropy, vec3 V)
{
    float front = clamp(0.5 - 0.75 * anisotropy, 0.0, 1.0);
    return scattering * mix(mx_environment_irradiance(-V), mx_environment_irradiance(V), front);
}
