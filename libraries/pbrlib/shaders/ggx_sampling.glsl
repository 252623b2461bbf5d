// SPDX-License-Identifier: Apache-2.0
// The GGX lobe for path tracing: it reflects and refracts at normals that are visible from V (Heitz 2018, "Sampling the GGX
// Distribution of Visible Normals"). Interfaces as in fresnel.glsl, modes as in ggx.glsl.

#include "ggx.glsl"

// Share of the samples that reflect, where the lobe also refracts.
float mx_ggx_share(vec3 fresnel)
{
    return clamp(dot(fresnel, vec3(1.0 / 3.0)), 0.0, 1.0);
}

// Masking G1 of v over its cosine: the density of the normals visible from v over (v.h) D(h) (Heitz 2018, equation
// 3).
float mx_ggx_masked(string distribution, vec3 v, vec2 alpha)
{
    return 2.0 / (v.z + mx_ggx_smith(distribution, v, alpha));
}

// Normal of the facet that refracts l, below the horizon, towards v; eta is the index below over that above (Walter
// et al. 2007, equation 16).
vec3 mx_refracting_normal(vec3 v, vec3 l, float eta)
{
    vec3 h = normalize(v + eta * l);
    return h.z < 0.0 ? -h : h;
}

// Solid angle of normals over that of the directions l that they refract to v (Walter et al. 2007, equation 17).
float mx_refraction_jacobian(vec3 v, vec3 l, vec3 h, float eta)
{
    float cos_l = dot(l, h);
    float sum = dot(v, h) + eta * cos_l;
    return eta * eta * abs(cos_l) / (sum * sum);
}

// A lobe that only refracts lies below one that reflects (as in standard_surface). The layer lets through what that one leaves: reflected
// light is not taken twice, as it is by MaterialX's rasters.

// Light that the lobe refracts from L to V, as a part of energy (Walter et al. 2007, equation 21).
//
// Radiance grows by the square of the index, and shrinks again where it leaves the medium; both are left out.
vec3 mx_ggx_refracted(vec2 roughness, string distribution, vec3 N, vec3 X, vec3 V, vec3 L, float eta, int mode, string model, vec3 n, vec3 k, vec3 f90,
                      float exponent, float film, float film_ior)
{
    vec2 alpha = mx_ggx_alpha(roughness);
    mat3 frame = mx_frame(mx_facing(N, V), X);
    vec3 v = mx_ggx_local(frame, V);
    vec3 l = L * frame;
    vec3 h = mx_refracting_normal(v, l, eta);
    float cos_h = dot(v, h);
    if (l.z >= 0.0 || cos_h <= 0.0 || dot(l, h) >= 0.0)
        return vec3(0.0);
    vec3 f = mx_fresnel(min(cos_h, 1.0), model, n, k, f90, exponent, film, film_ior);
    return (mode == MX_REFRACTS ? vec3(1.0) : 1.0 - f)
         * ((distribution == "ggx" ? mx_ggx_distribution(h / vec3(alpha, 1.0), alpha.x * alpha.y) : mx_beckmann_distribution(h, alpha)) * mx_ggx_masked(distribution, v, alpha) * mx_ggx_masked(distribution, -l, alpha) * -l.z
            * cos_h * mx_refraction_jacobian(v, l, h, eta));
}

