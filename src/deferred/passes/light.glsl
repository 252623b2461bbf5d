// One group per tile of class MX_CLASS: lights its pixels by the function surface(), which stands above with mx_fill().

layout(MX_DEPTH) uniform sampler2D mx_depth;
layout(MX_COLOR) uniform sampler2D mx_color;
layout(MX_LIT) uniform writeonly restrict image2D mx_lit;

void main()
{
    uint tile = mx_tile[MX_CLASS * mx_size.w + gl_WorkGroupID.x];
    ivec2 pixel = 8 * ivec2(tile % mx_size.z, tile / mx_size.z) + ivec2(gl_LocalInvocationID.xy);
    if (mx_is_outside(pixel))
        return;
    MxReader reader = mx_open(pixel);
    if (reader.class_ != MX_CLASS)
        return;
    vec4 point = mx_to_world * vec4(vec2(pixel) + 0.5, texelFetch(mx_depth, pixel, 0).x, 1.0);
    vec4 lit = texelFetch(mx_color, pixel, 0); // what the surface emits
    while (reader.next < reader.num_closures) {
        MxClosure closure = mx_next(reader);
        mx_fill(closure, point.xyz / point.w, reader.normals[0]);
        surface();
        lit.xyz += out1.xyz;
#if MX_CLASS < 3
        break;
#endif
    }
    imageStore(mx_lit, pixel, lit);
}
