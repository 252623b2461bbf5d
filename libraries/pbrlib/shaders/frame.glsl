// SPDX-License-Identifier: Apache-2.0
// Constants and the shading frame shared by all closures.

const float MX_PI = 3.14159265;
const float MX_EPSILON = 1e-8;

// N on the side of the surface that V sees.
vec3 mx_facing(vec3 N, vec3 V)
{
    return dot(N, V) < 0.0 ? -N : N;
}

// Axes X, Y, Z of the tangent space seen from V: `w * frame` enters it, `frame * w` leaves it.
mat3 mx_frame(vec3 N, vec3 X, vec3 V)
{
    vec3 z = mx_facing(N, V);
    vec3 x = normalize(X - dot(X, z) * z);
    return mat3(x, cross(z, x), z);
}
