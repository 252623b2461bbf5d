// SPDX-License-Identifier: Apache-2.0
// Rotations. Angles are in radians and turn as those of row vectors do (v' = v * M): clockwise.

vec2 mx_rotate2d(vec2 v, float angle)
{
    float s = sin(angle);
    float c = cos(angle);
    return vec2(c * v.x + s * v.y, c * v.y - s * v.x);
}

// Rodrigues' formula; the axis has unit length.
vec3 mx_rotate3d(vec3 v, float angle, vec3 axis)
{
    float c = cos(angle);
    return v * c + cross(v, axis) * sin(angle) + axis * (dot(axis, v) * (1.0 - c));
}

vec2 mx_place2d(vec2 texcoord, vec2 pivot, vec2 scale, float rotate, vec2 offset, int operationorder)
{
    vec2 p = texcoord - pivot;
    float angle = radians(rotate);
    if (operationorder == 1)
        p = mx_rotate2d(p - offset, angle) / scale;
    else
        p = mx_rotate2d(p / scale, angle) - offset;
    return p + pivot;
}
