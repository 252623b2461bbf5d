// SPDX-License-Identifier: Apache-2.0
// Layers of a medium that absorbs and scatters light: what they reflect and let through, and their coefficients for light that walks through
// them at random. `color` is the albedo at infinite thickness, `mean_free_path` the way between two collisions, g the phase anisotropy.

#include "scatter.glsl"

const float MX_CLEAR_PATH = 1e6; // of a clear medium, by which src/slabs/recognise.c knows matter that is an interface only

// How far light goes through a medium of index 1.5, over the thickness, on its way to or from V.
float mx_way(vec3 N, vec3 V)
{
    float c = dot(N, V);
    return 1.5 * inversesqrt(1.25 + c * c);
}

// Optical depth, along the normal, of the medium that scatters evenly and stands for one with the phase anisotropy
// g, by similarity.
vec3 mx_medium_depth(vec3 loss, vec3 mean_free_path, float g, float thickness)
{
    float forward = clamp(g, -MX_MOST_ANISOTROPIC, MX_MOST_ANISOTROPIC);
    return max(thickness, 0.0) / max(mean_free_path, 1e-6) * (1.0 - forward) / (1.0 - forward * loss * loss);
}

// Light that the layer of a medium reflects and lets through (`transmitted`), with all orders of scattering, on a
// way: a is the albedo of one scattering, t the optical depth (after Kubelka and Munk 1931).
//
// Coefficients by the program fits/medium.c, which follows light at random; within 0.0053. Nothing is lost where
// the albedo is 1.
vec3 mx_medium_layer(vec3 a, vec3 t, float way, out vec3 transmitted)
{
    vec3 u = t / (1.0 + t);
    float x = way - 1.0;
    vec3 s = 0.5 * a * way * (1.0 + u * (-1.0290 + u * (0.5422 - 0.3924 * a) + a * (0.7451 + 0.3145 * a) + x * (1.1669 - 1.3629 * a)));
    vec3 k = (1.0 - a) * way
           * (1.0 + a * u * (0.6040 + u * (-0.1979 - 0.4865 * a) + a * (1.3930 - 0.5447 * a) + x * (0.2436 - 2.0559 * a)
                             + a * a * a * a * (-0.0215 + 0.5896 * u)));
    vec3 g = sqrt(k * (k + 2.0 * s));
    vec3 e = exp(-g * t);
    vec3 ways = mix((1.0 - e * e) / max(g, 1e-6), 2.0 * t * (1.0 - g * t), step(g * t, vec3(1e-3))); // by its series where g is near 0
    vec3 below = (k + s) * ways + 1.0 + e * e;
    transmitted = 2.0 * e / below;
    return s * ways / below;
}

// Light that the layer of a medium lets through on a way.
//
// A medium without scattering has only absorption (Beer, Lambert).
vec3 mx_medium_through(vec3 color, vec3 mean_free_path, float g, float thickness, float way)
{
    vec3 loss = mx_medium_loss(color);
    vec3 depth = mx_medium_depth(loss, mean_free_path, g, thickness);
    if (mx_is_black(color))
        return exp(-depth * way);
    vec3 through;
    mx_medium_layer(1.0 - loss * loss, depth, way, through);
    return through;
}

// Light that the layer of a medium reflects on a way.
vec3 mx_medium_reflected(vec3 color, vec3 mean_free_path, float g, float thickness, float way)
{
    if (mx_is_black(color))
        return vec3(0.0);
    vec3 ignored;
    vec3 loss = mx_medium_loss(color);
    return mx_medium_layer(1.0 - loss * loss, mx_medium_depth(loss, mean_free_path, g, thickness), way, ignored);
}

// Absorption coefficient of a medium over a length, for light that walks through it at random; 0 where it is
// opaque.
vec3 mx_medium_absorption(vec3 color, vec3 mean_free_path, float g, float length)
{
    if (mx_is_black(mean_free_path))
        return vec3(0.0);
    return max(length, 0.0) / max(mean_free_path, 1e-6) - mx_medium_scattering(color, mean_free_path, g, length);
}
