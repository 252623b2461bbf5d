// The surface around a pixel, for passes that gather light from there.

const float MX_GOLDEN_ANGLE = 2.3999632; // Vogel's spiral covers a disk evenly

// The point of the world that a pixel shows.
vec3 mx_point(ivec2 pixel)
{
    vec4 point = mx_to_world * vec4(vec2(pixel) + 0.5, texelFetch(mx_depth, pixel, 0).x, 1.0);
    return point.xyz / point.w;
}

// The normal of the geometry, whose neighbours are those with the smaller step of depth.
vec3 mx_plane(ivec2 pixel, vec3 point)
{
    ivec2 last = ivec2(mx_size) - 1;
    vec3 right = mx_point(min(pixel + ivec2(1, 0), last)) - point, left = point - mx_point(max(pixel - ivec2(1, 0), ivec2(0)));
    vec3 down = mx_point(min(pixel + ivec2(0, 1), last)) - point, up = point - mx_point(max(pixel - ivec2(0, 1), ivec2(0)));
    bool is_left = pixel.x == last.x || (pixel.x > 0 && dot(left, left) < dot(right, right));
    bool is_up = pixel.y == last.y || (pixel.y > 0 && dot(up, up) < dot(down, down));
    return normalize(cross(is_left ? left : right, is_up ? up : down));
}

// The pixel that shows a point of the world; x below 0: none does.
ivec2 mx_pixel_at(mat4 to_pixels, vec3 point)
{
    vec4 at = to_pixels * vec4(point, 1.0);
    ivec2 pixel = ivec2(floor(at.xy / at.w));
    return any(lessThan(pixel, ivec2(0))) || mx_is_outside(pixel) ? ivec2(-1) : pixel;
}

// The turn of the samples of a pixel.
float mx_turn(ivec2 pixel)
{
    return 6.2831853 * mx_gradient_noise(vec2(pixel));
}
