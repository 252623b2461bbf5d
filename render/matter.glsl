// SPDX-License-Identifier: Apache-2.0
// The rest of path.glsl for piles of matter.
//
// A surface may be a pile of lobes and media, which scatter() has level by level (src/closure/matter_levels.c). Light goes down and up in it, at
// one point of the surface, until it leaves: a walk at random without positions (Guo, Hašan, Zhao 2018).

#ifdef MATTER

// How far light goes over how deep it gets.
float slope(Path path, vec3 up)
{
    float cosine = dot(path.direction, up);
    return (path.goes & BENT) != 0u ? 1.5 * inversesqrt(1.25 + cosine * cosine) : 1.0 / max(abs(cosine), 1e-4);
}

// Follows the path to its next collision in a medium, or out of it: false.
bool collide(inout Path path, vec3 up, vec4 xi)
{
    float tilt = slope(path, up);
    vec3 chance = chance_of_channels(path), extinction = out10.rgb * tilt;
    bool down = (path.goes & DOWN) != 0u;
    float room = down ? 1.0 - path.depth : path.depth;
    if (out9.r + out9.g + out9.b <= 0.0) { // it only absorbs: Beer, Lambert
        path.through *= exp(-extinction * room);
        return false;
    }
    float way = min(draw_way(chance, extinction, xi.xy), room);
    path.depth = way < room ? path.depth + (down ? way : -way) : down ? 1.0 : 0.0;
    path.through *= weight_of_way(chance, extinction, out9.rgb * tilt, way, way < room);
    return way < room;
}

void walk(inout Path path, vec3 up)
{
    vec4 xi = next_random();
    for (uint collisions = 1u; collide(path, up, xi); ++collisions, ++work, xi = next_random()) {
        if (collisions == 1u)
            count_turn(path);
        if (!goes_on(path, collisions))
            break;
        bool bends = (path.goes & BENT) != 0u;
        vec3 from = bends ? refract(path.direction, (path.goes & DOWN) != 0u ? up : -up, 1.0 / 1.5) : path.direction;
        path.direction = draw_phase(out9.a, from, xi.zw);
        path.goes = dot(path.direction, up) < 0.0 ? DOWN : 0u;
    }
}

// Light that a medium scattered leaves the pile evenly to the side of `up`.
void leave_evenly(inout Path path, Point point, vec3 up, vec4 towards)
{
    float density = max(dot(towards.xyz, up), 0.0) / PI, spread = towards.w;
    vec3 around = environment(towards.xyz) * (density * spread / (1.0 + spread * density));
    add_light(path, point, towards.xyz, FAR, around, vec3(0.0), LATER);
#ifdef LIGHTS
    add_light(path, point, out6.xyz, min(out6.w, FAR), out7.rgb * (max(dot(out6.xyz, up), 0.0) / PI), vec3(0.0), LATER);
#endif
    path.direction = draw_cosine(frame_of(up), 1.0, next_random().xy);
    path.density = dot(path.direction, up) / PI;
    path.medium.collisions = 0u;
}

void meet_lobe(inout Path path, Point point, vec4 towards)
{
    gather(path, point, towards.xyz, towards.w * environment(towards.xyz), mat3(0.0), false);
    path.through *= out3.rgb;
    if (out2.w > 1.5)
        return;
    count_turn(path);
    path.direction = normalize(out2.xyz);
    path.density = out3.w;
    path.goes = out2.w > 0.5 ? ACROSS : BENT;
}

// Away from the surface, where the path has met it, unless it has no light left.
void leave_at_once(inout Path path, Point point)
{
    path.phase = is_light(path.through) ? GOING : ENDED;
    path.origin = beside(point, path.direction);
    path.medium.collisions = 0u;
}

