// One group per tile: adds it to the lists of all classes that it has.

shared uint mx_classes;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (gl_LocalInvocationIndex == 0u)
        mx_classes = 0u;
    barrier();
    if (!mx_is_outside(pixel))
        atomicOr(mx_classes, 1u << mx_class(imageLoad(mx_word0, pixel).x));
    barrier();
#if MX_SCATTERED == 1
    if (!mx_is_outside(pixel))
        imageStore(mx_scattered, ivec3(pixel, 0), vec4(0.0)); // no body yet
#endif
#if MX_BELOW == 1
    if (!mx_is_outside(pixel))
        imageStore(mx_below, ivec3(pixel, 0), vec4(0.0));
#endif
    uint class_ = gl_LocalInvocationIndex;
    if (class_ < MX_NUM_CLASSES && (mx_classes >> class_ & 1u) != 0u)
        mx_tile[class_ * mx_num_tiles + atomicAdd(mx_dispatch[class_].x, 1u)] = gl_WorkGroupID.y * mx_tiles_per_row + gl_WorkGroupID.x;
}
