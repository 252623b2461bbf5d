// SPDX-License-Identifier: Apache-2.0
// Flakes: each cell of a lattice may hold a randomly turned cube; of those that contain a point, the one of the highest
// priority shows there, with a normal drawn from a GGX distribution.

#include "noise.glsl"

const float MX_TAU = 6.2831853071795864;
const float MX_FLAKE_EXTENT = 0.8660254; // half the edge of the cube, in cells

// The probability of a cell to hold a flake that gives a coverage: a fit to measurements.
float mx_flake_probability(float coverage)
{
    float x = clamp(coverage, 0.0, 1.0);
    float numerator = (26.39663835 - 26.19771808 * x) * x;
    float denominator = ((85.53857017 * x - 102.35069432) * x - 101.42634862) * x + 118.45082288;
    return numerator / denominator;
}

// James Arvo, "Fast Random Rotation Matrices", Graphics Gems III, 1992: p turned by a matrix that is uniformly
// distributed when `random` is.
vec3 mx_flake_turn(vec3 p, vec3 random)
{
    float theta = MX_TAU * random.x;
    float phi = MX_TAU * random.y;
    float z = 2.0 * random.z;
    vec3 v = vec3(sin(phi) * sqrt(z), cos(phi) * sqrt(z), sqrt(2.0 - z));

    float s = sin(theta);
    float c = cos(theta);
    vec2 turned = vec2(v.x * c - v.y * s, v.x * s + v.y * c);
    mat3 m = mat3(v.x * turned.x - c, v.x * turned.y - s, v.x * v.z,
                  v.y * turned.x + s, v.y * turned.y - c, v.y * v.z,
                  v.z * turned.x,     v.z * turned.y,     1.0 - z);
    return m * p;
}

// Whether a cell holds a flake that contains the point at an offset from its middle.
bool mx_flake_covers(vec3 cell, vec3 offset, float probability)
{
    if (dot(offset, offset) >= 3.0 * MX_FLAKE_EXTENT * MX_FLAKE_EXTENT || mx_cellnoise_float(cell) > probability)
        return false;
    vec3 p = abs(mx_flake_turn(offset, mx_cellnoise_vec3(cell)));
    return max(p.x, max(p.y, p.z)) <= MX_FLAKE_EXTENT;
}

void mx_flake(float size, float roughness, float coverage, vec3 position, vec3 normal, vec3 tangent, vec3 bitangent,
              out int id, out float rand, out float presence, out vec3 flakenormal)
{
    vec3 p = position / size;
    vec3 base = floor(p);
    float probability = mx_flake_probability(coverage);
    vec3 flake = vec3(0.0);
    presence = 0.0;
    for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
            for (int z = -1; z <= 1; ++z) {
                vec3 cell = base + vec3(float(x), float(y), float(z));
                float priority = mx_cellnoise_float(vec4(cell, 3.0));
                if (priority > presence && mx_flake_covers(cell, p - cell - 0.5, probability)) {
                    presence = priority;
                    flake = cell;
                }
            }
        }
    }

    id = 0;
    rand = 0.0;
    flakenormal = normal;
    if (presence <= 0.0)
        return;

    vec3 random = mx_cellnoise_vec3(vec4(flake, 2.0));
    rand = random.z;
    id = int(rand * 16777215.0); // 2^24 - 1, exact in a float

    float phi = MX_TAU * random.x;
    float tan_theta = roughness * roughness * sqrt(random.y / (1.0 - random.y));
    flakenormal = normalize(normal + (tangent * cos(phi) + bitangent * sin(phi)) * tan_theta);
}

void mx_flake(float size, float roughness, float coverage, vec2 texcoord, vec3 normal, vec3 tangent, vec3 bitangent,
              out int id, out float rand, out float presence, out vec3 flakenormal)
{
    mx_flake(size, roughness, coverage, vec3(texcoord, 0.0), normal, tangent, bitangent, id, rand, presence, flakenormal);
}
