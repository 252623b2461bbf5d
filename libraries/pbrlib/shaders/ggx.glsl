// SPDX-License-Identifier: Apache-2.0
// GGX microfacet lobe, the one kernel of all dielectric, conductor and Schlick closures. Roughness is that along X and
// Y, already squared; masking uses their geometric mean. See fresnel.glsl for the parameters of interfaces.

#include "environment.glsl"
#include "fresnel.glsl"
#include "sampling.glsl"

// Distribution of normals (Burley 2012, appendix B.2, equation 13).
float mx_ggx_distribution(vec3 h, vec2 alpha)
{
    vec3 e = vec3(h.xy / alpha, h.z);
    float d = dot(e, e);
    return 1.0 / (MX_PI * alpha.x * alpha.y * d * d);
}

// Heitz 2014, "Understanding the Masking-Shadowing Function", equation 72: cos (1 + 2 Lambda).
float mx_ggx_masking(float cosine, vec2 alpha)
{
    return sqrt(mix(cosine * cosine, 1.0, alpha.x * alpha.y));
}

// Height-correlated masking and shadowing G2 (equation 99) over 4 cos_v, the divisor left of the reflection model.
float mx_ggx_visibility(float cos_v, float cos_l, vec2 alpha)
{
    return 0.5 * cos_l / (cos_v * mx_ggx_masking(cos_l, alpha) + cos_l * mx_ggx_masking(cos_v, alpha));
}

// Roughness that the formulas can bear.
vec2 mx_ggx_alpha(vec2 roughness)
{
    return clamp(roughness, MX_EPSILON, 1.0);
}

const int option_albedo = 0; // 0 by a fit, 1 from the host's table

uniform sampler2D u_albedoTable;

// What a white lobe reflects at the viewer's cosine c (x), and the mean of Schlick's (1 - cos)^5 over it (y); the program fits/ggx.c makes
// the constants. x is never too small by more than 0.001, so that giving lost energy back adds none. The table holds what scales the
// reflectance facing the viewer, and that at grazing angles: c to the right, the mean of alpha downwards.
vec2 mx_ggx_albedo(vec2 alpha, float c)
{
    if (option_albedo == 1)
    {
        vec2 scales = textureLod(u_albedoTable, vec2(c, sqrt(alpha.x * alpha.y)), 0.0).xy;
        float sum = clamp(scales.x + scales.y, MX_EPSILON, 1.0);
        return vec2(sum, scales.y / sum);
    }
    const mat4 LOST = mat4(-0.1447, 2.7590, -5.4314, 2.8497, -0.9366, 1.4766, 0.5911, -1.0905,
                           11.8506, -30.2645, 27.3289, -8.9414, -4.3199, 8.2596, -3.1648, -0.8054);
    const mat4 COSINE = mat4(-0.2006, 5.2916, -3.7565, 0.2180, -10.2439, 6.6203, -0.9657, 2.5694,
                             38.3042, -80.8059, 71.7310, -28.5214, -34.2000, 89.1079, -88.4065, 33.7820);
    float a = sqrt(alpha.x * alpha.y);
    float u = a / (a + c);
    vec4 powers_u = vec4(1.0, u, u * u, u * u * u);
    vec4 powers_a = vec4(1.0, a, a * a, a * a * a);
    float x = clamp(1.0 - c - a * dot(powers_u, COSINE * powers_a), 0.0, 1.0);
    return vec2(min(1.0046 - u * dot(powers_u, LOST * powers_a), 1.0), x * x * x * x * x);
}

// Factor that restores the energy of multiple scattering (Turquin 2019, equations 14 and 16).
vec3 mx_ggx_compensation(vec2 albedo, string model, vec3 n, vec3 k, vec3 f90, float exponent, float film, float film_ior)
{
    // 1/21: the hemispherical mean of Schlick's curve with exponent 5
    return 1.0 + mix(mx_fresnel(1.0, model, n, k, f90, exponent, film, film_ior), f90, 1.0 / 21.0)
               * (1.0 / albedo.x - 1.0);
}

