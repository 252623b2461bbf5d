#version 450
// o · output · mxgen 0.1 · vulkan · complete · 0 closures · 0 textures

layout(set = 0, binding = 1, std140) uniform PublicUniforms {
    float n_amplitude;
    float n_pivot;
};
layout(location = 0) in VertexData {
    vec2 texcoord_0;
} vd;
layout(location = 0) out vec4 out1;

// The dot product of p with one of the eight vectors (+-1, +-2), (+-2, +-1).
float mx_gradient(const uint hash, const vec2 p)
{
    bool swap = (hash & 4u) != 0u;
    float u = swap ? p.y : p.x;
    float v = swap ? p.x : p.y;
    return ((hash & 1u) != 0u ? -u : u) + 2.0 * ((hash & 2u) != 0u ? -v : v);
}

// Final scramble of a hash (Bob Jenkins, "lookup3.c", 2006).
// Here z = 3735928580u.
uint mx_hash_final(const uint x, const uint y)
{
    uint a = x;
    uint b = y;
    uint c = 3735928580u;
    c ^= b;
    c -= b << 14 | b >> 18;
    a ^= c;
    a -= c << 11 | c >> 21;
    b ^= a;
    b -= a << 25 | a >> 7;
    c ^= b;
    c -= b << 16 | b >> 16;
    a ^= c;
    a -= c << 4 | c >> 28;
    b ^= a;
    b -= a << 14 | a >> 18;
    c ^= b;
    c -= b << 24 | b >> 8;
    return c;
}

// The curve 6t^5 - 15t^4 + 10t^3 between lattice points (Perlin 2002, "Improving Noise").
vec2 mx_fade(const vec2 t)
{
    return t * t * t * (t * (t * 6.0 - vec2(15.0)) + vec2(10.0));
}

// Perlin noise at the point p, from -1 to 1.
float mx_noise_float(const vec2 p)
{
    vec2 cell = floor(p);
    vec2 f = p - cell;
    vec2 w = mx_fade(f);
    int x = int(cell.x);
    int y = int(cell.y);
    return 0.6616 * mix(mix(mx_gradient(mx_hash_final(3735928580u + uint(x), 3735928580u + uint(y)), f),
        mx_gradient(mx_hash_final(3735928580u + uint(x + 1), 3735928580u + uint(y)), f - vec2(1.0, 0.0)), w.x),
        mix(mx_gradient(mx_hash_final(3735928580u + uint(x), 3735928580u + uint(y + 1)), f - vec2(0.0, 1.0)),
        mx_gradient(mx_hash_final(3735928580u + uint(x + 1), 3735928580u + uint(y + 1)), f - vec2(1.0)), w.x), w.y);
}

void main()
{
    float n = n_pivot + n_amplitude * mx_noise_float(vd.texcoord_0);
    out1 = vec4(n, n, n, 1.0);
}
