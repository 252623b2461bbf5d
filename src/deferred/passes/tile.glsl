// The pixel of an invocation, in a pass that runs over the tiles of a class.
ivec2 mx_pixel_of(uint class_)
{
    uint tile = mx_tile[class_ * mx_num_tiles + gl_WorkGroupID.x];
    return MX_TILE * ivec2(tile % mx_tiles_per_row, tile / mx_tiles_per_row) + ivec2(gl_LocalInvocationID.xy);
}
