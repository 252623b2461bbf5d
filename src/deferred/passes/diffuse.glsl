// Light below the surface of bodies spreads: an integral over the disk around each point, which replaces the light of the bodies. Christensen and
// Burley 2015, "Approximate Reflectance Profiles for Efficient Subsurface Scattering": R(r) = (exp(-r / d) + exp(-r / 3d)) / (8 pi d r), with d
// the free path. Samples lie on the plane of the surface and are moved to what the picture shows there, as in Golubev 2018, "Efficient Screen-Space
// Subsurface Scattering Using Burley's Normalized Diffusion in Real-Time". Weights have the sum 1, so that no light is gained or lost.

#if MX_SSS == 1
layout(MX_DEPTH) uniform sampler2D mx_depth;
layout(MX_LIT) uniform writeonly restrict image2D mx_lit;
layout(MX_SCATTERED, rgba16f) uniform readonly restrict image2DArray mx_scattered;

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

vec3 mx_point(ivec2 pixel)
{
    vec4 point = mx_to_world * vec4(vec2(pixel) + 0.5, texelFetch(mx_depth, pixel, 0).x, 1.0);
    return point.xyz / point.w;
}

// The normal of the geometry, whose neighbours are those with the smaller step of depth.
vec3 mx_plane(ivec2 pixel, vec3 point)
{
    ivec2 last = ivec2(mx_size.xy) - 1;
    vec3 right = mx_point(min(pixel + ivec2(1, 0), last)) - point, left = point - mx_point(max(pixel - ivec2(1, 0), ivec2(0)));
    vec3 down = mx_point(min(pixel + ivec2(0, 1), last)) - point, up = point - mx_point(max(pixel - ivec2(0, 1), ivec2(0)));
    bool is_left = pixel.x == last.x || (pixel.x > 0 && dot(left, left) < dot(right, right));
    bool is_up = pixel.y == last.y || (pixel.y > 0 && dot(up, up) < dot(down, down));
    return normalize(cross(is_left ? left : right, is_up ? up : down));
}

// The distance of sample u, whose density in the plane is R: a quarter of the samples falls off over d, the others over 3d.
float mx_distance(float u, float d)
{
    return u < 0.25 ? -d * log(1.0 - 4.0 * u) : -3.0 * d * log(1.0 - (4.0 * u - 1.0) / 3.0);
}

vec3 mx_profile(float r, vec3 d)
{
    return (exp(-r / d) + exp(-r / (3.0 * d))) / d;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (mx_is_outside(pixel) || imageLoad(mx_scattered, ivec3(pixel, 0)).w == 0.0)
        return;
    MxClosure body = mx_body(pixel);
    vec3 point = mx_point(pixel), d = max(body.free_path, 1e-4), x, y;
    float widest = max(d.x, max(d.y, d.z));
    mat4 to_pixels = inverse(mx_to_world);
    mx_across(mx_plane(pixel, point), x, y);
    float turn = 6.2831853 * fract(52.9829189 * fract(dot(vec2(pixel), vec2(0.06711056, 0.00583715)))); // Jimenez 2014
    vec3 light = vec3(0.0), weights = vec3(0.0);
    for (int i = 0; i < MX_NUM_SAMPLES; ++i) {
        float r = mx_distance((float(i) + 0.5) / float(MX_NUM_SAMPLES), widest), angle = turn + 2.3999632 * float(i); // the golden angle
        vec4 at = to_pixels * vec4(point + r * (cos(angle) * x + sin(angle) * y), 1.0);
        ivec2 other = ivec2(floor(at.xy / at.w));
        if (any(lessThan(other, ivec2(0))) || mx_is_outside(other))
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
    imageStore(mx_lit, pixel, vec4(rest.xyz + body.diffuse_albedo * spread, rest.w));
}
#else
void main()
{
}
#endif