// Part of the light that the lobe reflects towards V. A raster has Schlick's curve for every interface, under which a film
// changes the compensation only; a path tracer takes the interface as it is at the lobe's mean angle.
vec3 mx_ggx_reflectance(vec2 roughness, vec3 N, vec3 V, string model, vec3 n, vec3 k, vec3 f90, float exponent, float film,
                        float film_ior)
{
    vec2 albedo = mx_ggx_albedo(mx_ggx_alpha(roughness), mx_view_cosine(N, V));
    vec3 f = option_integrator == 0
        ? mix(mx_fresnel_f0(model, n, k), f90, albedo.y)
        : mx_fresnel(max(1.0 - pow(albedo.y, 0.2), MX_EPSILON), model, n, k, f90, exponent, film, film_ior);
    return f * albedo.x * mx_ggx_compensation(albedo, model, n, k, f90, exponent, film, film_ior);
}

// ---- lights ---------------------------------------------------------------------------------------------------------

// The lobe towards L, but for Fresnel's factor; N faces V, and x is a unit tangent.
float mx_ggx_lobe(vec2 alpha, vec3 N, vec3 x, float cos_v, vec3 L, vec3 H)
{
    return mx_ggx_distribution(mx_enter_frame(H, N, x), alpha) * mx_ggx_visibility(cos_v, max(dot(N, L), MX_EPSILON), alpha);
}

// ---- masking by direction -------------------------------------------------------------------------------------------
// The roughness as it is in each direction (Heitz 2014, equation 80). A raster does without, as MaterialX does: the mean
// masks too little where an anisotropic lobe is wide, which gains energy.

float mx_ggx_smith(vec3 v, vec2 alpha)
{
    return length(vec3(v.xy * alpha, v.z));
}

float mx_ggx_smith_visibility(vec3 v, vec3 l, vec2 alpha)
{
    return 0.5 * l.z / (v.z * mx_ggx_smith(l, alpha) + l.z * mx_ggx_smith(v, alpha));
}

// A direction in the frame, never below the horizon.
vec3 mx_ggx_local(mat3 frame, vec3 V)
{
    vec3 v = V * frame;
    return vec3(v.xy, max(v.z, MX_EPSILON));
}

float mx_ggx_smith_lobe(vec2 alpha, mat3 frame, vec3 V, vec3 L, vec3 H)
{
    return mx_ggx_distribution(H * frame, alpha)
         * mx_ggx_smith_visibility(mx_ggx_local(frame, V), mx_ggx_local(frame, L), alpha);
}

// ---- both -----------------------------------------------------------------------------------------------------------

vec3 mx_ggx_eval(vec2 roughness, vec3 N, vec3 X, vec3 V, vec3 L, string model, vec3 n, vec3 k, vec3 f90, float exponent,
                 float film, float film_ior)
{
    vec2 alpha = mx_ggx_alpha(roughness);
    float cos_v = mx_view_cosine(N, V);
    vec3 n_v = mx_facing(N, V);
    vec3 H = normalize(V + L);
    return mx_ggx_compensation(mx_ggx_albedo(alpha, cos_v), model, n, k, f90, exponent, film, film_ior)
         * (option_integrator == 1 ? mx_ggx_smith_lobe(alpha, mx_frame(n_v, X), V, L, H)
                                   : mx_ggx_lobe(alpha, n_v, mx_tangent(n_v, X), cos_v, L, H))
         * mx_fresnel(clamp(dot(V, H), MX_EPSILON, 1.0), model, n, k, f90, exponent, film, film_ior);
}

// ---- environment ----------------------------------------------------------------------------------------------------
// Below, refract_ior > 0 looks through a solid sphere of that index instead of reflecting.

// Direction of the ray -v after it has entered the sphere at normal h and left it again.
vec3 mx_refract_sphere(vec3 v, vec3 h, float ior)
{
    vec3 inside = refract(-v, h, 1.0 / ior);
    return refract(inside, normalize(inside * dot(inside, h) - 0.5 * h), ior);
}

// A map whose mip levels are filtered for rising roughness.
vec3 mx_ggx_prefiltered(vec2 alpha, vec3 N, vec3 V, float refract_ior, string model, vec3 n, vec3 k, vec3 f90,
                        float exponent, float film, float film_ior)
{
    vec3 h = mx_facing(N, V);
    vec2 albedo = mx_ggx_albedo(alpha, mx_view_cosine(N, V));
    vec3 f = mix(mx_fresnel(1.0, model, n, k, f90, exponent, film, film_ior), f90, albedo.y) * albedo.x;
    float a = sqrt(alpha.x * alpha.y);
    if (film > 0.0) // keep the change of colour with the angle where the lobe is sharp
        f = mix(mx_fresnel(mx_view_cosine(N, V), model, n, k, f90, exponent, film, film_ior), f, sqrt(a));
    float lod = (a < 0.25 ? sqrt(a) : 0.5 * a + 0.375) * float(u_envRadianceMips - 1);
    if (refract_ior > 0.0)
        return (1.0 - f) * mx_environment_radiance(mx_refract_sphere(V, h, refract_ior), lod);
    return f * mx_environment_radiance(reflect(-V, h), lod);
}

