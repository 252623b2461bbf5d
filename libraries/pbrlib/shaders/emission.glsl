// SPDX-License-Identifier: Apache-2.0
// uniform_edf, conical_edf and generalized_schlick_edf.

#include "frame.glsl"

in vec3 normalWorld;

vec3 mx_uniform_edf_emission(vec3 color)
{
    return color;
}

// Constant inside the inner cone, fading to nothing at the outer one; full apex angles in degrees.
vec3 mx_conical_edf_emission(vec3 color, vec3 N, float inner_angle, float outer_angle, vec3 V)
{
    vec2 cones = cos(radians(0.5 * vec2(max(inner_angle, outer_angle), inner_angle)));
    return color * (cones.x < cones.y ? smoothstep(cones.x, cones.y, dot(N, V)) : step(cones.y, dot(N, V)));
}

// Factor of the emission below a Schlick interface on the geometry's own normal.
vec3 mx_generalized_schlick_edf_factor(vec3 color0, vec3 color90, float exponent, vec3 V)
{
    float cosine = min(abs(dot(normalize(normalWorld), V)), 1.0);
    return mix(color0, color90, pow(1.0 - cosine, exponent));
}
