// SPDX-License-Identifier: Apache-2.0
// dielectric_bsdf, conductor_bsdf and generalized_schlick_bsdf: three interfaces on one kernel.

#include "ggx_sampling.glsl"

uniform bool u_refractionTwoSided;

// Tint of the light that crosses the surface, or both surfaces of an object.
vec3 mx_refraction_tint(vec3 tint)
{
    return tint * (u_refractionTwoSided ? tint : vec3(1.0));
}

// Index of refraction of what lies ahead of the viewer V, over that of what it stands in.
//
// A path tracer sees backs from inside.
float mx_index_ahead(float ior, vec3 N, vec3 V)
{
    return option_path == 1 && dot(N, V) < 0.0 ? 1.0 / ior : ior;
}

// V as the reflecting lobe of L sees it: a retroreflective one is turned by half around N.
vec3 mx_lobe_view(bool retroreflective, vec3 N, vec3 V, vec3 L)
{
    return retroreflective && dot(N, V) * dot(N, L) > 0.0 ? reflect(-V, N) : V;
}

// ---- dielectric_bsdf ------------------------------------------------------------------------------------------------

vec3 mx_dielectric_bsdf_eval(vec3 tint, float ior, vec2 roughness, bool retroreflective, float film, float film_ior, vec3 N, vec3 X,
                             string distribution, string scatter_mode, vec3 V, vec3 L)
{
    if (scatter_mode == "T")
        return vec3(0.0);
    return max(tint, 0.0) * mx_ggx_eval(roughness, distribution, mx_ggx_by_direction(roughness), N, X, retroreflective ? reflect(-V, N) : V, L,
                                        "dielectric", vec3(mx_index_ahead(ior, N, V)), vec3(0.0), vec3(1.0), 0.0, film, film_ior);
}

vec3 mx_dielectric_bsdf_environment(vec3 tint, float ior, vec2 roughness, bool retroreflective, float film, float film_ior, vec3 N, vec3 X,
                                    string distribution, string scatter_mode, vec3 V, int sample_index, vec2 sample_turn)
{
    if (scatter_mode == "T")
        return vec3(0.0);
    return max(tint, 0.0) * mx_ggx_environment(roughness, distribution, mx_ggx_by_direction(roughness), N, X, retroreflective ? reflect(-V, N) : V,
                                               sample_index, sample_turn, "dielectric", vec3(ior), vec3(0.0), vec3(1.0), 0.0, film, film_ior);
}

vec3 mx_dielectric_bsdf_transmission(vec3 tint, float ior, vec2 roughness, bool retroreflective, float film, float film_ior, vec3 N, vec3 X,
                                     string distribution, string scatter_mode, vec3 V, int sample_index, vec2 sample_turn)
{
    if (scatter_mode == "R")
        return vec3(0.0);
    return mx_refraction_tint(max(tint, 0.0)) * mx_ggx_refraction(roughness, distribution, N, X, V, sample_index, sample_turn, ior,
                                                                  mx_ggx_mode(scatter_mode), "dielectric", vec3(ior), vec3(0.0), vec3(1.0),
                                                                  0.0, film, film_ior);
}

vec3 mx_dielectric_bsdf_throughput(vec3 tint, float ior, vec2 roughness, bool retroreflective, float film, float film_ior, vec3 N, vec3 X,
                                   string distribution, string scatter_mode, vec3 V)
{
    if (scatter_mode == "T")
        return vec3(1.0);
    return 1.0 - mx_ggx_reflectance(roughness, distribution, mx_ggx_by_direction(roughness), N, X, V, "dielectric", vec3(mx_index_ahead(ior, N, V)),
                                    vec3(0.0), vec3(1.0), 0.0, film, film_ior);
}

