// SPDX-License-Identifier: Apache-2.0
// Lies on a slab and changes nothing: its weight is that of the slab. The deferred pipeline stores its inputs (docs/deferred.md).

#include "medium.glsl"

vec3 mx_slab_mark_bsdf_throughput(vec3 diffuse_albedo, vec3 f0, vec3 f90, float roughness, float anisotropy, vec3 normal, vec3 tangent,
                                  float second_roughness, float second_roughness_weight, float fuzz_amount, vec3 fuzz_color,
                                  float fuzz_roughness, vec3 free_path, float phase_anisotropy, float is_thick, float glint_density,
                                  vec2 glint_uv, vec2 glint_extent, sampler2D specular_lut, float specular_lut_weight, float blur)
{
    return vec3(1.0);
}

float mx_slab_mark_bsdf_way(vec3 diffuse_albedo, vec3 f0, vec3 f90, float roughness, float anisotropy, vec3 normal, vec3 tangent,
                            float second_roughness, float second_roughness_weight, float fuzz_amount, vec3 fuzz_color,
                            float fuzz_roughness, vec3 free_path, float phase_anisotropy, float is_thick, float glint_density,
                            vec2 glint_uv, vec2 glint_extent, sampler2D specular_lut, float specular_lut_weight, float blur)
{
    return MX_MEAN_WAY;
}
