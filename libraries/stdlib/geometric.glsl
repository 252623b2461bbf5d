// SPDX-License-Identifier: Apache-2.0
// Normals from textures.

// A texel of zeros is a missing map, and means the normal itself.
vec3 mx_normalmap(vec3 texel, vec2 scale, vec3 normal, vec3 tangent, vec3 bitangent)
{
    vec3 n = dot(texel, texel) == 0.0 ? vec3(0.0, 0.0, 1.0) : texel * 2.0 - 1.0;
    return normalize(tangent * (n.x * scale.x) + bitangent * (n.y * scale.y) + normal * n.z);
}

// The graph (u, v, height) is a surface over the screen. Its normal is the cross product of its two screen-space
// derivatives, whatever the mapping between screen and texture is.
vec3 mx_slopes_to_normal(vec3 dx, vec3 dy)
{
    vec3 n = cross(dx, dy);
    if (dot(n, n) < 1e-16)
        n = vec3(0.0, 0.0, 1.0);
    else if (n.z < 0.0)
        n = -n; // mirrored texture coordinates
    return normalize(n) * 0.5 + 0.5;
}

vec3 mx_heighttonormal(float height, float scale, vec2 texcoord)
{
    float steepness = scale / 16.0; // heights count as they do in a Sobel filter
    return mx_slopes_to_normal(vec3(dFdx(texcoord), dFdx(height) * steepness), vec3(dFdy(texcoord), dFdy(height) * steepness));
}
