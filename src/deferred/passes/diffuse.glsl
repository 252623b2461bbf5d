// Light below the surface of bodies spreads: an integral over the disk around each point, which replaces the light of
// the bodies. Christensen and Burley 2015, "Approximate Reflectance Profiles for Efficient Subsurface Scattering": R(r)
// = (exp(-r / d) + exp(-r / 3d)) / (8 pi d r), with d the free path. Samples lie on the plane of the surface and are
// moved to what the picture shows there, as in Golubev 2018, "Efficient Screen-Space Subsurface Scattering Using
// Burley's Normalized Diffusion in Real-Time". Weights have the sum 1, so even light stays even.

const int MX_NUM_SAMPLES = 64;

// The lowest body of a pixel; there is one.
MxClosure mx_body(ivec2 pixel)
{
    MxReader reader = mx_open(pixel);
    MxClosure body;
    while (reader.next < reader.num_closures) {
        MxClosure c = mx_next(reader);
        if (c.is_thick > 0.0)
            body = c;
    }
    return body;
}

// The distance of sample u, whose density in the plane is R: a quarter of the samples falls off over d, the others over 3d.
float mx_distance(float u, float d)
{
    return u < 0.25 ? -d * log(1.0 - 4.0 * u) : -3.0 * d * log(1.0 - (4.0 * u - 1.0) / 3.0);
}

// The profile of light at a distance, up to a factor.
vec3 mx_profile(float r, vec3 d)
{
    return (exp(-r / d) + exp(-r / (3.0 * d))) / d;
}

// Spreads the light of the bodies around a pixel.
void mx_run(uvec2 group, uvec2 place)
{
    ivec2 pixel = mx_pixel_in(group, place);
    if (mx_is_outside(pixel) || imageLoad(mx_scattered, ivec3(pixel, 0)).w == 0.0)
        return;
    MxClosure body = mx_body(pixel);
    vec3 point = mx_point(pixel), d = max(body.free_path, 1e-4), x, y;
    float widest = max(d.x, max(d.y, d.z));
    mat4 to_pixels = inverse(mx_to_world);
    mx_across(mx_plane(pixel, point), x, y);
    float turn = mx_turn(pixel);
    vec3 light = vec3(0.0), weights = vec3(0.0);
    for (int i = 0; i < MX_NUM_SAMPLES; ++i) {
        float r = mx_distance((float(i) + 0.5) / float(MX_NUM_SAMPLES), widest), angle = turn + MX_GOLDEN_ANGLE * float(i);
        ivec2 other = mx_pixel_at(to_pixels, point + r * (cos(angle) * x + sin(angle) * y));
        if (other.x < 0)
            continue;
        vec4 sampled = imageLoad(mx_scattered, ivec3(other, 0));
        if (sampled.w == 0.0)
            continue;
        float away = other == pixel ? r : max(r, distance(mx_point(other), point)); // a step of depth is far
        vec3 weight = mx_profile(away, d) / mx_profile(r, vec3(widest));
        light += weight * sampled.xyz;
        weights += weight;
    }
    vec4 rest = imageLoad(mx_scattered, ivec3(pixel, 1));
    vec3 own = imageLoad(mx_scattered, ivec3(pixel, 0)).xyz;
    vec3 spread = vec3(weights.x > 0.0 ? light.x / weights.x : own.x, weights.y > 0.0 ? light.y / weights.y : own.y,
                       weights.z > 0.0 ? light.z / weights.z : own.z);
    vec4 lit = vec4(rest.xyz + body.diffuse_albedo * spread, 1.0);
#if MX_BELOW == 1
    if (rest.w == 0.0) { // the pass "blur" finishes the pixel
        imageStore(mx_below, ivec3(pixel, 1), lit);
        return;
    }
#endif
    imageStore(mx_lit, pixel, lit);
}
