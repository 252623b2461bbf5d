// SPDX-License-Identifier: Apache-2.0
// Directions for path tracing. Random numbers xi are in [0, 1).

#include "frame.glsl"

const int option_path = 0; // 1: the caller traces paths, which come from inside bodies, too
const int option_stored = 0; // 1: a pass, whose closures come from the storage of the deferred pipeline
const int option_sss = 0; // 1: a pass of that pipeline spreads subsurface light

// Axes of the tangent space around N with x along X: `w * frame` enters it, `frame * w` leaves it.
mat3 mx_frame(vec3 N, vec3 X)
{
    mat3 frame;
    frame[0] = mx_tangent(N, X);
    frame[1] = cross(N, frame[0]);
    frame[2] = N;
    return frame;
}

// Axes of a tangent space around N, where no direction in the surface matters.
mat3 mx_any_frame(vec3 N)
{
    return mx_frame(N, abs(N.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
}

// The point at `radius` from the origin, as far around it as `turn` says: 1 is a whole turn.
vec2 mx_polar(float radius, float turn)
{
    return radius * cos(2.0 * MX_PI * (turn - vec2(0.0, 0.25)));
}

// A direction around +z from two random numbers xi; directions are as dense as their cosine.
vec3 mx_sample_cosine(vec2 xi)
{
    return vec3(mx_polar(sqrt(xi.x), xi.y), sqrt(1.0 - xi.x));
}

// Density of directions L around N that are as dense as their cosine.
float mx_cosine_pdf(vec3 N, vec3 L)
{
    return max(dot(N, L), 0.0) / MX_PI;
}
