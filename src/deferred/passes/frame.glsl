// The part that all passes share: a group covers a tile.

layout(local_size_x = MX_TILE, local_size_y = MX_TILE) in;

@// The pixel that is lit, for functions of the host.
@ivec2 mxg_pixel;
@
bool mx_is_outside(ivec2 pixel)
{
    return any(greaterThanEqual(pixel, ivec2(mx_size)));
}