vec3 mx_dielectric_bsdf_albedo(vec3 tint, float ior, vec2 roughness, bool retroreflective, float film, float film_ior, vec3 N, vec3 X,
                               string distribution, string scatter_mode, vec3 V)
{
    if (scatter_mode == "T")
        return vec3(0.0);
    float eta = mx_index_ahead(ior, N, V);
    return max(tint, 0.0) * mx_ggx_reflectance(roughness, distribution, mx_ggx_by_direction(roughness), N, X, V, "dielectric", vec3(eta), vec3(0.0),
                                               vec3(1.0), 0.0, film, film_ior);
}

vec3 mx_dielectric_bsdf_refraction(vec3 tint, float ior, vec2 roughness, bool retroreflective, float film, float film_ior, vec3 N, vec3 X,
                                   string distribution, string scatter_mode, vec3 V, vec3 L)
{
    if (scatter_mode == "R")
        return vec3(0.0);
    float eta = mx_index_ahead(ior, N, V);
    return max(tint, 0.0) * mx_ggx_refracted(roughness, distribution, N, X, V, L, eta, mx_ggx_mode(scatter_mode), "dielectric", vec3(eta), vec3(0.0),
                                             vec3(1.0), 0.0, film, film_ior);
}

void mx_dielectric_bsdf_sample(vec3 tint, float ior, vec2 roughness, bool retroreflective, float film, float film_ior, vec3 N, vec3 X,
                               string distribution, string scatter_mode, vec3 V, vec3 xi, out vec3 L, out vec3 weight, out float pdf)
{
    float eta = mx_index_ahead(ior, N, V);
    mx_ggx_scatter(roughness, distribution, mx_ggx_by_direction(roughness), N, X, V, xi, eta, mx_ggx_mode(scatter_mode), "dielectric", vec3(eta), vec3(0.0),
                   vec3(1.0), 0.0, film, film_ior, L, weight, pdf);
    weight *= max(tint, 0.0);
    if (retroreflective && dot(N, V) * dot(N, L) > 0.0)
        L = reflect(-L, N);
}

float mx_dielectric_bsdf_pdf(vec3 tint, float ior, vec2 roughness, bool retroreflective, float film, float film_ior, vec3 N, vec3 X,
                             string distribution, string scatter_mode, vec3 V, vec3 L)
{
    float eta = mx_index_ahead(ior, N, V);
    return mx_ggx_pdf(roughness, distribution, N, X, mx_lobe_view(retroreflective, N, V, L), L, eta, mx_ggx_mode(scatter_mode), "dielectric", vec3(eta),
                      vec3(0.0), vec3(1.0), 0.0, film, film_ior);
}

// ---- conductor_bsdf -------------------------------------------------------------------------------------------------

vec3 mx_conductor_bsdf_eval(vec3 ior, vec3 extinction, vec2 roughness, bool retroreflective, float film, float film_ior, vec3 N, vec3 X,
                            string distribution, vec3 V, vec3 L)
{
    vec3 re, im;
    mx_permittivity(ior, extinction, re, im);
    return mx_ggx_eval(roughness, distribution, mx_ggx_by_direction(roughness), N, X, retroreflective ? reflect(-V, N) : V, L, "conductor", re, im,
                       vec3(1.0), 0.0, film, film_ior);
}

vec3 mx_conductor_bsdf_environment(vec3 ior, vec3 extinction, vec2 roughness, bool retroreflective, float film, float film_ior, vec3 N,
                                   vec3 X, string distribution, vec3 V, int sample_index, vec2 sample_turn)
{
    vec3 re, im;
    mx_permittivity(ior, extinction, re, im);
    return mx_ggx_environment(roughness, distribution, mx_ggx_by_direction(roughness), N, X, retroreflective ? reflect(-V, N) : V, sample_index,
                              sample_turn, "conductor", re, im, vec3(1.0), 0.0, film, film_ior);
}

