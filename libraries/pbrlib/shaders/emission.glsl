// SPDX-License-Identifier: Apache-2.0
// uniform_edf, conical_edf and generalized_schlick_edf.

#include "frame.glsl"

in vec3 normalWorld;

// Light that leaves the surface alike in all directions.
vec3 mx_uniform_edf_emission(vec3 color)
{
    return color;
}

// Light in a cone around N: constant inside of the inner cone, fading to nothing at the outer one. The angles are
// full apex angles in degrees.
vec3 mx_conical_edf_emission(vec3 color, vec3 N, float inner_angle, float outer_angle, vec3 V)
{
    vec2 cones = cos(radians(0.5 * vec2(max(inner_angle, outer_angle), inner_angle)));
    return color * (cones.x < cones.y ? smoothstep(cones.x, cones.y, dot(N, V)) : step(cones.y, dot(N, V)));
}

// Schlick's curve from color0 facing the viewer to color90 at grazing angles, which scales an emission; the normal
// is the geometry's own.
vec3 mx_generalized_schlick_edf_factor(vec3 color0, vec3 color90, float exponent, vec3 N, vec3 V)
{
    float cosine = min(abs(dot(N, V)), 1.0);
    return mix(color0, color90, pow(1.0 - cosine, exponent));
}
