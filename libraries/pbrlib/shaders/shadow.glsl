// SPDX-License-Identifier: Apache-2.0
// Shadows of a map with the mean depth and the mean of its square (Donnelly and Lauritzen 2006, "Variance Shadow Maps"). The compiler calls
// these functions (src/closure/occlusion_maps.c).

// Functions of the host (docs/hosts.md).
float mxg_shadow(int light, vec3 P, vec3 N, vec3 L);
float mxg_ambient_occlusion(vec3 P, vec3 N);

// Place in the map and depth of a point, 0 to 1.
vec3 mx_shadow_place(mat4 to_map, vec3 point)
{
    vec4 clip = to_map * vec4(point, 1.0);
    return clip.xyz / clip.w * 0.5 + 0.5;
}

// Part of the light that reaches a depth: Chebyshev's upper bound.
float mx_shadow_lit(float depth, float mean, float square)
{
    float variance = max(square - mean * mean, 0.00001);
    float behind = depth - mean;
    return depth <= mean ? 1.0 : variance / (variance + behind * behind);
}
