// SPDX-License-Identifier: Apache-2.0
// Blur of a graph by evaluating it at other places. The compiler calls these functions (src/dynamic/blur.c).

// Width of a texture read along an axis: the change on the screen and half of the way between the outer places.
vec2 mx_blur_footprint(vec2 before, vec2 behind, vec2 screen)
{
    return abs(screen) + abs((behind - before) * 0.5);
}

// a over the length of a vector, which may be 0.
float mx_blur_over_length(float a, vec3 vector)
{
    return a * inversesqrt(max(dot(vector, vector), 1e-12));
}

// How much of the step to the right is in the step down the picture, which are changes of the position: without it they are perpendicular.
float mx_blur_skew(vec3 right, vec3 down)
{
    return mx_blur_over_length(mx_blur_over_length(dot(right, down), right), right);
}
