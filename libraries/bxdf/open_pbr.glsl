// SPDX-License-Identifier: Apache-2.0

// Squared roughness along X and across (OpenPBR Surface specification, "Microfacet model").
vec2 mx_open_pbr_anisotropy(float roughness, float anisotropy)
{
    float aspect = 1.0 - anisotropy;
    return roughness * roughness * sqrt(2.0 / (1.0 + aspect * aspect)) * vec2(1.0, aspect);
}