vec3 mx_conductor_bsdf_albedo(vec3 ior, vec3 extinction, vec2 roughness, bool retroreflective, float film, float film_ior, vec3 N, vec3 X,
                              string distribution, vec3 V)
{
    vec3 re, im;
    mx_permittivity(ior, extinction, re, im);
    return mx_ggx_reflectance(roughness, distribution, mx_ggx_by_direction(roughness), N, X, V, "conductor", re, im, vec3(1.0), 0.0, film, film_ior);
}

void mx_conductor_bsdf_sample(vec3 ior, vec3 extinction, vec2 roughness, bool retroreflective, float film, float film_ior, vec3 N, vec3 X,
                              string distribution, vec3 V, vec3 xi, out vec3 L, out vec3 weight, out float pdf)
{
    vec3 re, im;
    mx_permittivity(ior, extinction, re, im);
    mx_ggx_scatter(roughness, distribution, mx_ggx_by_direction(roughness), N, X, V, xi, 1.0, MX_REFLECTS, "conductor", re, im, vec3(1.0), 0.0, film, film_ior, L, weight, pdf);
    if (retroreflective && dot(N, V) * dot(N, L) > 0.0)
        L = reflect(-L, N);
}

float mx_conductor_bsdf_pdf(vec3 ior, vec3 extinction, vec2 roughness, bool retroreflective, float film, float film_ior, vec3 N, vec3 X,
                            string distribution, vec3 V, vec3 L)
{
    vec3 re, im;
    mx_permittivity(ior, extinction, re, im);
    return mx_ggx_pdf(roughness, distribution, N, X, mx_lobe_view(retroreflective, N, V, L), L, 1.0, MX_REFLECTS, "conductor", re, im, vec3(1.0),
                      0.0, film, film_ior);
}

// ---- generalized_schlick_bsdf ---------------------------------------------------------------------------------------

vec3 mx_generalized_schlick_bsdf_eval(vec3 color0, vec3 color82, vec3 color90, float exponent, vec2 roughness, bool retroreflective,
                                      float film, float film_ior, vec3 N, vec3 X, string distribution, string scatter_mode, vec3 V, vec3 L)
{
    if (scatter_mode == "T")
        return vec3(0.0);
    return mx_ggx_eval(roughness, distribution, mx_ggx_by_direction(roughness), N, X, retroreflective ? reflect(-V, N) : V, L, "schlick",
                       max(color0, 0.0), mx_schlick_bend(color0, color82, color90, exponent), max(color90, 0.0), exponent, film, film_ior);
}

vec3 mx_generalized_schlick_bsdf_environment(vec3 color0, vec3 color82, vec3 color90, float exponent, vec2 roughness, bool retroreflective,
                                             float film, float film_ior, vec3 N, vec3 X, string distribution, string scatter_mode, vec3 V,
                                             int sample_index, vec2 sample_turn)
{
    if (scatter_mode == "T")
        return vec3(0.0);
    return mx_ggx_environment(roughness, distribution, mx_ggx_by_direction(roughness), N, X, retroreflective ? reflect(-V, N) : V, sample_index,
                              sample_turn, "schlick", max(color0, 0.0), mx_schlick_bend(color0, color82, color90, exponent),
                              max(color90, 0.0), exponent, film, film_ior);
}

// The index of refraction whose reflectance ((n - 1) / (n + 1))^2 is the mean of color0.
float mx_schlick_index(vec3 color0)
{
    float r = sqrt(clamp(dot(color0, vec3(1.0 / 3.0)), 0.01, 0.99));
    return (1.0 + r) / (1.0 - r);
}

vec3 mx_generalized_schlick_bsdf_transmission(vec3 color0, vec3 color82, vec3 color90, float exponent, vec2 roughness, bool retroreflective,
                                              float film, float film_ior, vec3 N, vec3 X, string distribution, string scatter_mode, vec3 V,
                                             int sample_index, vec2 sample_turn)
{
    if (scatter_mode == "R")
        return vec3(0.0);
    return mx_ggx_refraction(roughness, distribution, N, X, V, sample_index, sample_turn, mx_schlick_index(color0),
                             mx_ggx_mode(scatter_mode), "schlick", max(color0, 0.0),
                             mx_schlick_bend(color0, color82, color90, exponent), max(color90, 0.0), exponent, film, film_ior);
}

