// SPDX-License-Identifier: Apache-2.0
// The interface of a slab, slab_reflection_bsdf: GGX with Schlick's curve, as generalized_schlick_bsdf. Light that it does not reflect goes
// through channel by channel, so that nothing is gained. Glints change what a direction gets, not the mean, so albedo, environment of rasters,
// samples and their densities are those of countless facets. Light that a tint takes is lost.

#include "facet.glsl"

uniform sampler2D u_tints; // the tables of stored closures

// Without a footprint nobody knows which facets a pixel sees.
float mx_slab_glints(float glint_density, vec2 glint_uv, vec4 glint_footprint, vec2 roughness, vec3 N, vec3 X, vec3 V, vec3 L)
{
    if (glint_density <= 0.0 || dot(glint_footprint, glint_footprint) <= 0.0)
        return 1.0;
    vec3 Nf = mx_facing(N, V);
    vec3 H = V + L;
    vec3 x = mx_tangent(Nf, X);
    vec2 slope = vec2(dot(H, x), dot(H, cross(Nf, x))) / (max(dot(H, Nf), MX_EPSILON) * mx_ggx_alpha(roughness));
    return mx_glints(clamp(slope, -1e4, 1e4), glint_density, glint_uv, glint_footprint);
}

// Tables of stored closures: squares in one texture, one above the other.
vec3 mx_slab_stored_tint(float index, vec2 at)
{
    vec2 size = vec2(textureSize(u_tints, 0));
    return textureLod(u_tints, vec2(at.x, (index + at.y) * size.x / size.y), 0.0).xyz;
}

// The tint of light from L: the table's colour at the cosines of view and light.
vec3 mx_slab_tint(sampler2D specular_lut, float specular_lut_weight, float specular_lut_index, float cos_v, float cos_l)
{
    if (specular_lut_weight <= 0.0)
        return vec3(1.0);
    vec2 size = vec2(option_stored == 1 ? textureSize(u_tints, 0).xx : textureSize(specular_lut, 0));
    vec2 edge = 0.5 / size; // 0 and 1 are the centres of the outer texels, which do not repeat
    vec2 at = mix(edge, 1.0 - edge, clamp(vec2(cos_v, cos_l), 0.0, 1.0));
    vec3 tint = option_stored == 1 ? mx_slab_stored_tint(specular_lut_index, at) : textureLod(specular_lut, at, 0.0).xyz;
    return mix(vec3(1.0), clamp(tint, 0.0, 1.0), specular_lut_weight);
}

vec3 mx_slab_reflection_bsdf_eval(vec3 f0, vec3 f90, vec2 roughness, float glint_density, vec2 glint_uv, vec4 glint_footprint, sampler2D specular_lut,
                                  float specular_lut_weight, float specular_lut_index, vec3 N, vec3 X, vec3 V, vec3 L)
{
    return mx_ggx_eval(roughness, "ggx", mx_ggx_oval(roughness), N, X, V, L, "schlick", max(f0, 0.0), vec3(0.0), f90, 5.0, 0.0, 1.5)
         * mx_slab_tint(specular_lut, specular_lut_weight, specular_lut_index, mx_view_cosine(N, V), abs(dot(N, L)))
         * mx_slab_glints(glint_density, glint_uv, glint_footprint, roughness, N, X, V, L);
}

// This and the tint call others for the parts that a slab may lack, so that the compiler leaves these out.
vec4 mx_slab_reflection_bsdf_facet(vec3 f0, vec3 f90, vec2 roughness, float glint_density, vec2 glint_uv, vec4 glint_footprint, sampler2D specular_lut,
                                   float specular_lut_weight, float specular_lut_index, vec3 N, vec3 X, vec3 V)
{
    return mx_slab_facet(roughness, glint_density, glint_uv, glint_footprint, specular_lut_weight, N, X, V);
}

// The tint multiplies the light that the closure reflects.
vec3 mx_slab_reflection_bsdf_tint(vec3 f0, vec3 f90, vec2 roughness, float glint_density, vec2 glint_uv, vec4 glint_footprint, sampler2D specular_lut,
                                  float specular_lut_weight, float specular_lut_index, vec3 N, vec3 X, vec3 V)
{
    vec4 light = mx_slab_facet_light(max(f0, 0.0), f90, roughness, mx_ggx_oval(roughness), glint_density, glint_uv, glint_footprint,
                                     specular_lut_weight, N, X, V);
    return light.xyz * mx_slab_tint(specular_lut, specular_lut_weight, specular_lut_index, mx_view_cosine(N, V), light.w);
}

