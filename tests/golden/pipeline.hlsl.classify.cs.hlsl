// classify · pass · mxgen 0.1 · hlsl · 0 closures · 0 textures
// shader model 6.0

RWTexture2D<uint> mx_word0 : register(u1, space1);
RWByteAddressBuffer mx_tiles : register(u7, space1);
cbuffer MxFrame : register(b8, space1)
{
    row_major float4x4 mx_to_world;
    uint2 mx_size;
    uint mx_tiles_per_row;
    uint mx_num_tiles;
    uint mx_show;
};

// The pixel of an invocation, in a pass over all tiles.
int2 mx_pixel_in(uint2 group, uint2 place)
{
    return 8 * int2(group) + int2(place);
}

// True beyond the edge of the picture, where tiles may reach.
bool mx_is_outside(int2 pixel)
{
    return any(pixel >= int2(mx_size));
}

groupshared uint mx_bits;

// The bits of all invocations of a group.
uint mx_or_in_group(uint bits, uint index)
{
    if (index == 0u)
        mx_bits = 0u;
    GroupMemoryBarrierWithGroupSync();
    InterlockedOr(mx_bits, bits);
    GroupMemoryBarrierWithGroupSync();
    return mx_bits;
}

// The class of a pixel by its first word.
uint mx_class(uint first)
{
    return ((first >> 20u) & 1024u) != 0u ? 4u : first >> 28u;
}

uint4 mx_word0_load(int2 at)
{
    return uint4(mx_word0[at], 0u, 0u, 1u);
}

uint mx_tiles_add(uint at, uint value)
{
    uint before;
    mx_tiles.InterlockedAdd(4 * at, value, before);
    return before;
}

void mx_tiles_store(uint at, uint value)
{
    mx_tiles.Store(4 * at, value);
}

// Adds a tile to the list of a class, whose number of tiles is the first word of its command.
void mx_add_tile(uint class_, uint tile)
{
    uint at = mx_tiles_add(4u * class_, 1u);
    mx_tiles_store(20u + class_ * mx_num_tiles + at, tile);
}

// Notes the class of a pixel; the first invocations of a tile add it to the lists.
void mx_run(uint2 group, uint2 place)
{
    int2 pixel = mx_pixel_in(group, place);
    bool is_outside = mx_is_outside(pixel);
    uint class_ = place.y * 8u + place.x;
    uint classes = mx_or_in_group(is_outside ? 0u : 1u << mx_class(mx_word0_load(pixel).x), class_);
    if (class_ < 5u && ((classes >> class_) & 1u) != 0u)
        mx_add_tile(class_, group.y * mx_tiles_per_row + group.x);
}

[numthreads(8, 8, 1)]
void main(uint3 group : SV_GroupID, uint3 place : SV_GroupThreadID)
{
    mx_run(group.xy, place.xy);
}
