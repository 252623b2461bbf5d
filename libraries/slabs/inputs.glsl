// SPDX-License-Identifier: Apache-2.0
// Inputs of slabs from other descriptions: a transmittance, haze, a film.

#include "../pbrlib/shaders/fresnel.glsl"

// Mean free path of a medium that lets `transmittance` through a thickness (Beer, Lambert): 0 lets nothing through,
// and nearly 1 nearly all.
vec3 mx_slab_mean_free_path(vec3 transmittance, float thickness)
{
    vec3 through = clamp(transmittance, 0.0, 0.99999);
    return mix(-thickness / log(max(through, 1e-30)), vec3(0.0), step(through, vec3(0.0)));
}

// GGX's alpha of the wide lobe.
float mx_slab_haze_alpha(float roughness, float extent)
{
    return clamp(roughness * roughness * (1.0 + extent), 0.0, 1.0);
}

// Barla, Pacanowski and Vangorp 2018, "A Composite BRDF Model for Hazy Gloss": the brightness of f0 with haze, and the share of the wide lobe.
// The peak keeps the brightness of f0; p is the peak of the wide lobe over that of the other.
vec2 mx_slab_haze(vec3 f0, float roughness, float haziness, float extent)
{
    float core = max(f0.x, max(f0.y, f0.z));
    float ratio = roughness * roughness / max(mx_slab_haze_alpha(roughness, extent), MX_EPSILON);
    float p = ratio * ratio;
    float k = haziness * (core > p ? (1.0 - core) / max(1.0 - p, MX_EPSILON) : core / max(p, MX_EPSILON));
    float whole = core + (1.0 - p) * k;
    return vec2(whole, k / max(whole, MX_EPSILON));
}

// f0 with haze.
vec3 mx_slab_haze_f0(vec3 f0, float roughness, float haziness, float extent)
{
    float core = max(f0.x, max(f0.y, f0.z));
    return f0 * (mx_slab_haze(f0, roughness, haziness, extent).x / max(core, MX_EPSILON));
}

// f0 with a film, at a cosine: f0 is that of a dielectric in air, and the film adds to Schlick's curve what it adds to
// the dielectric (Belcour and Barla 2017; XYZ is that of the CIE's RGB).
vec3 mx_slab_film_at(vec3 f0, float thickness, float ior, float cosine)
{
    const mat3 RGB_TO_XYZ = mat3(0.49, 0.17697, 0.0, 0.31, 0.8124, 0.01, 0.2, 0.01063, 0.99);
    vec3 amplitude = sqrt(clamp(RGB_TO_XYZ * f0, 0.0, 0.999));
    vec3 permittivity = pow((1.0 + amplitude) / (1.0 - amplitude), vec3(2.0));
    vec3 bare = mx_film_rgb(mx_fresnel_conductor(cosine, permittivity, vec3(0.0)));
    vec3 change = mx_film_index(cosine, permittivity, vec3(0.0), thickness, ior) - bare;
    return clamp(f0 + change / max(1.0 - mx_power5(1.0 - cosine), 0.001), 0.0, 1.0);
}
