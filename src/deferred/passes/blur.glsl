// Light below a rough interface is blurred, because the way of the view bends there: the mean of the light around,
// with the weights of a normal distribution on the surface. Samples that the picture shows elsewhere weigh less, those
// without such light nothing.

const int MX_NUM_SAMPLES = 48;

// Blurs the light below the surface of a pixel.
void mx_run(uvec2 group, uvec2 place)
{
    ivec2 pixel = mx_pixel_in(group, place);
    if (mx_is_outside(pixel))
        return;
    vec4 own = imageLoad(mx_below, ivec3(pixel, 0));
    if (own.w == 0.0)
        return;
    vec3 point = mx_point(pixel), light = vec3(0.0), x, y;
    mat4 to_pixels = inverse(mx_to_world);
    float turn = mx_turn(pixel), weights = 0.0;
    mx_across(mx_plane(pixel, point), x, y);
    for (int i = 0; i < MX_NUM_SAMPLES; ++i) {
        float r = own.w * sqrt(-2.0 * log(1.0 - (float(i) + 0.5) / float(MX_NUM_SAMPLES))), angle = turn + MX_GOLDEN_ANGLE * float(i);
        ivec2 other = mx_pixel_at(to_pixels, point + r * (cos(angle) * x + sin(angle) * y));
        vec4 sampled = other.x < 0 ? vec4(0.0) : imageLoad(mx_below, ivec3(other, 0));
        if (sampled.w == 0.0)
            continue;
        float away = other == pixel ? r : max(r, distance(mx_point(other), point)); // a step of depth is far
        float weight = exp((r * r - away * away) / (2.0 * own.w * own.w));
        light += weight * sampled.xyz;
        weights += weight;
    }
    vec4 rest = imageLoad(mx_below, ivec3(pixel, 1));
    imageStore(mx_lit, pixel, vec4(rest.xyz + (weights > 0.0 ? light / weights : own.xyz), rest.w));
}
