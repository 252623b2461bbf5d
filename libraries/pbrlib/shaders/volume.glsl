// SPDX-License-Identifier: Apache-2.0
// absorption_vdf and anisotropic_vdf.

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
