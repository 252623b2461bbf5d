// SPDX-License-Identifier: Apache-2.0
// What the nodes of bsdf.mtlx need beyond pbrlib.

#include "../pbrlib/shaders/fresnel.glsl"
#include "../pbrlib/shaders/optics.glsl"

// All lobes are GGX. Where "beckman" is asked for (Beckmann's distribution), the lobe is the GGX one of equal median slope:
// half of the slopes are below a sqrt(ln 2) for Beckmann's, 1 - exp(-s^2 / a^2), and below a for GGX, s^2 / (s^2 + a^2)
// (Walter et al. 2007, equations 28 and 35). GGX keeps its longer tail.
vec2 mx_microfacet_roughness(float roughness, float anisotropy, string distribution)
{
    const float MEDIAN_SLOPE = 0.83255461; // sqrt(ln 2)
    vec2 alpha = mx_roughness_anisotropy(roughness, abs(anisotropy));
    if (distribution == "beckman")
        alpha *= MEDIAN_SLOPE;
    return anisotropy < 0.0 ? alpha.yx : alpha;
}

// A film changes how much its base reflects; how much, depends on the base, which a modifier cannot see. The factor here is
// the change for smooth iron (n = k = 3 in green light; titanium and chromium are near), whose reflectance of 0.5 lies
// between those of plastic and silver: reflectance with the film over that with a vanishing one. Kept within 1, it never
// adds energy, so a film makes no plastic brighter. The normal is the geometry's; what lies below a coating is tinted too.
vec3 mx_thinfilmbsdf_factor(float thickness, float ior, vec3 N, vec3 V)
{
    const vec3 IRON = vec3(3.0);
    if (thickness <= 0.0)
        return vec3(1.0);
    float cosine = clamp(abs(dot(N, V)), MX_EPSILON, 1.0);
    return min(mx_film_index(cosine, IRON, IRON, thickness, ior)
             / mx_film_index(cosine, IRON, IRON, 0.0, ior), 1.0);
}