vec3 mx_generalized_schlick_bsdf_throughput(vec3 color0, vec3 color82, vec3 color90, float exponent, vec2 roughness, bool retroreflective,
                                            float film, float film_ior, vec3 N, vec3 X, string distribution, string scatter_mode, vec3 V)
{
    if (scatter_mode == "T")
        return vec3(1.0);
    vec3 reflected = mx_ggx_reflectance(roughness, distribution, mx_ggx_by_direction(roughness), N, X, V, "schlick", max(color0, 0.0),
                                        mx_schlick_bend(color0, color82, color90, exponent), max(color90, 0.0), exponent, film, film_ior);
    return vec3(1.0 - dot(reflected, vec3(1.0 / 3.0)));
}

vec3 mx_generalized_schlick_bsdf_albedo(vec3 color0, vec3 color82, vec3 color90, float exponent, vec2 roughness, bool retroreflective,
                                        float film, float film_ior, vec3 N, vec3 X, string distribution, string scatter_mode, vec3 V)
{
    if (scatter_mode == "T")
        return vec3(0.0);
    return mx_ggx_reflectance(roughness, distribution, mx_ggx_by_direction(roughness), N, X, V, "schlick", max(color0, 0.0),
                              mx_schlick_bend(color0, color82, color90, exponent), max(color90, 0.0), exponent, film, film_ior);
}

vec3 mx_generalized_schlick_bsdf_refraction(vec3 color0, vec3 color82, vec3 color90, float exponent, vec2 roughness, bool retroreflective,
                                            float film, float film_ior, vec3 N, vec3 X, string distribution, string scatter_mode, vec3 V,
                                            vec3 L)
{
    if (scatter_mode == "R")
        return vec3(0.0);
    return mx_ggx_refracted(roughness, distribution, N, X, V, L, mx_schlick_index(color0), mx_ggx_mode(scatter_mode), "schlick", max(color0, 0.0),
                            mx_schlick_bend(color0, color82, color90, exponent), max(color90, 0.0), exponent, film, film_ior);
}

void mx_generalized_schlick_bsdf_sample(vec3 color0, vec3 color82, vec3 color90, float exponent, vec2 roughness, bool retroreflective,
                                        float film, float film_ior, vec3 N, vec3 X, string distribution, string scatter_mode, vec3 V,
                                        vec3 xi, out vec3 L, out vec3 weight, out float pdf)
{
    mx_ggx_scatter(roughness, distribution, mx_ggx_by_direction(roughness), N, X, V, xi, mx_schlick_index(color0), mx_ggx_mode(scatter_mode), "schlick",
                   max(color0, 0.0), mx_schlick_bend(color0, color82, color90, exponent), max(color90, 0.0), exponent, film, film_ior, L, weight, pdf);
    if (retroreflective && dot(N, V) * dot(N, L) > 0.0)
        L = reflect(-L, N);
}

float mx_generalized_schlick_bsdf_pdf(vec3 color0, vec3 color82, vec3 color90, float exponent, vec2 roughness, bool retroreflective,
                                      float film, float film_ior, vec3 N, vec3 X, string distribution, string scatter_mode, vec3 V, vec3 L)
{
    return mx_ggx_pdf(roughness, distribution, N, X, mx_lobe_view(retroreflective, N, V, L), L, mx_schlick_index(color0), mx_ggx_mode(scatter_mode),
                      "schlick", max(color0, 0.0), mx_schlick_bend(color0, color82, color90, exponent), max(color90, 0.0), exponent, film,
                      film_ior);
}