// Density of the directions L that mx_ggx_scatter takes.
float mx_ggx_pdf(vec2 roughness, string distribution, vec3 N, vec3 X, vec3 V, vec3 L, float eta, int mode, string model, vec3 n, vec3 k, vec3 f90,
                 float exponent, float film, float film_ior)
{
    vec2 alpha = mx_ggx_alpha(roughness);
    mat3 frame = mx_frame(mx_facing(N, V), X);
    vec3 v = mx_ggx_local(frame, V);
    vec3 l = L * frame;
    if (mode == MX_REFLECTS && l.z <= 0.0)
        return 0.0;
    bool is_reflected = mode == MX_REFLECTS || l.z > 0.0;
    vec3 h = is_reflected ? normalize(v + l) : mx_refracting_normal(v, l, eta);
    float cos_h = dot(v, h);
    if (cos_h <= 0.0 || (!is_reflected && dot(l, h) >= 0.0))
        return 0.0;
    float share = float(mode == MX_REFLECTS);
    if (mode == MX_REFLECTS + MX_REFRACTS)
        share = mx_ggx_share(mx_fresnel(min(cos_h, 1.0), model, n, k, f90, exponent, film, film_ior));
    return mx_ggx_masked(distribution, v, alpha) * (distribution == "ggx" ? mx_ggx_distribution(h / vec3(alpha, 1.0), alpha.x * alpha.y) : mx_beckmann_distribution(h, alpha))
         * (is_reflected ? 0.25 * share : (1.0 - share) * cos_h * mx_refraction_jacobian(v, l, h, eta));
}

// A unit normal of those visible from v, from two random numbers xi.
vec3 mx_ggx_visible(vec2 alpha, vec3 v, vec2 xi)
{
    vec3 stretch = vec3(alpha, 1.0);
    float reach = mx_ggx_smith("ggx", v, alpha);
    return normalize(mx_ggx_cap(mx_polar(1.0, xi.x), xi.y * (v.z + reach), v * stretch, reach) * stretch);
}

// A direction L that the lobe reflects or refracts light from, by three random numbers xi, with the value over the
// density (`weight`) and the density (`pdf`).
//
// The weight is mx_ggx_eval or mx_ggx_refracted over mx_ggx_pdf, without the numbers that become huge where the
// surface is smooth.
void mx_ggx_scatter(vec2 roughness, string distribution, bool by_direction, vec3 N, vec3 X, vec3 V, vec3 xi, float eta, int mode, string model, vec3 n, vec3 k,
                    vec3 f90, float exponent, float film, float film_ior, out vec3 L, out vec3 weight, out float pdf)
{
    vec2 alpha = mx_ggx_alpha(roughness);
    mat3 frame = mx_frame(mx_facing(N, V), X);
    vec3 v = mx_ggx_local(frame, V);
    vec3 h = distribution == "ggx" ? mx_ggx_visible(alpha, v, xi.xy) : normalize(mx_beckmann_visible(alpha, v, xi.xy));
    float cos_h = clamp(dot(v, h), MX_EPSILON, 1.0);
    vec3 f = mx_fresnel(cos_h, model, n, k, f90, exponent, film, film_ior);
    bool is_both = mode == MX_REFLECTS + MX_REFRACTS;
    float share = is_both ? mx_ggx_share(f) : float(mode == MX_REFLECTS);
    bool is_reflected = is_both ? xi.z < share : mode == MX_REFLECTS;
    vec3 l = is_reflected ? reflect(-v, h) : refract(-v, h, 1.0 / eta);
    float density = mx_ggx_masked(distribution, v, alpha);
    L = frame * l;
    weight = vec3(0.0);
    pdf = 0.0;
    if (is_reflected ? l.z <= 0.0 : l.z >= 0.0) // behind its own surface, or refraction that cannot be
        return;
    if (is_reflected)
    {
        weight = f * (mx_ggx_smith_visibility(distribution, v, l, alpha) * 4.0 / (density * share))
               * mx_ggx_compensation(distribution != "ggx" ? mx_beckmann_albedo_towards(roughness, v) : by_direction ? mx_ggx_albedo_like(mx_ggx_round_like(alpha, v)) : mx_ggx_albedo(roughness, v.z), model, n, k, f90, film,
                                     film_ior);
        pdf = 0.25 * share;
    }
    else
    {
        weight = (mode == MX_REFRACTS ? vec3(1.0) : 1.0 - f) * (mx_ggx_masked(distribution, -l, alpha) * -l.z / (1.0 - share));
        pdf = (1.0 - share) * cos_h * mx_refraction_jacobian(v, l, h, eta);
    }
    pdf *= density
         * (distribution == "ggx" ? mx_ggx_distribution(h / vec3(alpha, 1.0), alpha.x * alpha.y) : mx_beckmann_distribution(h, alpha));
}
