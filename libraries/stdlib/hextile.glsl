// SPDX-License-Identifier: Apache-2.0
// Morten S. Mikkelsen, "Practical Real-Time Hex-Tiling", Journal of Computer Graphics Techniques 11(2), 2022.
//
// Each point lies in a triangle of a lattice, whose three corners are the middles of hexagonal tiles. Each tile shows
// the texture turned, scaled and moved at random; the three are blended by barycentric weights.

#include "image.glsl"
#include "rotate.glsl"

const float MX_LATTICE_DENSITY = 3.4641016; // 2 sqrt(3) tiles per unit
const float MX_LATTICE_SKEW = 0.57735027;   // tan(30 degrees)

struct mx_HexTile {
    vec2 uv;
    vec2 dx;
    vec2 dy;
    float rotation;
};

// The part that images of the same coordinates share: the three tiles and how near they are.
struct mx_HexTiles {
    mx_HexTile a;
    mx_HexTile b;
    mx_HexTile c;
    vec3 barycentric;
};

// The corners of the triangle around a point, in lattice coordinates. Returns its barycentric coordinates.
vec3 mx_hextile_corners(vec2 coord, out vec2 corner1, out vec2 corner2, out vec2 corner3)
{
    vec2 p = coord * MX_LATTICE_DENSITY;
    vec2 skewed = vec2(p.x - MX_LATTICE_SKEW * p.y, 2.0 * MX_LATTICE_SKEW * p.y);
    vec2 base = floor(skewed);
    vec2 f = skewed - base;
    float rest = 1.0 - f.x - f.y;
    float upper = rest <= 0.0 ? 1.0 : 0.0; // which half of the parallelogram
    float side = 2.0 * upper - 1.0;
    corner1 = base + upper;
    corner2 = base + vec2(upper, 1.0 - upper);
    corner3 = base + vec2(1.0 - upper, upper);
    return vec3(-rest * side, upper - f.y * side, upper - f.x * side);
}

// Dave Hoskins, "Hash without Sine", 2014.
vec2 mx_hextile_random(vec2 corner)
{
    vec3 q = fract((corner.xyx + 0.12345) * vec3(0.1031, 0.1030, 0.0973)); // away from the zeros of the hash
    q += dot(q, q.yzx + 33.33);
    return fract((q.xx + q.yz) * q.zy);
}

mx_HexTile mx_hextile(vec2 coord, vec2 corner, float rotation, vec2 rotation_range, float scale, vec2 scale_range,
                      float offset, vec2 offset_range)
{
    vec2 random = mx_hextile_random(corner);
    vec2 center = vec2(corner.x + 0.5 * corner.y, corner.y / (2.0 * MX_LATTICE_SKEW)) / MX_LATTICE_DENSITY;
    float size = mix(1.0, mix(scale_range.x, scale_range.y, random.y), scale);
    mx_HexTile tile;
    tile.rotation = radians(mix(rotation_range.x, rotation_range.y, random.x * rotation));
    tile.uv = mx_rotate2d(coord - center, -tile.rotation) / size + center +
              mix(vec2(offset_range.x), vec2(offset_range.y), random * offset);
    tile.dx = mx_rotate2d(dFdx(coord), -tile.rotation) / size;
    tile.dy = mx_rotate2d(dFdy(coord), -tile.rotation) / size;
    if (option_texture_origin == 1) {
        tile.uv.y = 1.0 - tile.uv.y;
        tile.dx.y = -tile.dx.y;
        tile.dy.y = -tile.dy.y;
    }
    return tile;
}

mx_HexTiles mx_hextiles(vec2 coord, float rotation, vec2 rotation_range, float scale, vec2 scale_range, float offset, vec2 offset_range)
{
    mx_HexTiles tiles;
    vec2 corner1, corner2, corner3;
    tiles.barycentric = mx_hextile_corners(coord, corner1, corner2, corner3);
    tiles.a = mx_hextile(coord, corner1, rotation, rotation_range, scale, scale_range, offset, offset_range);
    tiles.b = mx_hextile(coord, corner2, rotation, rotation_range, scale, scale_range, offset, offset_range);
    tiles.c = mx_hextile(coord, corner3, rotation, rotation_range, scale, scale_range, offset, offset_range);
    return tiles;
}

