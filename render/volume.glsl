// SPDX-License-Identifier: Apache-2.0
// The rest of path.glsl for volumes: media that fill a mesh which is no surface.
//
// Light goes straight through the mesh, into the medium where it comes from outside of a facet. At a collision scatter() runs at that place, as
// it does for a surface: it samples a direction, and weighs light from the environment and from a bound light. Those reach the place through
// whatever is around it, so shadow rays know its media, too.

#ifdef VOLUME

// The medium where scatter() has run. One that varies has no coefficients of its own: each collision asks for those of its place.
Medium medium_here(uint side)
{
    Medium medium = no_medium();
    medium.body = side;
    medium.is_volume = 1u;
    if (majorant_of(side) > 0.0)
        return medium;
    medium.extinction = out10.rgb;
    medium.scattering = out9.rgb;
    medium.emission = out1.rgb;
    return medium;
}

// The eye is inside of the volume.
void begin_in_volume(inout Path path, uint body)
{
    shade_inside(body / 4u - 1u, path.origin, path.direction, vec4(0.0));
    path.weight = vec3(1.0); // of what the medium sends to the eye
    enter_medium(path, medium_here(body));
}

// Through the mesh. A path that leaves a medium in which it is not began inside of it.
void meet_surface(inout Path path, Hit hit)
{
    uint side = side_of(hit, path.direction), at = find_around(OF_PATH, path.around, side);
    Point point = shade(hit, path.direction, vec4(0.0));
    path.origin = point.position + path.direction * NEAR;
    if (path.turns == 0u)
        path.weight = vec3(1.0); // of what the medium sends to the eye
    if (dot(point.facet, path.direction) < 0.0)
        enter_medium(path, medium_here(side));
    else if (is_same_object(path.medium.body, side))
        path.medium = take_around(OF_PATH, path.around);
    else if (at < path.around)
        remove_around(OF_PATH, path.around, at);
}

void scatter_in_volume(inout Path path)
{
    vec4 towards = draw_environment(next_random());
    at_level = vec2(-1.0, next_random().x);
    Point point = shade_inside(path.medium.body / 4u - 1u, path.origin, path.direction, towards);
    float majorant = majorant_of(path.medium.body);
#ifdef VARIES
    if (majorant > 0.0) { // out3 and out5 have the scattering
        path.light += path.through * out1.rgb / majorant;
        if (!is_real(path, majorant))
            return;
    }
#endif
    if (path.turns == 0u)
        keep_light(pixel_number(), vec3(0.0)); // no AOV has this light
    if (path.medium.collisions++ == 0u)
        count_turn(path);
    gather(path, point, towards.xyz, towards.w * environment(towards.xyz), mat3(0.0), false);
    path.through *= out3.rgb;
    path.direction = normalize(out2.xyz);
    path.density = out3.w;
    if (AS_DRAWN) // light that was scattered once meets nothing more
        path.medium = take_around(OF_PATH, path.around);
    path.phase = goes_on(path, path.medium.collisions) ? GOING : ENDED;
}

// A ray to a light goes through a surface of media in this way, too.
bool pass_surface(inout Shadow ray, uint number, Hit hit)
{
    uint side = side_of(hit, ray.direction), at = find_around(number, ray.around, side);
    Point point = shade(hit, ray.direction, vec4(0.0));
    ray.origin = point.position + ray.direction * NEAR;
    ray.limit -= hit.distance;
    if (dot(point.facet, ray.direction) < 0.0)
        enter_medium(ray, number, side, medium_here(side).extinction);
    else if (is_same_object(ray.body, side))
        leave_medium(ray, number);
    else if (at < ray.around)
        remove_around(number, ray.around, at);
    return true;
}

#endif
