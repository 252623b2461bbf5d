// SPDX-License-Identifier: Apache-2.0
// Light of a slab itself, slab_emission_bsdf.

vec3 mx_slab_emission_bsdf_emission(vec3 color, vec3 V)
{
    return max(color, 0.0);
}

vec3 mx_slab_emission_bsdf_throughput(vec3 color, vec3 V)
{
    return vec3(1.0);
}