// Leaves the pile.
void leave_matter(inout Path path, Point point, vec4 towards, bool is_even)
{
    bool down = (path.goes & DOWN) != 0u, has_inside = down && out12.w > -1.5;
    path.phase = GOING;
    if (!sees_behind(path) || (AS_DRAWN && has_inside && path.turns > 0u)) { // a drawn body has no light from there
        path.phase = ENDED;
        return;
    }
    if (down && is_in_solid(path, path.side))
        leave_medium(path, path.medium.body);
    else if (has_inside && !AS_DRAWN)
        enter_hollow(path, path.matter.y);
    if (is_even && (path.goes & BENT) == 0u)
        leave_evenly(path, point, down ? -point.normal : point.normal, towards);
    path.direction = on_side(path.direction, down ? -outside(path, point) : outside(path, point), path.density);
    path.origin = beside(point, path.direction);
}

// Goes through the level for which scatter() has run.
void go_through(inout Path path, Point point, vec4 towards)
{
    bool is_body = out4.w == 1.0, is_even = out10.r + out10.g + out10.b > 0.0;
    if ((path.goes & DOWN) != 0u)
        path.light += path.through * out1.rgb;
    if ((path.goes & OUT) != 0u) {
        if (!leave_body(path, point))
            return;
        is_even = true;
    } else if (is_body && !AS_DRAWN) {
        enter_body(path, point, Medium(out10.rgb, 0u, out9.rgb, out9.a, vec3(0.0), 0u, vec2(out12.w, 0.0), 0u, 0u));
        return;
    } else if (is_body)
        is_even = false; // the next level stands for it
    else if (is_even)
        walk(path, point.normal);
    else if ((path.goes & DOWN) != 0u)
        meet_lobe(path, point, towards);
    if (path.goes == ACROSS) {
        if (AS_DRAWN && path.matter.x >= 0.0)
            path.through *= out11.rgb; // it comes out through the same media
        leave_at_once(path, point);
        if (path.phase == GOING)
            cross_surface(path, point, out4.rgb);
        return;
    }
    bool down = (path.goes & DOWN) != 0u;
    path.matter.x = down ? out10.w : out11.w;
    path.depth = down ? 0.0 : 1.0;
    path.phase = IN_MATTER;
    if (path.matter.x < 0.0)
        leave_matter(path, point, towards, is_even);
    if (!is_light(path.through))
        path.phase = ENDED;
}

// The first pile: `light` has all light of the surface, or of the BSDF of an AOV.
void begin_light(inout Path path)
{
    float of_surface = at_level.y < 1.0 ? 1.0 : 0.0;
    keep_light(pixel_number(), vec3(0.0));
    path.seen += path.weight * path.light;
    path.light = vec3(0.0);
    path.weight = vec3(of_surface);
    path.share *= of_surface * float(PARTS);
    path.through *= float(PARTS);
}

// Light in a solid meets the lobe that leads out of it, or a body, which sends it back.
void meet_from_solid(inout Path path, Point point, vec4 towards)
{
    path.light += path.through * out1.rgb;
    if (out4.w < 1.5) {
        count_turn(path);
        path.direction = draw_cosine(frame_of(point.normal), 1.0, next_random().xy);
        path.density = 0.0;
        path.goes = 0u;
    } else
        meet_lobe(path, point, towards);
    leave_at_once(path, point);
    if (path.goes != ACROSS || path.phase == ENDED)
        return;
    cross_surface(path, point, vec3(1.0));
    path.side ^= 1u; // light comes out on the other one
    path.goes = BENT;
    path.depth = 1.0;
    path.matter.x = out11.w;
    path.phase = IN_MATTER;
    if (path.matter.x < 0.0)
        leave_matter(path, point, towards, false);
}

void enter_matter(inout Path path, Hit hit, Point point, vec4 towards)
{
    if (path.turns == 0u)
        begin_light(path);
    path.place = hit;
    path.side = side_of(hit, path.direction);
    path.matter = at_level;
    path.goes = DOWN | BENT;
    path.depth = 0.0;
    if (at_level.x == FROM_SOLID && (out4.w > 1.5 || out12.w > -0.5))
        meet_from_solid(path, point, towards);
    else
        go_through(path, point, towards);
}

void go_on_in_matter(inout Path path)
{
    vec4 towards = draw_environment(next_random());
    at_level = path.matter;
    // scatter() looks from above
    Point point = shade(path.place, (path.goes & DOWN) != 0u ? path.direction : -path.direction, towards);
    go_through(path, point, towards);
}

#endif
