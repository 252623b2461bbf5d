// One group per tile: adds it to the lists of all classes that it has.

// Notes the class of a pixel; the first invocations of a tile add it to the lists.
void mx_run(uvec2 group, uvec2 place)
{
    ivec2 pixel = mx_pixel_in(group, place);
    bool is_outside = mx_is_outside(pixel);
    uint class_ = place.y * uint(MX_TILE) + place.x; // an invocation for each
    uint classes = mx_or_in_group(is_outside ? 0u : 1u << mx_class(imageLoad(mx_word0, pixel).x), class_);
#if MX_SCATTERED == 1
    if (!is_outside)
        imageStore(mx_scattered, ivec3(pixel, 0), vec4(0.0)); // no body yet
#endif
#if MX_BELOW == 1
    if (!is_outside)
        imageStore(mx_below, ivec3(pixel, 0), vec4(0.0));
#endif
    if (class_ < uint(MX_NUM_CLASSES) && ((classes >> class_) & 1u) != 0u)
        mx_add_tile(class_, group.y * mx_tiles_per_row + group.x);
}
