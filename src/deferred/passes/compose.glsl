// One group per tile that has pixels without closures: their colour is that of the colour target.

layout(MX_COLOR) uniform sampler2D mx_color;
layout(MX_LIT) uniform writeonly restrict image2D mx_lit;

void main()
{
    uint tile = mx_tile[gl_WorkGroupID.x];
    ivec2 pixel = 8 * ivec2(tile % mx_size.z, tile / mx_size.z) + ivec2(gl_LocalInvocationID.xy);
    if (!mx_is_outside(pixel) && (imageLoad(mx_word_0, pixel).x >> 28u) == MX_EMPTY)
        imageStore(mx_lit, pixel, texelFetch(mx_color, pixel, 0));
}
