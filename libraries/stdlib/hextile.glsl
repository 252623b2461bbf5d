// SPDX-License-Identifier: Apache-2.0
// Morten S. Mikkelsen, "Practical Real-Time Hex-Tiling", Journal of Computer Graphics Techniques 11(2), 2022.
//
// Each point lies in a triangle of a lattice, whose three corners are the middles of hexagonal tiles. Each tile shows
// the texture turned, scaled and moved at random; the three are blended by barycentric weights.

#include "rotate.glsl"

const float MX_LATTICE_DENSITY = 3.4641016; // 2 sqrt(3) tiles per unit
const float MX_LATTICE_SKEW = 0.57735027;   // tan(30 degrees)

// What images of the same coordinates share: where the three tiles are read, with derivatives, how they are turned, and how near they are.
struct mx_HexTiles {
    vec2 uv1;
    vec2 uv2;
    vec2 uv3;
    vec2 dx1;
    vec2 dx2;
    vec2 dx3;
    vec2 dy1;
    vec2 dy2;
    vec2 dy3;
    vec3 rotation;
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
    vec2 p = corner + 0.12345; // away from the zeros of the hash
    vec3 q = fract(p.xyx * vec3(0.1031, 0.1030, 0.0973));
    q += dot(q, q.yzx + 33.33);
    return fract((q.xx + q.yz) * q.zy);
}

// Returns the rotation of a tile.
float mx_hextile(vec2 coord, vec2 corner, float rotation, vec2 rotation_range, float scale, vec2 scale_range, float offset,
                 vec2 offset_range, out vec2 uv, out vec2 dx, out vec2 dy)
{
    vec2 random = mx_hextile_random(corner);
    vec2 center = vec2(corner.x + 0.5 * corner.y, corner.y / (2.0 * MX_LATTICE_SKEW)) / MX_LATTICE_DENSITY;
    float size = mix(1.0, mix(scale_range.x, scale_range.y, random.y), scale);
    float turn = radians(mix(rotation_range.x, rotation_range.y, random.x * rotation));
    uv = mx_rotate2d(coord - center, -turn) / size + center + mix(vec2(offset_range.x), vec2(offset_range.y), random * offset);
    dx = mx_rotate2d(dFdx(coord), -turn) / size;
    dy = mx_rotate2d(dFdy(coord), -turn) / size;
    return turn;
}

mx_HexTiles mx_hextiles(vec2 coord, float rotation, vec2 rotation_range, float scale, vec2 scale_range, float offset,
                        vec2 offset_range)
{
    vec2 c1, c2, c3;
    vec2 uv1, uv2, uv3, dx1, dx2, dx3, dy1, dy2, dy3;
    vec3 barycentric = mx_hextile_corners(coord, c1, c2, c3);
    float r1 = mx_hextile(coord, c1, rotation, rotation_range, scale, scale_range, offset, offset_range, uv1, dx1, dy1);
    float r2 = mx_hextile(coord, c2, rotation, rotation_range, scale, scale_range, offset, offset_range, uv2, dx2, dy2);
    float r3 = mx_hextile(coord, c3, rotation, rotation_range, scale, scale_range, offset, offset_range, uv3, dx3, dy3);
    mx_HexTiles tiles;
    tiles.uv1 = uv1;
    tiles.uv2 = uv2;
    tiles.uv3 = uv3;
    tiles.dx1 = dx1;
    tiles.dx2 = dx2;
    tiles.dx3 = dx3;
    tiles.dy1 = dy1;
    tiles.dy2 = dy2;
    tiles.dy3 = dy3;
    tiles.rotation = vec3(r1, r2, r3);
    tiles.barycentric = barycentric;
    return tiles;
}

// Christophe Schlick, "Fast Alternatives to Perlin's Bias and Gain Functions", Graphics Gems IV, 1994.
float mx_schlick_gain(float x, float gain)
{
    float a = (1.0 / clamp(gain, 0.001, 0.999) - 2.0) * (1.0 - 2.0 * x);
    return x < 0.5 ? x / (a + 1.0) : (a - x) / (a - 1.0);
}

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

