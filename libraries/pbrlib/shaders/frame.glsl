// SPDX-License-Identifier: Apache-2.0
// Constants and the shading frame shared by all closures.

const float MX_PI = 3.14159265;
const float MX_EPSILON = 1e-8;

// N on the side of the surface that V sees.
vec3 mx_facing(vec3 N, vec3 V)
{
    return faceforward(N, -V, N);
}

// Cosine between V and the side of the surface that it sees.
float mx_view_cosine(vec3 N, vec3 V)
{
    return max(abs(dot(N, V)), MX_EPSILON);
}

// Axes of the tangent space around N with x along X: `w * frame` enters it, `frame * w` leaves it.
mat3 mx_frame(vec3 N, vec3 X)
{
    vec3 x = normalize(X - dot(X, N) * N);
    return mat3(x, cross(N, x), N);
}
