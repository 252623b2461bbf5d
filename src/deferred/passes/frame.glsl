// The part that all passes share: a group covers a tile.

@// The pixel that is lit, for functions of the host.
@ivec2 mxg_pixel;
@
// True beyond the edge of the picture, where tiles may reach.
bool mx_is_outside(ivec2 pixel)
{
    return any(greaterThanEqual(pixel, ivec2(mx_size)));
}

// The pixel of an invocation, in a pass over all tiles.
ivec2 mx_pixel_in(uvec2 group, uvec2 place)
{
    return MX_TILE * ivec2(group) + ivec2(place);
}