// Christophe Schlick, "Fast Alternatives to Perlin's Bias and Gain Functions", Graphics Gems IV, 1994.
float mx_schlick_gain(float x, float gain)
{
    float a = (1.0 / clamp(gain, 0.001, 0.999) - 2.0) * (1.0 - 2.0 * x);
    return x < 0.5 ? x / (a + 1.0) : (a - x) / (a - 1.0);
}

// How much each of three tiles counts, by its distance and its importance. A falloff of 0.5 changes nothing.
vec3 mx_hextile_weights(vec3 barycentric, vec3 importance, float falloff)
{
    vec3 w = importance * pow(barycentric, vec3(7.0));
    w /= w.x + w.y + w.z;
    if (falloff != 0.5) {
        w = vec3(mx_schlick_gain(w.x, falloff), mx_schlick_gain(w.y, falloff), mx_schlick_gain(w.z, falloff));
        w /= w.x + w.y + w.z;
    }
    return w;
}

// Bright parts of tiles prevail by `contrast`. Without `has_alpha` the fourth channel is 0.
vec4 mx_hextiledimage(sampler2D file, mx_HexTiles tiles, float falloff, float contrast, vec3 lumacoeffs, bool has_alpha)
{
    vec4 c1 = textureGrad(file, tiles.a.uv, tiles.a.dx, tiles.a.dy);
    vec4 c2 = textureGrad(file, tiles.b.uv, tiles.b.dx, tiles.b.dy);
    vec4 c3 = textureGrad(file, tiles.c.uv, tiles.c.dx, tiles.c.dy);
    vec3 luma = vec3(dot(c1.rgb, lumacoeffs), dot(c2.rgb, lumacoeffs), dot(c3.rgb, lumacoeffs));
    vec3 w = mx_hextile_weights(tiles.barycentric, mix(vec3(1.0), luma, contrast), falloff);
    float alpha = has_alpha ? dot(mx_hextile_weights(tiles.barycentric, vec3(1.0), falloff), vec3(c1.a, c2.a, c3.a)) : 0.0;
    return vec4(w.x * c1.rgb + w.y * c2.rgb + w.z * c3.rgb, alpha);
}

// Surface gradients add up where normals do not: Morten S. Mikkelsen, "Surface Gradient-Based Bump Mapping Framework",
// Journal of Computer Graphics Techniques 9(3), 2020.
vec3 mx_surface_gradient(vec3 normal, vec3 bumped)
{
    float d = dot(normal, bumped);
    return (d * normal - bumped) / max(1e-8, abs(d));
}

// The surface gradient of the normal that a tile stores, which turns with the tile: clockwise in texture space.
vec3 mx_hextile_gradient(sampler2D file, mx_HexTile tile, float strength, bool flip_g, vec3 normal, vec3 tangent, vec3 bitangent)
{
    vec3 texel = textureGrad(file, tile.uv, tile.dx, tile.dy).xyz;
    vec3 n = 2.0 * vec3(texel.x, flip_g ? 1.0 - texel.y : texel.y, texel.z) - 1.0;
    vec2 lean = mx_rotate2d(n.xy, tile.rotation);
    vec3 slope = tangent * lean.x + bitangent * lean.y;
    return mx_surface_gradient(normal, normalize(slope * strength + normal * n.z));
}

vec3 mx_hextilednormalmap(sampler2D file, mx_HexTiles tiles, float falloff, float strength, bool flip_g, vec3 normal, vec3 tangent, vec3 bitangent)
{
    vec3 w = clamp(mx_hextile_weights(tiles.barycentric, vec3(1.0), falloff), 0.0, 1.0);
    return normalize(normal - w.x * mx_hextile_gradient(file, tiles.a, strength, flip_g, normal, tangent, bitangent)
                            - w.y * mx_hextile_gradient(file, tiles.b, strength, flip_g, normal, tangent, bitangent)
                            - w.z * mx_hextile_gradient(file, tiles.c, strength, flip_g, normal, tangent, bitangent));
}
