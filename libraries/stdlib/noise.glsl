// SPDX-License-Identifier: Apache-2.0
// Lattice noises on integer hashing: Perlin, fractal, cell and Worley noise.
//
// Hashes, gradients and scales are those of Open Shading Language's noise, so that patterns agree among renderers.

#include "adjustment.glsl"
#include "rotate.glsl"

// Hashing: Bob Jenkins, "lookup3.c", 2006. A key of n words starts from three equal words, takes three words at a
// time with a mix between, and ends with the final scramble.

// The bits of x, rotated to the left.
uint mx_rotate_left(uint x, int bits)
{
    return (x << bits) | (x >> (32 - bits));
}

// Mixes three words of a hash (Bob Jenkins, "lookup3.c", 2006).
void mx_hash_mix(inout uint a, inout uint b, inout uint c)
{
    a -= c; a ^= mx_rotate_left(c,  4); c += b;
    b -= a; b ^= mx_rotate_left(a,  6); a += c;
    c -= b; c ^= mx_rotate_left(b,  8); b += a;
    a -= c; a ^= mx_rotate_left(c, 16); c += b;
    b -= a; b ^= mx_rotate_left(a, 19); a += c;
    c -= b; c ^= mx_rotate_left(b,  4); b += a;
}

// Final scramble of a hash (Bob Jenkins, "lookup3.c", 2006).
uint mx_hash_final(uint x, uint y, uint z)
{
    uint a = x;
    uint b = y;
    uint c = z;
    c ^= b; c -= mx_rotate_left(b, 14);
    a ^= c; a -= mx_rotate_left(c, 11);
    b ^= a; b -= mx_rotate_left(a, 25);
    c ^= b; c -= mx_rotate_left(b, 16);
    a ^= c; a -= mx_rotate_left(c,  4);
    b ^= a; b -= mx_rotate_left(a, 14);
    c ^= b; c -= mx_rotate_left(b, 24);
    return c;
}

// The number that a hash of so many words starts from (Bob Jenkins, "lookup3.c", 2006).
uint mx_hash_start(uint words)
{
    return 0xdeadbeefu + (words << 2) + 13u;
}

// A hash of two integers.
uint mx_hash(int x, int y)
{
    uint start = mx_hash_start(2u);
    return mx_hash_final(start + uint(x), start + uint(y), start);
}

// A hash of three integers.
uint mx_hash(int x, int y, int z)
{
    uint start = mx_hash_start(3u);
    return mx_hash_final(start + uint(x), start + uint(y), start + uint(z));
}

// A hash of four integers.
uint mx_hash(int x, int y, int z, int w)
{
    uint start = mx_hash_start(4u);
    uint a = start + uint(x);
    uint b = start + uint(y);
    uint c = start + uint(z);
    mx_hash_mix(a, b, c);
    return mx_hash_final(a + uint(w), b, c);
}

// A hash of five integers.
uint mx_hash(int x, int y, int z, int w, int v)
{
    uint start = mx_hash_start(5u);
    uint a = start + uint(x);
    uint b = start + uint(y);
    uint c = start + uint(z);
    mx_hash_mix(a, b, c);
    return mx_hash_final(a + uint(w), b + uint(v), c);
}

// Perlin noise: Ken Perlin, "Improving Noise", SIGGRAPH 2002.

const float MX_PERLIN_SCALE_2D = 0.6616; // what brings the sums of gradients below to the range -1 to 1
const float MX_PERLIN_SCALE_3D = 0.9820;