// A normal of those visible from v, which is stretched by the roughness (Dupuy and Benyoub 2023, "Sampling Visible GGX
// Normals with Spherical Caps").
vec3 mx_ggx_visible_normal(vec2 xi, vec3 v, vec2 alpha)
{
    float top = (1.0 - xi.y) * (1.0 + v.z);
    float z = top - v.z;
    vec2 around = sqrt(max(1.0 - z * z, 0.0)) * cos(2.0 * MX_PI * (xi.x - vec2(0.0, 0.25)));
    return normalize(vec3((v.xy + around) * alpha, top));
}

// Sample number i of the spherical Fibonacci points (Marques et al. 2013): its light, and in the fourth component the cosine
// at its facet. The light is filtered over the solid angle of the sample (Krivanek and Colbert 2008; the mip level is
// equation 13 of GPU Gems 3, section 20.4).
vec4 mx_ggx_sample(int i, vec3 N, vec3 x, vec3 V, float cos_v, vec2 alpha, float refract_ior)
{
    float count = float(u_envRadianceSamples);
    vec2 xi = vec2((float(i) + 0.5) / count, fract((float(i) + 1.0) * 1.61803399));
    vec3 h = mx_ggx_visible_normal(xi, normalize(vec3(dot(V, x) * alpha.x, dot(V, cross(N, x)) * alpha.y, cos_v)), alpha);
    vec3 H = mx_leave_frame(h, N, x);
    float masking = 2.0 * (cos_v + mx_ggx_masking(cos_v, alpha)) / count;
    // A visible normal weighs G2 / G1 where it reflects, and 1 / G1 where it refracts.
    vec3 L = reflect(-V, H);
    float weight = 0.25 / cos_v;
    if (refract_ior > 0.0)
        L = mx_refract_sphere(V, H, refract_ior);
    else
        weight = mx_ggx_visibility(cos_v, max(dot(N, L), MX_EPSILON), alpha);
    float solid = length(L.xz) * mx_ggx_distribution(h, alpha) / masking;
    return vec4(weight * masking
                    * mx_environment_radiance(L, max(float(u_envRadianceMips) - 2.5 - 0.5 * log2(solid), 0.0)),
                clamp(dot(V, H), MX_EPSILON, 1.0));
}

// What the lobe reflects of all directions, or one sample's part of it.
vec3 mx_ggx_environment(vec2 roughness, vec3 N, vec3 X, vec3 V, string model, vec3 n, vec3 k, vec3 f90, float exponent,
                        float film, float film_ior, int sample_index)
{
    if (option_environment == 0)
        return vec3(0.0);
    vec2 alpha = mx_ggx_alpha(roughness);
    vec3 scale = mx_ggx_compensation(mx_ggx_albedo(alpha, mx_view_cosine(N, V)), model, n, k, f90, exponent, film, film_ior);
    if (option_environment == 1)
        return scale * mx_ggx_prefiltered(alpha, N, V, 0.0, model, n, k, f90, exponent, film, film_ior);
    vec3 n_v = mx_facing(N, V);
    vec4 light = mx_ggx_sample(sample_index, n_v, mx_tangent(n_v, X), V, mx_view_cosine(N, V), alpha, 0.0);
    return scale * light.xyz * mx_fresnel(light.w, model, n, k, f90, exponent, film, film_ior);
}

// What it refracts, as above.
vec3 mx_ggx_refraction(vec2 roughness, vec3 N, vec3 X, vec3 V, float ior, string model, vec3 n, vec3 k, vec3 f90,
                       float exponent, float film, float film_ior, int sample_index)
{
    if (option_environment == 0)
        return vec3(0.0);
    vec2 alpha = mx_ggx_alpha(roughness);
    if (option_environment == 1)
        return mx_ggx_prefiltered(alpha, N, V, ior, model, n, k, f90, exponent, film, film_ior);
    vec3 n_v = mx_facing(N, V);
    vec4 light = mx_ggx_sample(sample_index, n_v, mx_tangent(n_v, X), V, mx_view_cosine(N, V), alpha, ior);
    return light.xyz * (1.0 - mx_fresnel(light.w, model, n, k, f90, exponent, film, film_ior));
}