// Bright parts of tiles prevail by `contrast`.
vec3 mx_hextile_blend(vec3 barycentric, vec3 c1, vec3 c2, vec3 c3, float falloff, float contrast, vec3 lumacoeffs)
{
    vec3 luma = vec3(dot(c1, lumacoeffs), dot(c2, lumacoeffs), dot(c3, lumacoeffs));
    vec3 w = mx_hextile_weights(barycentric, mix(vec3(1.0), luma, contrast), falloff);
    return w.x * c1 + w.y * c2 + w.z * c3;
}

vec3 mx_hextiledimage_color3(sampler2D file, mx_HexTiles tiles, float falloff, float contrast, vec3 lumacoeffs)
{
    vec3 c1 = textureGrad(file, tiles.uv1, tiles.dx1, tiles.dy1).rgb;
    vec3 c2 = textureGrad(file, tiles.uv2, tiles.dx2, tiles.dy2).rgb;
    vec3 c3 = textureGrad(file, tiles.uv3, tiles.dx3, tiles.dy3).rgb;
    return mx_hextile_blend(tiles.barycentric, c1, c2, c3, falloff, contrast, lumacoeffs);
}

vec4 mx_hextiledimage_color4(sampler2D file, mx_HexTiles tiles, float falloff, float contrast, vec3 lumacoeffs)
{
    vec4 c1 = textureGrad(file, tiles.uv1, tiles.dx1, tiles.dy1);
    vec4 c2 = textureGrad(file, tiles.uv2, tiles.dx2, tiles.dy2);
    vec4 c3 = textureGrad(file, tiles.uv3, tiles.dx3, tiles.dy3);
    vec3 w_alpha = mx_hextile_weights(tiles.barycentric, vec3(1.0), falloff);
    return vec4(mx_hextile_blend(tiles.barycentric, c1.rgb, c2.rgb, c3.rgb, falloff, contrast, lumacoeffs),
                dot(w_alpha, vec3(c1.a, c2.a, c3.a)));
}

// Surface gradients add up where normals do not: Morten S. Mikkelsen, "Surface Gradient-Based Bump Mapping Framework",
// Journal of Computer Graphics Techniques 9(3), 2020.
vec3 mx_surface_gradient(vec3 normal, vec3 bumped)
{
    float d = dot(normal, bumped);
    return (d * normal - bumped) / max(1e-8, abs(d));
}

// The surface gradient of the normal that a tile stores, whose tangents turn with the tile.
vec3 mx_hextile_gradient(vec3 texel, float rotation, float strength, bool flip_g, vec3 normal, vec3 tangent, vec3 bitangent)
{
    vec3 n = 2.0 * vec3(texel.x, flip_g ? 1.0 - texel.y : texel.y, texel.z) - 1.0;
    vec3 slope = mx_rotate3d(tangent, -rotation, normal) * n.x + mx_rotate3d(bitangent, -rotation, normal) * n.y;
    return mx_surface_gradient(normal, normalize(slope * strength + normal * n.z));
}

vec3 mx_hextilednormalmap(sampler2D file, mx_HexTiles tiles, float falloff, float strength, bool flip_g, vec3 normal, vec3 tangent,
                          vec3 bitangent)
{
    vec3 n1 = textureGrad(file, tiles.uv1, tiles.dx1, tiles.dy1).xyz;
    vec3 n2 = textureGrad(file, tiles.uv2, tiles.dx2, tiles.dy2).xyz;
    vec3 n3 = textureGrad(file, tiles.uv3, tiles.dx3, tiles.dy3).xyz;
    vec3 w = clamp(mx_hextile_weights(tiles.barycentric, vec3(1.0), falloff), 0.0, 1.0);
    vec3 gradient = w.x * mx_hextile_gradient(n1, tiles.rotation.x, strength, flip_g, normal, tangent, bitangent) +
                    w.y * mx_hextile_gradient(n2, tiles.rotation.y, strength, flip_g, normal, tangent, bitangent) +
                    w.z * mx_hextile_gradient(n3, tiles.rotation.z, strength, flip_g, normal, tangent, bitangent);
    return normalize(normal - gradient);
}
