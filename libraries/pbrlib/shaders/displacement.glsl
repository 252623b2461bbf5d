// SPDX-License-Identifier: Apache-2.0
// Displacement of a surface. The compiler calls these functions (src/closure/displacement.c); they read the surface before the displacement.

// Offset of a point by a height along the normal.
vec3 mx_displacement(float height, vec3 normal)
{
    return normalize(normal) * height;
}

// Offset of a point by (x, y, z) along tangent, bitangent and normal.
vec3 mx_displacement(vec3 offset, vec3 normal, vec3 tangent)
{
    vec3 Ng = normalize(normal);
    vec3 X = normalize(tangent);
    return X * offset.x + cross(Ng, X) * offset.y + Ng * offset.z;
}

// Normal of the facet that the changes of a point to the next pixels span, on the side of N.
vec3 mx_facet_normal(vec3 dx, vec3 dy, vec3 N)
{
    vec3 facet = normalize(cross(dx, dy));
    return faceforward(facet, -N, facet);
}

// Normal of the displaced surface at P.
//
// N + g(P) - g(before), where g is the normal of a facet. The facets cancel in the difference, so the surface stays smooth.
vec3 mx_displaced_normal(vec3 before, vec3 P, vec3 normal)
{
    vec3 Ng = normalize(normal);
    return normalize(Ng + (mx_facet_normal(dFdx(P), dFdy(P), Ng) - mx_facet_normal(dFdx(before), dFdy(before), Ng)));
}