// The curve 6t^5 - 15t^4 + 10t^3 between lattice points (Perlin 2002, "Improving Noise").
vec2 mx_fade(vec2 t)
{
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

// The curve 6t^5 - 15t^4 + 10t^3 between lattice points (Perlin 2002, "Improving Noise").
vec3 mx_fade(vec3 t)
{
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

// x, negative where `negative` is not 0.
float mx_signed(float x, uint negative)
{
    return negative != 0u ? -x : x;
}

// The dot product of p with one of the eight vectors (+-1, +-2), (+-2, +-1).
float mx_gradient(uint hash, vec2 p)
{
    bool swap = (hash & 4u) != 0u;
    float u = swap ? p.y : p.x;
    float v = swap ? p.x : p.y;
    return mx_signed(u, hash & 1u) + 2.0 * mx_signed(v, hash & 2u);
}

// The dot product of p with a vector to the middle of an edge of a cube.
float mx_gradient(uint hash, vec3 p)
{
    uint h = hash & 15u;
    float u = h < 8u ? p.x : p.y;
    float v = h < 4u ? p.y : h == 12u || h == 14u ? p.x : p.z;
    return mx_signed(u, h & 1u) + mx_signed(v, h & 2u);
}

// A gradient for each component: each byte of the hash serves one.
vec3 mx_gradient_vec3(uint hash, vec2 p)
{
    return vec3(mx_gradient(hash, p), mx_gradient(hash >> 8, p), mx_gradient(hash >> 16, p));
}

// A gradient for each component: each byte of the hash serves one.
vec3 mx_gradient_vec3(uint hash, vec3 p)
{
    return vec3(mx_gradient(hash, p), mx_gradient(hash >> 8, p), mx_gradient(hash >> 16, p));
}

// Perlin noise at the point p, from -1 to 1.
float mx_noise_float(vec2 p)
{
    vec2 cell = floor(p);
    vec2 f = p - cell;
    vec2 w = mx_fade(f);
    int x = int(cell.x);
    int y = int(cell.y);
    float v00 = mx_gradient(mx_hash(x, y), f);
    float v10 = mx_gradient(mx_hash(x + 1, y), f - vec2(1.0, 0.0));
    float v01 = mx_gradient(mx_hash(x, y + 1), f - vec2(0.0, 1.0));
    float v11 = mx_gradient(mx_hash(x + 1, y + 1), f - 1.0);
    return MX_PERLIN_SCALE_2D * mix(mix(v00, v10, w.x), mix(v01, v11, w.x), w.y);
}

// Perlin noise at the point p, in three components.
vec3 mx_noise_vec3(vec2 p)
{
    vec2 cell = floor(p);
    vec2 f = p - cell;
    vec2 w = mx_fade(f);
    int x = int(cell.x);
    int y = int(cell.y);
    vec3 v00 = mx_gradient_vec3(mx_hash(x, y), f);
    vec3 v10 = mx_gradient_vec3(mx_hash(x + 1, y), f - vec2(1.0, 0.0));
    vec3 v01 = mx_gradient_vec3(mx_hash(x, y + 1), f - vec2(0.0, 1.0));
    vec3 v11 = mx_gradient_vec3(mx_hash(x + 1, y + 1), f - 1.0);
    return MX_PERLIN_SCALE_2D * mix(mix(v00, v10, w.x), mix(v01, v11, w.x), w.y);
}

// Perlin noise on one face of the lattice cube around a point, at the height z; f is the point in the cube, w its
// weights.
float mx_noise_face(int x, int y, int z, vec3 f, vec3 w)
{
    float v00 = mx_gradient(mx_hash(x, y, z), f);
    float v10 = mx_gradient(mx_hash(x + 1, y, z), f - vec3(1.0, 0.0, 0.0));
    float v01 = mx_gradient(mx_hash(x, y + 1, z), f - vec3(0.0, 1.0, 0.0));
    float v11 = mx_gradient(mx_hash(x + 1, y + 1, z), f - vec3(1.0, 1.0, 0.0));
    return mix(mix(v00, v10, w.x), mix(v01, v11, w.x), w.y);
}

// Perlin noise at the point p, from -1 to 1.
float mx_noise_float(vec3 p)
{
    vec3 cell = floor(p);
    vec3 f = p - cell;
    vec3 w = mx_fade(f);
    int x = int(cell.x);
    int y = int(cell.y);
    int z = int(cell.z);
    return MX_PERLIN_SCALE_3D * mix(mx_noise_face(x, y, z, f, w),
                                 mx_noise_face(x, y, z + 1, f - vec3(0.0, 0.0, 1.0), w), w.z);
}

// Perlin noise, in three components, on one face of the lattice cube around a point, at the height z.
vec3 mx_noise_face_vec3(int x, int y, int z, vec3 f, vec3 w)
{
    vec3 v00 = mx_gradient_vec3(mx_hash(x, y, z), f);
    vec3 v10 = mx_gradient_vec3(mx_hash(x + 1, y, z), f - vec3(1.0, 0.0, 0.0));
    vec3 v01 = mx_gradient_vec3(mx_hash(x, y + 1, z), f - vec3(0.0, 1.0, 0.0));
    vec3 v11 = mx_gradient_vec3(mx_hash(x + 1, y + 1, z), f - vec3(1.0, 1.0, 0.0));
    return mix(mix(v00, v10, w.x), mix(v01, v11, w.x), w.y);
}

// Perlin noise at the point p, in three components.
vec3 mx_noise_vec3(vec3 p)
{
    vec3 cell = floor(p);
    vec3 f = p - cell;
    vec3 w = mx_fade(f);
    int x = int(cell.x);
    int y = int(cell.y);
    int z = int(cell.z);
    return MX_PERLIN_SCALE_3D * mix(mx_noise_face_vec3(x, y, z, f, w),
                                 mx_noise_face_vec3(x, y, z + 1, f - vec3(0.0, 0.0, 1.0), w), w.z);
}

vec2 mx_noise_vec2(vec2 p) { return mx_noise_vec3(p).xy; }
vec2 mx_noise_vec2(vec3 p) { return mx_noise_vec3(p).xy; }
vec4 mx_noise_vec4(vec2 p) { return vec4(mx_noise_vec3(p), mx_noise_float(p + vec2(19.0, 73.0))); }
vec4 mx_noise_vec4(vec3 p) { return vec4(mx_noise_vec3(p), mx_noise_float(p + vec3(19.0, 73.0, 29.0))); }

// Fractal noise: octaves of Perlin noise, each finer by lacunarity and weaker by diminish.

// Fractal noise in one component: octaves of Perlin noise, each finer by `lacunarity` and weaker by `diminish` than
// the one before.
float mx_fractal_float(vec2 p, int octaves, float lacunarity, float diminish)
{
    float sum = 0.0;
    float amplitude = 1.0;
    vec2 q = p;
    for (int i = 0; i < octaves; ++i) {
        sum += amplitude * mx_noise_float(q);
        amplitude *= diminish;
        q *= lacunarity;
    }
    return sum;
}

// Fractal noise in one component: octaves of Perlin noise, each finer by `lacunarity` and weaker by `diminish` than
// the one before.
float mx_fractal_float(vec3 p, int octaves, float lacunarity, float diminish)
{
    float sum = 0.0;
    float amplitude = 1.0;
    vec3 q = p;
    for (int i = 0; i < octaves; ++i) {
        sum += amplitude * mx_noise_float(q);
        amplitude *= diminish;
        q *= lacunarity;
    }
    return sum;
}

// Fractal noise in three components: octaves of Perlin noise, each finer by `lacunarity` and weaker by `diminish`
// than the one before.
vec3 mx_fractal_vec3(vec2 p, int octaves, float lacunarity, float diminish)
{
    vec3 sum = vec3(0.0);
    float amplitude = 1.0;
    vec2 q = p;
    for (int i = 0; i < octaves; ++i) {
        sum += amplitude * mx_noise_vec3(q);
        amplitude *= diminish;
        q *= lacunarity;
    }
    return sum;
}

// Fractal noise in three components: octaves of Perlin noise, each finer by `lacunarity` and weaker by `diminish`
// than the one before.
vec3 mx_fractal_vec3(vec3 p, int octaves, float lacunarity, float diminish)
{
    vec3 sum = vec3(0.0);
    float amplitude = 1.0;
    vec3 q = p;
    for (int i = 0; i < octaves; ++i) {
        sum += amplitude * mx_noise_vec3(q);
        amplitude *= diminish;
        q *= lacunarity;
    }
    return sum;
}

const vec3 MX_FRACTAL_SHIFT = vec3(19.0, 193.0, 17.0); // apart enough for the last component to look independent

vec2 mx_fractal_vec2(vec2 p, int octaves, float lacunarity, float diminish)
{
    return vec2(mx_fractal_float(p, octaves, lacunarity, diminish),
                mx_fractal_float(p + MX_FRACTAL_SHIFT.xy, octaves, lacunarity, diminish));
}

vec2 mx_fractal_vec2(vec3 p, int octaves, float lacunarity, float diminish)
{
    return vec2(mx_fractal_float(p, octaves, lacunarity, diminish),
                mx_fractal_float(p + MX_FRACTAL_SHIFT, octaves, lacunarity, diminish));
}

vec4 mx_fractal_vec4(vec2 p, int octaves, float lacunarity, float diminish)
{
    return vec4(mx_fractal_vec3(p, octaves, lacunarity, diminish),
                mx_fractal_float(p + MX_FRACTAL_SHIFT.xy, octaves, lacunarity, diminish));
}

vec4 mx_fractal_vec4(vec3 p, int octaves, float lacunarity, float diminish)
{
    return vec4(mx_fractal_vec3(p, octaves, lacunarity, diminish),
                mx_fractal_float(p + MX_FRACTAL_SHIFT, octaves, lacunarity, diminish));
}

// Cell noise: a random number, from 0 to 1, for each cell of the integer lattice.

// A number from 0 to 1 from the bits of a hash.
float mx_unit(uint hash)
{
    return float(hash) / 4294967295.0;
}

// Cell noise: a random number from 0 to 1 for each cell of the integer lattice.
float mx_cellnoise_float(vec2 p)
{
    vec2 cell = floor(p);
    return mx_unit(mx_hash(int(cell.x), int(cell.y)));
}

// Cell noise: a random number from 0 to 1 for each cell of the integer lattice.
float mx_cellnoise_float(vec3 p)
{
    vec3 cell = floor(p);
    return mx_unit(mx_hash(int(cell.x), int(cell.y), int(cell.z)));
}

// Cell noise: a random number from 0 to 1 for each cell of the integer lattice.
float mx_cellnoise_float(vec4 p)
{
    vec4 cell = floor(p);
    return mx_unit(mx_hash(int(cell.x), int(cell.y), int(cell.z), int(cell.w)));
}

// Cell noise: three random numbers from 0 to 1 for each cell of the integer lattice.
vec3 mx_cellnoise_vec3(vec2 p)
{
    vec2 cell = floor(p);
    int x = int(cell.x);
    int y = int(cell.y);
    return vec3(mx_unit(mx_hash(x, y, 0)), mx_unit(mx_hash(x, y, 1)), mx_unit(mx_hash(x, y, 2)));
}

// Cell noise: three random numbers from 0 to 1 for each cell of the integer lattice.
vec3 mx_cellnoise_vec3(vec3 p)
{
    vec3 cell = floor(p);
    int x = int(cell.x);
    int y = int(cell.y);
    int z = int(cell.z);
    return vec3(mx_unit(mx_hash(x, y, z, 0)), mx_unit(mx_hash(x, y, z, 1)), mx_unit(mx_hash(x, y, z, 2)));
}

// Cell noise: three random numbers from 0 to 1 for each cell of the integer lattice.
vec3 mx_cellnoise_vec3(vec4 p)
{
    vec4 cell = floor(p);
    int x = int(cell.x);
    int y = int(cell.y);
    int z = int(cell.z);
    int w = int(cell.w);
    return vec3(mx_unit(mx_hash(x, y, z, w, 0)), mx_unit(mx_hash(x, y, z, w, 1)), mx_unit(mx_hash(x, y, z, w, 2)));
}

// Worley noise: Steven Worley, "A Cellular Texture Basis Function", SIGGRAPH 1996. Each cell has one feature point,
// jittered about the centre. Style 0 gives the distances to the nearest points, style 1 the cell noise at the nearest.

// The three least distances, in order, after one more is seen.
vec3 mx_insert_distance(vec3 nearest, float d)
{
    if (d < nearest.x)
        return vec3(d, nearest.xy);
    if (d < nearest.y)
        return vec3(nearest.x, d, nearest.y);
    return vec3(nearest.xy, min(nearest.z, d));
}

// The nearest feature point around p, and the squared distances to the three nearest; `jitter` moves the points
// about the centres of the cells (Worley 1996, "A Cellular Texture Basis Function").
vec2 mx_worley(vec2 p, float jitter, out vec3 distances)
{
    vec2 cell = floor(p);
    vec2 f = p - cell;
    vec2 nearest = vec2(0.0);
    distances = vec3(1e6);
    for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
            vec2 neighbor = vec2(float(x), float(y));
            vec2 offset = neighbor + (mx_cellnoise_vec3(cell + neighbor).xy - 0.5) * jitter + 0.5 - f;
            float d = dot(offset, offset);
            if (d < distances.x)
                nearest = offset;
            distances = mx_insert_distance(distances, d);
        }
    }
    return p + nearest;
}

