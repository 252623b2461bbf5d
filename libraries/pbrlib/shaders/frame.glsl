// SPDX-License-Identifier: Apache-2.0
// Constants and the shading frame shared by all closures.

const float MX_PI = 3.14159265;
const float MX_EPSILON = 1e-8;

// The normal N on the side of the surface that the viewer V sees.
vec3 mx_facing(vec3 N, vec3 V)
{
    return faceforward(N, -V, N);
}

// Cosine between the viewer V and the side of the surface that it sees, never 0.
float mx_view_cosine(vec3 N, vec3 V)
{
    return max(abs(dot(N, V)), MX_EPSILON);
}

// The unit tangent along X at the normal N.
vec3 mx_tangent(vec3 N, vec3 X)
{
    return normalize(X - dot(X, N) * N);
}

// The direction w in the tangent space around N, whose x lies along the unit tangent `x`.
vec3 mx_enter_frame(vec3 w, vec3 N, vec3 x)
{
    return vec3(dot(w, x), dot(w, cross(N, x)), dot(w, N));
}

// The direction that is w in the tangent space around N, whose x lies along the unit tangent `x`.
vec3 mx_leave_frame(vec3 w, vec3 N, vec3 x)
{
    return w.x * x + w.y * cross(N, x) + w.z * N;
}

// x^5.
float mx_power5(float x)
{
    return x * x * x * x * x;
}

// A cubic polynomial of x and y with the coefficients m, to which directional albedos are fitted.
//
// The programs in fits/ make the coefficients.
float mx_bicubic(mat4 m, float x, float y)
{
    return dot(vec4(1.0, x, x * x, x * x * x), m * vec4(1.0, y, y * y, y * y * y));
}
