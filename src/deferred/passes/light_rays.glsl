// Lights the payload of a ray per pixel by the function surface(), which stands above with mx_fill().

// Light that leaves the hit along the ray, and its opacity. Ray generation shaders may call it.
vec4 mx_light_payload(MxPayload payload, MxRay ray)
{
    vec4 lit = mx_emission_of(payload);
    if (mx_class(payload.words[0]) == MX_EMPTY)
        return lit;
    MxClosure closure = mx_open_payload(payload);
    mx_view = ray.view.xyz;
    mx_fill(closure, ray.point.xyz, closure.normal, 1.0);
    surface();
    return vec4(lit.xyz + out1.xyz, lit.w);
}

// Lights the payload of a pixel.
void mx_run(uvec2 group, uvec2 place)
{
    ivec2 pixel = mx_pixel_in(group, place);
@    mxg_pixel = pixel;
    if (mx_is_outside(pixel))
        return;
    uint at = uint(pixel.y) * mx_size.x + uint(pixel.x);
    imageStore(mx_lit, pixel, mx_light_payload(mx_payload_at(at), mx_ray_at(at)));
}