// The nearest feature point around p, and the squared distances to the three nearest; `jitter` moves the points
// about the centres of the cells (Worley 1996, "A Cellular Texture Basis Function").
vec3 mx_worley(vec3 p, float jitter, out vec3 distances)
{
    vec3 cell = floor(p);
    vec3 f = p - cell;
    vec3 nearest = vec3(0.0);
    distances = vec3(1e6);
    for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
            for (int z = -1; z <= 1; ++z) {
                vec3 neighbor = vec3(float(x), float(y), float(z));
                vec3 offset = neighbor + (mx_cellnoise_vec3(cell + neighbor) - 0.5) * jitter + 0.5 - f;
                float d = dot(offset, offset);
                if (d < distances.x)
                    nearest = offset;
                distances = mx_insert_distance(distances, d);
            }
        }
    }
    return p + nearest;
}

// Worley noise: the distance to the nearest feature point, or with style 1 the cell noise at it.
float mx_worley_float(vec2 p, float jitter, int style)
{
    vec3 distances;
    vec2 nearest = mx_worley(p, jitter, distances);
    return style == 1 ? mx_cellnoise_float(nearest) : sqrt(distances.x);
}

// Worley noise: the distance to the nearest feature point, or with style 1 the cell noise at it.
float mx_worley_float(vec3 p, float jitter, int style)
{
    vec3 distances;
    vec3 nearest = mx_worley(p, jitter, distances);
    return style == 1 ? mx_cellnoise_float(nearest) : sqrt(distances.x);
}

