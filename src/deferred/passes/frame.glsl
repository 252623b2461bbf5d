// The part that all passes share: a group covers a tile.

layout(local_size_x = MX_TILE, local_size_y = MX_TILE) in;

bool mx_is_outside(ivec2 pixel)
{
    return any(greaterThanEqual(pixel, ivec2(mx_size)));
}
