// SPDX-License-Identifier: Apache-2.0
// One facet of an interface for each point. A closure of a renderer does not know the light. Where the light matters it has the normal of one
// facet, and the tint of the direction that the facet mirrors. The renderer takes many points in a pixel; the mean over their facets is the
// lobe. The facet is one of the glints, or where they are countless, one by how much of it the viewer sees.

#include "../pbrlib/shaders/ggx_sampling.glsl"
#include "glint.glsl"

uniform float u_layerSample; // in OSL a number for each point

// Axes of an interface.
mat3 mx_slab_frame(vec3 N, vec3 X, vec3 V)
{
    vec3 Nf = mx_facing(N, V);
    vec3 x = mx_tangent(Nf, X);
    return mat3(x, cross(Nf, x), Nf);
}

// The part of the roughness that such a facet has itself. With less, small lights need more points; with more, directions share their tints.
const float MX_SLAB_FACET_ROUGHNESS = 0.0625;

bool mx_slab_has_facets(float glint_density, vec4 glint_footprint)
{
    return glint_density > 0.0 && mx_glint_has_facets(glint_density, glint_footprint);
}

// Its normal in the frame. Without a tint there are glints only.
vec3 mx_slab_facet_normal(vec2 alpha, float glint_density, vec2 glint_uv, vec4 glint_footprint, float specular_lut_weight, vec3 v)
{
    if (specular_lut_weight <= 0.0 || mx_slab_has_facets(glint_density, glint_footprint))
        return mx_glint_facet(alpha, glint_density, glint_uv);
    return mx_ggx_visible(alpha, v, mx_glint_random(uvec3(uint(u_layerSample * 16777216.0), 0u, 0u)).xy);
}

// The normal, and the facet's share of the roughness.
vec4 mx_slab_facet(vec2 roughness, float glint_density, vec2 glint_uv, vec4 glint_footprint, float specular_lut_weight, vec3 N, vec3 X, vec3 V)
{
    bool is_glint = mx_slab_has_facets(glint_density, glint_footprint);
    if (!is_glint && specular_lut_weight <= 0.0)
        return vec4(N, 1.0);
    mat3 frame = mx_slab_frame(N, X, V);
    return vec4(frame * mx_slab_facet_normal(mx_ggx_alpha(roughness), glint_density, glint_uv, glint_footprint, specular_lut_weight,
                                             mx_ggx_local(frame, V)),
                is_glint ? 0.5 * MX_GLINT_STEP : MX_SLAB_FACET_ROUGHNESS);
}

// The part that a facet sends of the light l that it mirrors to v, over Fresnel's factor, so that the mean is the lobe. Glints are as many as their share of
// the plane (Walter et al. 2007, equation 41). A visible normal weighs G2 / G1. The last factor undoes the blur by the facet's roughness: half a
// variance, 0.007 in squares of alpha without the far tail, times the Laplacian of 1 / (1 + q)^2, GGX over slopes; the lobe is within 1 %.
float mx_slab_facet_weight(vec2 alpha, bool is_glint, vec3 m, vec3 v, vec3 l)
{
    float weight = 4.0 * mx_ggx_smith_visibility("ggx", v, l, alpha);
    vec2 slope = m.xy / (alpha * m.z);
    float q = dot(slope, slope);
    return is_glint ? weight * dot(m, v) / m.z
                    : weight / mx_ggx_masked("ggx", v, alpha) * (1.0 + 0.028 * (1.0 - 2.0 * q) / ((1.0 + q) * (1.0 + q)));
}

// The facet's weight with compensation, and the cosine of the light.
vec4 mx_slab_facet_light(vec3 f0, vec3 f90, vec2 roughness, bool by_direction, float glint_density, vec2 glint_uv, vec4 glint_footprint,
                         float specular_lut_weight, vec3 N, vec3 X, vec3 V)
{
    bool is_glint = mx_slab_has_facets(glint_density, glint_footprint);
    if (!is_glint && specular_lut_weight <= 0.0)
        return vec4(1.0);
    vec2 alpha = mx_ggx_alpha(roughness);
    vec3 v = mx_ggx_local(mx_slab_frame(N, X, V), V);
    vec3 m = mx_slab_facet_normal(alpha, glint_density, glint_uv, glint_footprint, specular_lut_weight, v);
    vec3 l = reflect(-v, m);
    if (l.z <= 0.0 || dot(m, v) <= 0.0)
        return vec4(0.0);
    vec2 albedo = by_direction ? mx_ggx_albedo_like(mx_ggx_round_like(alpha, v)) : mx_ggx_albedo(roughness, v.z);
    return vec4(mx_slab_facet_weight(alpha, is_glint, m, v, l) * mx_ggx_compensation(albedo, "schlick", f0, vec3(0.0), f90, 0.0, 1.5), l.z);
}