// Worley noise: the distances to the three nearest feature points, or with style 1 the cell noise at the nearest.
vec3 mx_worley_vec3(vec2 p, float jitter, int style)
{
    vec3 distances;
    vec2 nearest = mx_worley(p, jitter, distances);
    return style == 1 ? mx_cellnoise_vec3(nearest) : sqrt(distances);
}

// Worley noise: the distances to the three nearest feature points, or with style 1 the cell noise at the nearest.
vec3 mx_worley_vec3(vec3 p, float jitter, int style)
{
    vec3 distances;
    vec3 nearest = mx_worley(p, jitter, distances);
    return style == 1 ? mx_cellnoise_vec3(nearest) : sqrt(distances);
}

vec2 mx_worley_vec2(vec2 p, float jitter, int style) { return mx_worley_vec3(p, jitter, style).xy; }
vec2 mx_worley_vec2(vec3 p, float jitter, int style) { return mx_worley_vec3(p, jitter, style).xy; }

// Random values of a signal: the cell noise of (signal, seed).

// A random number between low and high for a signal: the cell noise of (signal, seed).
float mx_randomfloat(float signal, float low, float high, float seed)
{
    return clamp(low + mx_cellnoise_float(vec2(signal, seed)) * (high - low), min(low, high), max(low, high));
}

