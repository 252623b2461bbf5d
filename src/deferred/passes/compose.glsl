// One group per tile that has pixels without closures: their colour is that of the colour target.

// Copies the colour of a pixel without closures.
void mx_run(uvec2 group, uvec2 place)
{
    ivec2 pixel = mx_pixel_of(uint(MX_EMPTY), group.x, place);
    if (!mx_is_outside(pixel) && mx_class(imageLoad(mx_word0, pixel).x) == MX_EMPTY)
        imageStore(mx_lit, pixel, texelFetch(mx_color, pixel, 0));
}
