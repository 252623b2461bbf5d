// SPDX-License-Identifier: Apache-2.0
// Rotations. Angles are in radians and turn as those of row vectors do (v' = v * M): clockwise.

// The vector v turned clockwise by an angle in radians.
vec2 mx_rotate2d(vec2 v, float angle)
{
    float s = sin(angle);
    float c = cos(angle);
    return vec2(c * v.x + s * v.y, c * v.y - s * v.x);
}

// The vector v turned clockwise around an axis of unit length, by an angle in radians (Rodrigues' formula).
vec3 mx_rotate3d(vec3 v, float angle, vec3 axis)
{
    float c = cos(angle);
    return v * c + cross(v, axis) * sin(angle) + axis * (dot(axis, v) * (1.0 - c));
}

// Texture coordinates that are scaled, turned and moved about a pivot.
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
