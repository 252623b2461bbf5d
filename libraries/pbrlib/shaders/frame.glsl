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

// Unit tangent along X.
vec3 mx_tangent(vec3 N, vec3 X)
{
    return normalize(X - dot(X, N) * N);
}

// Into the tangent space around N with x along the unit tangent `x`, and out of it.
vec3 mx_enter_frame(vec3 w, vec3 N, vec3 x)
{
    return vec3(dot(w, x), dot(w, cross(N, x)), dot(w, N));
}

vec3 mx_leave_frame(vec3 w, vec3 N, vec3 x)
{
    return w.x * x + w.y * cross(N, x) + w.z * N;
}

// A polynomial of two variables, what directional albedos are fitted by (the programs in fits/).
float mx_bicubic(mat4 m, float x, float y)
{
    return dot(vec4(1.0, x, x * x, x * x * x), m * vec4(1.0, y, y * y, y * y * y));
}