// A raster tints all of its environment as at the mirror of the view.
vec3 mx_slab_reflection_bsdf_environment(vec3 f0, vec3 f90, vec2 roughness, float glint_density, vec2 glint_uv, vec4 glint_footprint, sampler2D specular_lut,
                                         float specular_lut_weight, float specular_lut_index, vec3 N, vec3 X, vec3 V, int sample_index, vec2 sample_turn)
{
    return mx_ggx_environment(roughness, "ggx", mx_ggx_oval(roughness), N, X, V, sample_index, sample_turn, "schlick", max(f0, 0.0), vec3(0.0), f90, 5.0, 0.0, 1.5)
         * mx_slab_tint(specular_lut, specular_lut_weight, specular_lut_index, mx_view_cosine(N, V), mx_view_cosine(N, V));
}

vec3 mx_slab_reflection_bsdf_albedo(vec3 f0, vec3 f90, vec2 roughness, float glint_density, vec2 glint_uv, vec4 glint_footprint, sampler2D specular_lut,
                                    float specular_lut_weight, float specular_lut_index, vec3 N, vec3 X, vec3 V)
{
    return mx_ggx_reflectance(roughness, "ggx", mx_ggx_oval(roughness), N, X, V, "schlick", max(f0, 0.0), vec3(0.0), f90, 5.0, 0.0, 1.5)
         * mx_slab_tint(specular_lut, specular_lut_weight, specular_lut_index, mx_view_cosine(N, V), mx_view_cosine(N, V));
}

vec3 mx_slab_reflection_bsdf_throughput(vec3 f0, vec3 f90, vec2 roughness, float glint_density, vec2 glint_uv, vec4 glint_footprint, sampler2D specular_lut,
                                        float specular_lut_weight, float specular_lut_index, vec3 N, vec3 X, vec3 V)
{
    return max(1.0 - mx_ggx_reflectance(roughness, "ggx", mx_ggx_oval(roughness), N, X, V, "schlick", max(f0, 0.0), vec3(0.0), f90, 5.0, 0.0, 1.5), 0.0);
}

// In a function of its own, so that the one below stays short enough to become part of the shader, where its texture is known.
vec3 mx_slab_sampled_tint(sampler2D specular_lut, float specular_lut_weight, float specular_lut_index, vec3 N, vec3 V, vec3 L)
{
    return mx_slab_tint(specular_lut, specular_lut_weight, specular_lut_index, mx_view_cosine(N, V), abs(dot(N, L)));
}

void mx_slab_reflection_bsdf_sample(vec3 f0, vec3 f90, vec2 roughness, float glint_density, vec2 glint_uv, vec4 glint_footprint, sampler2D specular_lut,
                                    float specular_lut_weight, float specular_lut_index, vec3 N, vec3 X, vec3 V, vec3 xi, out vec3 L, out vec3 weight, out float pdf)
{
    mx_ggx_scatter(roughness, "ggx", mx_ggx_oval(roughness), N, X, V, xi, 1.5, MX_REFLECTS, "schlick", max(f0, 0.0), vec3(0.0), f90, 5.0, 0.0, 1.5, L, weight, pdf);
    weight *= mx_slab_sampled_tint(specular_lut, specular_lut_weight, specular_lut_index, N, V, L)
            * mx_slab_glints(glint_density, glint_uv, glint_footprint, roughness, N, X, V, L);
}

float mx_slab_reflection_bsdf_pdf(vec3 f0, vec3 f90, vec2 roughness, float glint_density, vec2 glint_uv, vec4 glint_footprint, sampler2D specular_lut,
                                  float specular_lut_weight, float specular_lut_index, vec3 N, vec3 X, vec3 V, vec3 L)
{
    return mx_ggx_pdf(roughness, "ggx", N, X, V, L, 1.5, MX_REFLECTS, "schlick", max(f0, 0.0), vec3(0.0), f90, 5.0, 0.0, 1.5);
}
