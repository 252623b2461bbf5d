// distances · output · mxgen 0.1 · hlsl · reduced · 0 closures · 0 textures
// shader model 6.0

struct VertexData {
    float4 position : SV_Position;
    float2 texcoord_0 : TEXCOORD0;
};

// The three least distances, in order, after one more is seen.
float3 mx_insert_distance(float3 nearest, float d)
{
    if (d < nearest.x)
        return float3(d, nearest.xy);
    if (d < nearest.y)
        return float3(nearest.x, d, nearest.y);
    return float3(nearest.xy, min(nearest.z, d));
}

// Final scramble of a hash (Bob Jenkins, "lookup3.c", 2006).
uint mx_hash_final(uint x, uint y, uint z)
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

// Cell noise: three random numbers from 0 to 1 for each cell of the integer lattice.
float3 mx_cellnoise_vec3(float2 p)
{
    float2 cell = floor(p);
    int x = int(cell.x);
    int y = int(cell.y);
    return float3(float(mx_hash_final(3735928584u + uint(x), 3735928584u + uint(y), 3735928584u)) / 4.2949673e9,
        float(mx_hash_final(3735928584u + uint(x), 3735928584u + uint(y), 3735928585u)) / 4.2949673e9,
        float(mx_hash_final(3735928584u + uint(x), 3735928584u + uint(y), 3735928586u)) / 4.2949673e9);
}

// The nearest feature point around p, and the squared distances to the three nearest; `jitter` moves the points about
// the centres of the cells (Worley 1996, "A Cellular Texture Basis Function").
// Here jitter = 1.0.
float2 mx_worley(float2 p, out float3 distances)
{
    float2 cell = floor(p);
    float2 f = p - cell;
    float2 nearest = float2(0.0, 0.0);
    distances = float3(1000000.0, 1000000.0, 1000000.0);
    for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
            float2 neighbor = float2(float(x), float(y));
            float2 offset = neighbor + (mx_cellnoise_vec3(cell + neighbor).xy - 0.5) + 0.5 - f;
            float d = dot(offset, offset);
            if (d < distances.x)
                nearest = offset;
            distances = mx_insert_distance(distances, d);
        }
    }
    return p + nearest;
}

void main(
    VertexData vd,
    out float4 out1 : SV_Target0)
{
    // NG
    float3 cells_distances;
    float2 cells = mx_worley(vd.texcoord_0, cells_distances);
    out1 = float4(sqrt(cells_distances).xy, 0.0, 1.0);
}
