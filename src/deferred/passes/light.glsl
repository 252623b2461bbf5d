// One group per tile of class MX_CLASS: lights its pixels by the function surface(), which stands above with mx_fill().

#if MX_SCATTERED == 1
// The part of out1 that is light from below the surface: what the same closure without a body does not send.
vec3 mx_split(MxClosure closure, vec3 point, vec3 top, float open)
{
    vec3 all = out1.xyz;
    closure.diffuse_albedo = vec3(0.0);
    mx_fill(closure, point, top, open);
    surface();
    return max(all - out1.xyz, 0.0);
}
#endif

// Lights a pixel of the class.
void mx_run(uvec2 group, uvec2 place)
{
    ivec2 pixel = mx_pixel_of(uint(MX_CLASS), group.x, place);
@    mxg_pixel = pixel;
    if (mx_is_outside(pixel))
        return;
    MxReader reader = mx_open(pixel);
    if (reader.class_ != MX_CLASS)
        return;
    vec4 point = mx_to_world * vec4(vec2(pixel) + 0.5, texelFetch(mx_depth, pixel, 0).x, 1.0);
    vec4 stored = texelFetch(mx_color, pixel, 0); // what the surface emits, and the part of the environment that arrives
    vec4 lit = vec4(stored.xyz, 1.0);
#if MX_SCATTERED == 1
    vec3 inside = vec3(0.0), albedo = vec3(0.0);
#endif
#if MX_BELOW == 1
    const float MX_LEAST_BLUR = 1.0 / 256.0; // half of the least that few bits store; the image has halves
    vec4 below = vec4(0.0); // light that is blurred, and how wide
#endif
    while (reader.next < reader.num_closures) {
        MxClosure closure = mx_next(reader);
        mx_fill(closure, point.xyz / point.w, reader.normals[0], stored.w);
        surface();
#if MX_SCATTERED == 1
        if (closure.is_thick > 0.0) {
            inside += mx_split(closure, point.xyz / point.w, reader.normals[0], stored.w);
            albedo = closure.diffuse_albedo;
        }
#endif
#if MX_BELOW == 1
        if (closure.blur > MX_LEAST_BLUR) {
            below = vec4(below.xyz + out1.xyz, max(below.w, closure.blur));
            continue;
        }
#endif
        lit.xyz += out1.xyz;
#if MX_CLASS < MX_COMPLEX
        break; // the only closure
#endif
    }
#if MX_BELOW == 1
    imageStore(mx_below, ivec3(pixel, 0), below);
#endif
#if MX_SCATTERED == 1
    if (max(albedo.x, max(albedo.y, albedo.z)) > 0.0) {
        imageStore(mx_scattered, ivec3(pixel, 0), vec4(inside / max(albedo, 1e-3), 1.0));
#if MX_BELOW == 1
        lit.w = below.w > 0.0 ? 0.0 : 1.0; // the pass "diffuse" does not read that image
#endif
        imageStore(mx_scattered, ivec3(pixel, 1), lit);
        return;
    }
#endif
#if MX_BELOW == 1
    if (below.w > 0.0) {
        imageStore(mx_below, ivec3(pixel, 1), lit);
        return;
    }
#endif
    imageStore(mx_lit, pixel, lit);
}