// A random colour between low and high for a signal, by hue, saturation and value.
vec3 mx_randomhsv(float signal, vec3 low, vec3 high, int seed)
{
    vec3 seeds = ceil(float(seed) + vec3(413.3, 1522.4, 1813.8));
    return low + (high - low) * vec3(mx_cellnoise_float(vec2(signal, seeds.x)),
                                     mx_cellnoise_float(vec2(signal, seeds.y)),
                                     mx_cellnoise_float(vec2(signal, seeds.z)));
}

// Unified noise: 0 Perlin, 1 cell, 2 Worley, 3 fractal. Jitter moves the points of Worley noise; a value other than 1
// turns the domain of the others by so large an angle that it looks random.

const float MX_JITTER_TURN = 90000.0; // degrees

// A noise from 0 to 1, moved to the range from low to high.
float mx_fit(float value, float low, float high, bool limit)
{
    float fitted = low + value * (high - low);
    return limit ? clamp(fitted, min(low, high), max(low, high)) : fitted;
}

float mx_unifiednoise2d(vec2 texcoord, vec2 freq, vec2 offset, float jitter, float outmin, float outmax, bool clampoutput,
                        int octaves, float lacunarity, float diminish, int type, int style)
{
    vec2 p = texcoord * freq + offset;
    float turn = (jitter - 1.0) * MX_JITTER_TURN;
    float value = 0.0;
    if (type <= 0)
        value = 0.5 + 0.5 * mx_noise_float(mx_rotate2d(p, radians(turn)));
    else if (type == 1)
        value = mx_cellnoise_float(mx_rotate2d(p, radians(turn)));
    else if (type == 2)
        value = mx_worley_float(p, jitter, style);
    else if (type == 3)
        value = mx_fractal_float(vec3(p, turn), octaves, lacunarity, diminish);
    return mx_fit(value, outmin, outmax, clampoutput);
}

float mx_unifiednoise3d(vec3 position, vec3 freq, vec3 offset, float jitter, float outmin, float outmax, bool clampoutput,
                        int octaves, float lacunarity, float diminish, int type, int style)
{
    vec3 p = position * freq + offset;
    vec3 turned = mx_rotate3d(p, radians((jitter - 1.0) * MX_JITTER_TURN), normalize(vec3(0.1, 1.0, 0.0)));
    float value = 0.0;
    if (type <= 0)
        value = 0.5 + 0.5 * mx_noise_float(turned);
    else if (type == 1)
        value = mx_cellnoise_float(turned);
    else if (type == 2)
        value = mx_worley_float(p, jitter, style);
    else if (type == 3)
        value = mx_fractal_float(turned, octaves, lacunarity, diminish);
    return mx_fit(value, outmin, outmax, clampoutput);
}
