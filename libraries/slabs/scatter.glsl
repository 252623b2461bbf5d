// SPDX-License-Identifier: Apache-2.0
// Media scatter light, also that of a mirror below them. The compiler calls some of it, too (src/slabs/spread.c).

// Ways through a medium are multiples of its thickness. Every medium has the index 1.5.
const float MX_MEAN_WAY = 1.1458980; // over cosine-weighted directions: 4.5 - 1.5 sqrt(5)
const float MX_MOST_ANISOTROPIC = 0.95; // of phase functions: beyond, all light would go straight on

// The number s of a medium that reflects `color` at infinite thickness: the albedo of one scattering is 1 - s^2
// (Kulla and Conty 2017, "Revisiting Physically Based Shading at Imageworks").
vec3 mx_medium_loss(vec3 color)
{
    vec3 c = clamp(color, 0.0, 1.0);
    vec3 s = clamp(4.09712 + 4.20863 * c - sqrt(9.59217 + c * (41.6808 + 17.7126 * c)), 0.0, 1.0);
    return mix(s, vec3(1.0), step(c, vec3(0.0))); // exactly: no albedo, no scattering
}

bool mx_is_black(vec3 color)
{
    return max(color.x, max(color.y, color.z)) <= 0.0;
}

// Scattering coefficient of a medium over a length, for light that walks through it at random; 0 where it is
// opaque.
//
// g by similarity, see mx_medium_depth.
vec3 mx_medium_scattering(vec3 color, vec3 mean_free_path, float g, float length)
{
    if (mx_is_black(mean_free_path) || mx_is_black(color))
        return vec3(0.0);
    vec3 loss = mx_medium_loss(color);
    return max(length, 0.0) / max(mean_free_path, 1e-6) * (1.0 - loss * loss) / (1.0 - clamp(g, -MX_MOST_ANISOTROPIC, MX_MOST_ANISOTROPIC) * loss * loss);
}

// The share of light that goes straight through media, in and out again the mean way, of all that comes back through them from a mirror of
// reflectance f0. `depth` is their optical depth for scattering alone, along the normal.
//
// White media let T = 1 / (1 + 3/4 depth) of even light through (Schuster 1905, "Radiation through a foggy atmosphere"). Light bounces between
// them and the mirror, so T^2 / (1 - f0 (1 - T)) comes back.
vec3 mx_medium_straight(vec3 depth, vec3 f0)
{
    vec3 q = 0.75 * depth;
    return exp(-2.0 * MX_MEAN_WAY * depth) * (1.0 + q) * (1.0 + q * (1.0 - f0));
}

// Diffuse albedo of opaque matter that mirrors a share `straight` of its f0, and sends the rest back evenly: along the normal as much light as
// without the share.
vec3 mx_medium_evened(vec3 f0, vec3 albedo, vec3 straight)
{
    vec3 mirrored = f0 * straight;
    return (f0 - mirrored + (1.0 - f0) * albedo) / max(1.0 - mirrored, 1e-6);
}
