#version 450
// out · output · mxgen 0.1 · glsl · complete · 0 closures · 0 textures

uniform float NG_limit = 0.5;
uniform int NG_mode = 1;
in VertexData {
    vec3 positionObject;
    vec2 texcoord_0;
} vd;
out vec4 out1;

// The dot product of p with a vector to the middle of an edge of a cube.
float mx_gradient(const uint hash, const vec3 p)
{
    uint h = hash & 15u;
    float u = h < 8u ? p.x : p.y;
    float v = h < 4u ? p.y : h == 12u || h == 14u ? p.x : p.z;
    return ((h & 1u) != 0u ? -u : u) + ((h & 2u) != 0u ? -v : v);
}

// A gradient for each component: each byte of the hash serves one.
vec3 mx_gradient_vec3(const uint hash, const vec3 p)
{
    return vec3(mx_gradient(hash, p), mx_gradient(hash >> 8, p), mx_gradient(hash >> 16, p));
}

// Final scramble of a hash (Bob Jenkins, "lookup3.c", 2006).
uint mx_hash_final(const uint x, const uint y, const uint z)
{
    uint a = x;
    uint b = y;
    uint c = z;
    c ^= b;
    c -= (b << 14) | (b >> 18);
    a ^= c;
    a -= (c << 11) | (c >> 21);
    b ^= a;
    b -= (a << 25) | (a >> 7);
    c ^= b;
    c -= (b << 16) | (b >> 16);
    a ^= c;
    a -= (c << 4) | (c >> 28);
    b ^= a;
    b -= (a << 14) | (a >> 18);
    c ^= b;
    c -= (b << 24) | (b >> 8);
    return c;
}

// Perlin noise, in three components, on one face of the lattice cube around a point, at the height z.
vec3 mx_noise_face_vec3(const int x, const int y, const int z, const vec3 f, const vec3 w)
{
    return mix(mix(mx_gradient_vec3(mx_hash_final(3735928584u + uint(x), 3735928584u + uint(y), 3735928584u + uint(z)),
        f), mx_gradient_vec3(mx_hash_final(3735928584u + uint(x + 1), 3735928584u + uint(y), 3735928584u + uint(z)),
        f - vec3(1.0, 0.0, 0.0)), w.x), mix(mx_gradient_vec3(mx_hash_final(3735928584u + uint(x),
        3735928584u + uint(y + 1), 3735928584u + uint(z)), f - vec3(0.0, 1.0, 0.0)),
        mx_gradient_vec3(mx_hash_final(3735928584u + uint(x + 1), 3735928584u + uint(y + 1), 3735928584u + uint(z)),
        f - vec3(1.0, 1.0, 0.0)), w.x), w.y);
}

// The curve 6t^5 - 15t^4 + 10t^3 between lattice points (Perlin 2002, "Improving Noise").
vec3 mx_fade(const vec3 t)
{
    return t * t * t * (t * (t * 6.0 - vec3(15.0)) + vec3(10.0));
}

// Perlin noise at the point p, in three components.
vec3 mx_noise_vec3(const vec3 p)
{
    vec3 cell = floor(p);
    vec3 f = p - cell;
    vec3 w = mx_fade(f);
    int x = int(cell.x);
    int y = int(cell.y);
    int z = int(cell.z);
    return 0.982 * mix(mx_noise_face_vec3(x, y, z, f, w), mx_noise_face_vec3(x, y, z + 1, f - vec3(0.0, 0.0, 1.0), w),
        w.z);
}

void main()
{
    // NG
    vec2 cell = floor(vd.texcoord_0 * 8.0);
    vec3 board = vec3(mod(cell.x + cell.y, 2.0));
    vec3 chosen_choice = 2 > NG_mode ? vd.texcoord_0.x > NG_limit ? board : vec3(1.0, 0.0, 0.0) : vec3(0.0);
    out1 = vec4(1 > NG_mode ? mx_noise_vec3(vd.positionObject) : chosen_choice, 1.0);
}
