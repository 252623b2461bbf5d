// SPDX-License-Identifier: Apache-2.0
// Parameter blending: the parts a and b of an operator become one slab (docs/slabs.md). A part has the weight w of its interface, and its medium
// sends back the diffuse light d. The slab reflects along its normal as much as the operator:
//
//     f0 = w_a f0_a + w_b f0_b,   albedo = (d_a + d_b) / (1 - f0)
//
// The compiler calls these functions (src/slabs).

#include "../pbrlib/shaders/closure.glsl"

// Share of b in the amounts of both; 0 where both are 0.
float mx_blend_share(float a, float b)
{
    if (mx_known(a == 0.0) && !mx_known(b == 0.0))
        return 1.0;
    return b / max(a + b, 1e-6);
}

// Share of b in the light of both.
float mx_blend_share(vec3 a, vec3 b)
{
    return mx_blend_share(mx_mean(a), mx_mean(b));
}

// ---- light along the normal ------------------------------------------------------------------------------------------

// Diffuse light of a medium below an interface of the weight w.
vec3 mx_blend_diffuse(vec3 f0, vec3 albedo, float w)
{
    return (1.0 - f0) * albedo * w;
}

// Diffuse light of a medium below an interface of the weight w.
vec3 mx_blend_diffuse(vec3 f0, vec3 albedo, vec3 w)
{
    return (1.0 - f0) * albedo * w;
}

// Albedo of a slab along its normal.
vec3 mx_blend_seen(vec3 f0, vec3 albedo)
{
    return clamp(f0 + (1.0 - f0) * albedo, 0.0, 1.0);
}

// Albedo of the medium that sends back the diffuse light d below an interface.
vec3 mx_blend_albedo(vec3 f0, vec3 d)
{
    return d / max(1.0 - f0, 0.001);
}

// Albedo of the medium that sends back the diffuse light of both parts below an interface.
vec3 mx_blend_albedo(vec3 f0, vec3 d_a, vec3 d_b)
{
    return clamp(mx_blend_albedo(f0, d_a + d_b), 0.0, 1.0);
}

// f0 of the slab, of the light that the interfaces of both reflect.
vec3 mx_blend_f0(vec3 light_a, vec3 light_b)
{
    return clamp(light_a + light_b, 0.0, 1.0);
}

// Amount of fuzz.
float mx_blend_fuzz(float amount_a, float amount_b)
{
    return clamp(amount_a + amount_b, 0.0, 1.0);
}

// Roughness of the fuzz; below 0 it is that of the slab.
float mx_blend_fuzz_roughness(float fuzz_roughness, float roughness)
{
    return fuzz_roughness < 0.0 ? roughness : fuzz_roughness;
}

// Normal between those of both parts.
vec3 mx_blend_normal(vec3 N_a, vec3 N_b, float share)
{
    return normalize(mix(N_a, N_b, share));
}

// ---- anisotropy ------------------------------------------------------------------------------------------------------
// Anisotropies along the tangents X_a and X_b add like vectors of the doubled angle. The sum is over X_a and its bitangent.

// Sum of two anisotropies as vectors of the doubled angle.
vec2 mx_blend_anisotropies(float a, float b, float share, vec3 N, vec3 X_a, vec3 X_b)
{
    float c = dot(X_a, X_b);
    float s = dot(cross(N, X_a), X_b);
    float of_b = share * b;
    return vec2((1.0 - share) * a + of_b * (c * c - s * s), of_b * ((s + s) * c));
}

// Anisotropy of a sum of anisotropies.
float mx_blend_anisotropy(vec2 sum)
{
    return sqrt(sum.x * sum.x + sum.y * sum.y);
}

// Tangent of a sum of anisotropies.
vec3 mx_blend_tangent(vec2 sum, vec3 N, vec3 X_a)
{
    float x = max(abs(sum.x), 1e-6); // atan(0, 0) is open
    float angle = 0.5 * atan(sum.y, sum.x < 0.0 ? -x : x);
    return X_a * cos(angle) + cross(N, X_a) * sin(angle);
}

// ---- coverage --------------------------------------------------------------------------------------------------------

// Coverage of two parts of which each hides the other.
float mx_blend_coverage(float a, float b)
{
    return 1.0 - (1.0 - a) * (1.0 - b);
}

// Light that reaches what lies below a part of a coverage and is there itself in a part of the area.
vec3 mx_blend_below(vec3 through, float coverage, float own_coverage)
{
    return (1.0 - coverage * (1.0 - through)) * own_coverage;
}

// Amount where the slab is there, of an amount over the whole area.
vec3 mx_blend_per_coverage(vec3 amount, float coverage)
{
    return amount / max(coverage, 1e-6);
}

// Amount where the slab is there, of an amount over the whole area.
float mx_blend_per_coverage(float amount, float coverage)
{
    return amount / max(coverage, 1e-6);
}

// ---- media -----------------------------------------------------------------------------------------------------------
// Light goes through the thickness of a medium as many times as `ways` says. Optical depths are those of one way.

// Light that goes through a medium.
vec3 mx_blend_through(vec3 mean_free_path, float thickness, float ways)
{
    return exp(-(thickness * ways / max(mean_free_path, 1e-6)));
}

// Optical depth of a medium.
vec3 mx_blend_depth(vec3 mean_free_path, float thickness)
{
    return thickness / max(mean_free_path, 1e-6);
}

// Optical depth of the medium that lets `through` through.
vec3 mx_blend_depth_of(vec3 through, float ways)
{
    return -log(clamp(through, 1e-30, 0.99999)) / ways;
}

// Optical depth of the medium that lets as much through as one that is there in a part of the area.
vec3 mx_blend_depth(vec3 mean_free_path, float thickness, float ways, float coverage)
{
    return mx_blend_depth_of(1.0 - coverage * (1.0 - mx_blend_through(mean_free_path, thickness, ways)), ways);
}

// Mean free path of the layer that lets as much through as a and b side by side.
vec3 mx_blend_path_beside(vec3 path_a, vec3 path_b, float share, float thickness, float ways)
{
    vec3 through = mix(mx_blend_through(path_a, thickness, ways), mx_blend_through(path_b, thickness, ways), share);
    return max(thickness / mx_blend_depth_of(through, ways), 1e-6);
}

// Mean free path of the layer with the optical depths of a and b, one over the other.
vec3 mx_blend_path_over(vec3 depth_a, vec3 depth_b, float thickness)
{
    return thickness / max(depth_a + depth_b, 1e-6);
}

// Albedo of the layer with the optical depths of a and b, one over the other.
vec3 mx_blend_albedo_over(vec3 albedo_a, vec3 albedo_b, vec3 depth_a, vec3 depth_b)
{
    return mix(albedo_a, albedo_b, depth_b / max(depth_a + depth_b, 1e-6));
}

// Mean free path of the layer that lets a colour through.
vec3 mx_blend_path_of(vec3 color, float thickness, float ways)
{
    return -(ways * thickness) / log(clamp(color, 1e-4, 0.99999));
}

// ---- other closures as slabs -----------------------------------------------------------------------------------------

// Roughness of a slab for the widths of a lobe along two axes: the square root of their geometric mean.
float mx_blend_roughness(vec2 alpha)
{
    return sqrt(sqrt(max(alpha.x * alpha.y, 0.0)));
}
