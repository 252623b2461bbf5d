// SPDX-License-Identifier: Apache-2.0
// Decals in images of their own (docs/deferred.md): a pixel of an image is decal, the sum of what decals put there with the part w of the base
// that they leave. The compiler calls these functions (src/deferred).

// A value of the base below decals.
vec3 mx_decal_over(vec3 base, vec4 decal)
{
    return base * decal.w + decal.xyz;
}

float mx_decal_over(float base, vec4 decal)
{
    return base * decal.w + decal.x;
}

// An amount of the base, which decals have nothing of; of a hue, what it lacks.
float mx_decal_left(float base, vec4 decal)
{
    return base * decal.w;
}

vec3 mx_decal_left(vec3 base, vec4 decal)
{
    return base * decal.w;
}

vec3 mx_decal_hue(vec3 base, vec4 decal)
{
    return 1.0 - (1.0 - base) * decal.w;
}

// Glints are numbers of facets, which have no mean.
float mx_decal_glints(float density, vec4 decal)
{
    return decal.w > 0.5 ? density : 0.0;
}

// Normals are stored from 0 to 1. Without decals the base keeps its normal to the bit.
vec3 mx_decal_normal(vec3 base, vec4 decal)
{
    if (decal.w >= 1.0)
        return base;
    return normalize(base * (decal.w + 1e-6) + 2.0 * decal.xyz - (1.0 - decal.w));
}

// The pixel of a decal: a value that weighs so much, and what it leaves of the base by blending.
vec4 mx_decal_pixel(vec3 value, vec3 weight, float opacity)
{
    return vec4(value * weight, opacity);
}

vec4 mx_decal_pixel_of_normal(vec3 normal, float opacity)
{
    return vec4((normal * 0.5 + 0.5) * opacity, opacity);
}
