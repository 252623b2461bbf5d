// classify · pass · mxgen 0.1 · msl · 0 closures · 0 textures
// Metal Shading Language 2.3
#include <metal_stdlib>
using namespace metal;

struct MxFrame {
    float4x4 mx_to_world;
    uint2 mx_size;
    uint mx_tiles_per_row;
    uint mx_num_tiles;
    uint mx_show;
};

struct GlobalContext {
    texture2d<uint, access::read> mx_word0;
    device atomic_uint* mx_tiles;
    constant MxFrame& mx_uniforms;

// The pixel of an invocation, in a pass over all tiles.
int2 mx_pixel_in(uint2 group, uint2 place)
{
    return 8 * int2(group) + int2(place);
}

// True beyond the edge of the picture, where tiles may reach.
bool mx_is_outside(int2 pixel)
{
    return any(pixel >= int2(mx_uniforms.mx_size));
}

threadgroup atomic_uint* mx_bits;

// The bits of all invocations of a group.
uint mx_or_in_group(uint bits, uint index)
{
    if (index == 0u)
        atomic_store_explicit(mx_bits, 0u, memory_order_relaxed);
    threadgroup_barrier(mem_flags::mem_threadgroup);
    atomic_fetch_or_explicit(mx_bits, bits, memory_order_relaxed);
    threadgroup_barrier(mem_flags::mem_threadgroup);
    return atomic_load_explicit(mx_bits, memory_order_relaxed);
}

// The class of a pixel by its first word.
uint mx_class(uint first)
{
    return ((first >> 20u) & 1024u) != 0u ? 4u : first >> 28u;
}

uint4 mx_word0_load(int2 at)
{
    return mx_word0.read(uint2(at));
}

uint mx_tiles_add(uint at, uint value)
{
    return atomic_fetch_add_explicit(mx_tiles + at, value, memory_order_relaxed);
}

void mx_tiles_store(uint at, uint value)
{
    atomic_store_explicit(mx_tiles + at, value, memory_order_relaxed);
}

// Adds a tile to the list of a class, whose number of tiles is the first word of its command.
void mx_add_tile(uint class_, uint tile_)
{
    uint at = mx_tiles_add(4u * class_, 1u);
    mx_tiles_store(20u + class_ * mx_uniforms.mx_num_tiles + at, tile_);
}

// Notes the class of a pixel; the first invocations of a tile add it to the lists.
void mx_run(uint2 group, uint2 place)
{
    int2 pixel = mx_pixel_in(group, place);
    bool is_outside = mx_is_outside(pixel);
    uint class_ = place.y * 8u + place.x;
    uint classes = mx_or_in_group(is_outside ? 0u : 1u << mx_class(mx_word0_load(pixel).x), class_);
    if (class_ < 5u && ((classes >> class_) & 1u) != 0u)
        mx_add_tile(class_, group.y * mx_uniforms.mx_tiles_per_row + group.x);
}

};

kernel void ComputeMain(
    uint3 group [[threadgroup_position_in_grid]],
    uint3 place [[thread_position_in_threadgroup]],
    texture2d<uint, access::read> mx_word0 [[texture(17)]],
    device atomic_uint* mx_tiles [[buffer(23)]],
    constant MxFrame& mx_uniforms [[buffer(24)]])
{
    GlobalContext context = {mx_word0, mx_tiles, mx_uniforms};
    threadgroup atomic_uint bits;
    context.mx_bits = &bits;
    context.mx_run(group.xy, place.xy);
}
