// SPDX-License-Identifier: Apache-2.0
// The lobe of a slab's medium, slab_medium_bsdf, and where light goes into the mesh of a body, slab_body_bsdf. See docs/slabs.md.

#include "../pbrlib/shaders/ggx_sampling.glsl"
#include "chan.glsl"
#include "medium.glsl"

// ---- slab_medium_bsdf ------------------------------------------------------------------------------------------------

// Reciprocal, with the albedo of the viewer's way.
vec3 mx_slab_thin_light(vec3 color, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 N, vec3 V, vec3 L)
{
    return mx_medium_reflected(color, mean_free_path, phase_anisotropy, thickness, mx_way(N, V))
         / max(mx_medium_reflected(color, mean_free_path, phase_anisotropy, thickness, MX_MEAN_WAY), MX_EPSILON)
         * (mx_medium_reflected(color, mean_free_path, phase_anisotropy, thickness, mx_way(N, L)) * mx_cosine_pdf(mx_facing(N, V), L));
}

vec3 mx_slab_medium_bsdf_eval(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                              vec3 N, vec3 V, vec3 L)
{
    if (mx_is_black(mean_free_path))
        return color * mx_chan(mx_chan_gloss(roughness), N, V, L);
    if (mx_is_black(color))
        return vec3(0.0);
    return mx_slab_thin_light(color, mean_free_path, phase_anisotropy, thickness, N, V, L);
}

vec3 mx_slab_medium_bsdf_albedo(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                                vec3 N, vec3 V)
{
    return mx_is_black(mean_free_path) ? color : mx_medium_reflected(color, mean_free_path, phase_anisotropy, thickness, mx_way(N, V));
}

// The closure of a renderer is Oren and Nayar's with the colour c of the albedo. With the light that bounces between facets its mean albedo is
// c e / (1 - c (1 - e)), where e is that of one bounce (Portsmouth, Kutz and Hill 2024, "EON: A Practical Energy-Preserving Rough Diffuse BRDF").
vec3 mx_slab_medium_bsdf_tint(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                              vec3 N, vec3 V)
{
    float e = mx_fujii_mean(roughness);
    vec3 albedo = mx_slab_medium_bsdf_albedo(color, roughness, mean_free_path, phase_anisotropy, thickness, below, N, V);
    return (1.0 - albedo * (1.0 - e)) / e;
}

void mx_slab_medium_bsdf_sample(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                                vec3 N, vec3 V, vec3 xi, out vec3 L, out vec3 weight, out float pdf)
{
    L = mx_any_frame(mx_facing(N, V)) * mx_sample_cosine(xi.xy);
    pdf = mx_cosine_pdf(mx_facing(N, V), L);
    weight = mx_slab_medium_bsdf_eval(color, roughness, mean_free_path, phase_anisotropy, thickness, below, N, V, L) / max(pdf, MX_EPSILON);
}

float mx_slab_medium_bsdf_pdf(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                              vec3 N, vec3 V, vec3 L)
{
    return mx_cosine_pdf(mx_facing(N, V), L);
}

vec3 mx_slab_medium_bsdf_environment(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                                     vec3 N, vec3 V, int sample_index)
{
    if (option_path == 1 && option_environment == 2) // only here `sample_index` matters: a raster adds the light once
    {
        if (mx_is_black(color))
            return vec3(0.0);
        vec3 L, weight;
        float pdf;
        mx_slab_medium_bsdf_sample(color, roughness, mean_free_path, phase_anisotropy, thickness, below, N, V,
                                   mx_lobe_random(sample_index), L, weight, pdf);
        return mx_lobe_light(L, weight, pdf);
    }
    vec3 light = mx_slab_medium_bsdf_albedo(color, roughness, mean_free_path, phase_anisotropy, thickness, below, N, V)
               * mx_environment_irradiance(mx_is_black(mean_free_path) ? mx_chan_axis(mx_chan_gloss(roughness), N, V) : mx_facing(N, V));
    return mx_is_black(color) ? vec3(0.0) : light; // without a branch, which would stand in the loop over samples
}

// Throughput of light to the viewer, with what bounces between the medium and what lies below: 1 / (1 - below R).
vec3 mx_slab_medium_bsdf_throughput(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                                    vec3 N, vec3 V)
{
    if (mx_is_black(mean_free_path))
        return vec3(0.0);
    vec3 reflected = mx_medium_reflected(color, mean_free_path, phase_anisotropy, thickness, MX_MEAN_WAY);
    return mx_medium_through(color, mean_free_path, phase_anisotropy, thickness, mx_way(N, V)) / (1.0 - min(below * reflected, 0.999));
}

// Transmittance of light that comes in: its power with the exponent x is what a way x lets through, exact in the mean over cosine-weighted directions.
vec3 mx_slab_medium_bsdf_transmittance(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                                       vec3 N)
{
    if (mx_is_black(mean_free_path))
        return vec3(1.0);
    if (mx_is_black(color))
        return mx_medium_through(color, mean_free_path, phase_anisotropy, thickness, 1.0);
    return pow(mx_medium_through(color, mean_free_path, phase_anisotropy, thickness, MX_MEAN_WAY), vec3(1.0 / MX_MEAN_WAY));
}

float mx_slab_medium_bsdf_way(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                              vec3 N, vec3 V)
{
    return MX_MEAN_WAY;
}

// Coefficients over the thickness, for light that walks through the medium at random; 0 where it is opaque.
vec3 mx_slab_medium_bsdf_scattering(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                                    vec3 N)
{
    return mx_medium_scattering(color, mean_free_path, phase_anisotropy, thickness);
}

vec3 mx_slab_medium_bsdf_absorption(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                                    vec3 N)
{
    return mx_medium_absorption(color, mean_free_path, phase_anisotropy, thickness);
}

float mx_slab_medium_bsdf_anisotropy(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                                     vec3 N)
{
    return clamp(phase_anisotropy, -MX_MOST_ANISOTROPIC, MX_MOST_ANISOTROPIC);
}

// ---- slab_body_bsdf --------------------------------------------------------------------------------------------------
// Light goes into the mesh of a body here. Nothing changes at the surface; a path tracer takes the matter behind it from here.

vec3 mx_slab_body_bsdf_throughput(vec3 color, vec3 mean_free_path, float phase_anisotropy, float unit, vec3 V)
{
    return vec3(1.0);
}

// Coefficients over a unit of the world.
vec3 mx_slab_body_bsdf_scattering(vec3 color, vec3 mean_free_path, float phase_anisotropy, float unit)
{
    return mx_medium_scattering(color, mean_free_path, phase_anisotropy, unit);
}

vec3 mx_slab_body_bsdf_absorption(vec3 color, vec3 mean_free_path, float phase_anisotropy, float unit)
{
    return mx_medium_absorption(color, mean_free_path, phase_anisotropy, unit);
}

float mx_slab_body_bsdf_anisotropy(vec3 color, vec3 mean_free_path, float phase_anisotropy, float unit)
{
    return clamp(phase_anisotropy, -MX_MOST_ANISOTROPIC, MX_MOST_ANISOTROPIC);
}
