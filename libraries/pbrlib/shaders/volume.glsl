// SPDX-License-Identifier: Apache-2.0
// absorption_vdf and anisotropic_vdf.

#include "environment.glsl"
#include "sampling.glsl"

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

// The phase function of Henyey and Greenstein 1941, "Diffuse radiation in the galaxy", per solid angle: the light that comes from L and goes to V.
float mx_phase(float anisotropy, vec3 V, vec3 L)
{
    float g = clamp(anisotropy, -0.99, 0.99);
    float d = 1.0 + g * g + 2.0 * g * dot(V, L);
    return (1.0 - g * g) / (4.0 * MX_PI * d * sqrt(d));
}

// Light from L that a unit length of the medium scatters to V.
vec3 mx_anisotropic_vdf_eval(vec3 absorption, vec3 scattering, float anisotropy, vec3 V, vec3 L)
{
    return scattering * mx_phase(anisotropy, V, L);
}

// A direction by the phase function, which is its own density.
void mx_anisotropic_vdf_sample(vec3 absorption, vec3 scattering, float anisotropy, vec3 V, vec3 xi, out vec3 L, out vec3 weight, out float pdf)
{
    float g = clamp(anisotropy, -0.99, 0.99);
    float part = (1.0 - g * g) / (1.0 - g + 2.0 * g * xi.x);
    float cosine = abs(g) < 1e-3 ? 2.0 * xi.x - 1.0 : clamp((1.0 + g * g - part * part) / (2.0 * g), -1.0, 1.0);
    L = mx_any_frame(-V) * vec3(mx_polar(sqrt(1.0 - cosine * cosine), xi.y), cosine);
    weight = scattering;
    pdf = mx_phase(anisotropy, V, L);
}

float mx_anisotropic_vdf_pdf(vec3 absorption, vec3 scattering, float anisotropy, vec3 V, vec3 L)
{
    return mx_phase(anisotropy, V, L);
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
