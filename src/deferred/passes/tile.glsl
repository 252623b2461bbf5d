// The pixel of an invocation, in a pass that runs over the tiles of a class.
ivec2 mx_pixel_of(uint class_, uint group, uvec2 place)
{
    uint tile = mx_tile_at(class_ * mx_num_tiles + group);
    return MX_TILE * ivec2(tile % mx_tiles_per_row, tile / mx_tiles_per_row) + ivec2(place);
}
