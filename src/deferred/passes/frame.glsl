// What all passes over the stored closures share.

layout(MX_FRAME, std140) uniform MxFrame
{
    mat4 mx_to_world;   // from (x, y, depth, 1), in pixels and as stored, to the world, times w
    uvec4 mx_size;      // width, height, tiles in a row, tiles
    uvec4 mx_show;      // what the debug view shows
};

// Tiles of 8 by 8 pixels by class: for each, a command of an indirect dispatch; then for each the numbers of its tiles.
layout(MX_TILES, std430) MX_TILES_ACCESS buffer MxTiles
{
    uvec4 mx_dispatch[5];
    uint mx_tile[];
};
layout(local_size_x = 8, local_size_y = 8) in;

bool mx_is_outside(ivec2 pixel)
{
    return any(greaterThanEqual(pixel, ivec2(mx_size.xy)));
}
