// SPDX-License-Identifier: Apache-2.0
// The rest of path.glsl for media that fill a mesh.
//
// A body is the last level of a pile of matter: light goes through it into the mesh, straight on, and from collision to collision to the
// mesh again. There it goes up through the pile of that point. A body may have other objects inside.

const float FROM_BELOW = 1000.0; // a level below all others

// Weighs light so that long ways end and none is lost on average; is_due: whatever the light. False: it ends.
bool survives(inout vec3 through, bool is_due)
{
    vec3 light = abs(through);
    if (max(light.x, max(light.y, light.z)) < 0.05 || is_due)
        through *= next_random().x < 0.5 ? 2.0 : 0.0;
    return is_light(through);
}

bool goes_on(inout Path path, uint collisions)
{
    const uint OFTEN = 1024u;
    return survives(path.through, collisions % OFTEN == 0u);
}

// A direction after a collision; `from`: before (Henyey and Greenstein 1941).
vec3 draw_phase(float g, vec3 from, vec2 xi)
{
    float part = (1.0 - g * g) / (1.0 - g + 2.0 * g * xi.x);
    float cosine = abs(g) < 1e-3 ? 1.0 - 2.0 * xi.x : (1.0 + g * g - part * part) / (2.0 * g);
    float sine = sqrt(max(1.0 - cosine * cosine, 0.0)), turn = 2.0 * PI * xi.y;
    return normalize(frame_of(from) * vec3(sine * cos(turn), sine * sin(turn), cosine));
}

// One channel draws the way to the next collision, and the mean of all densities weighs it.
float draw_way(vec3 chance, vec3 extinction, vec2 xi)
{
    float drawn = xi.x < chance.x ? extinction.x : xi.x < chance.x + chance.y ? extinction.y : extinction.z;
    return -log(1.0 - xi.y) / max(drawn, 1e-30);
}

vec3 chance_of_channels(Path path)
{
    return path.through / (path.through.x + path.through.y + path.through.z);
}

// The weight of light over a way, to a collision or to a surface.
vec3 weight_of_way(vec3 chance, vec3 extinction, vec3 scattering, float way, bool collides)
{
    vec3 passed = exp(-extinction * way), density = collides ? passed * extinction : passed;
    return (collides ? scattering * passed : passed) / max(dot(chance, density), 1e-30);
}

// The light that the medium sends over a way without a collision. Where a channel drew the way, a point of it stands for all.
vec3 light_of_way(Path path, vec3 chance, float way, bool is_drawn)
{
    vec3 extinction = path.medium.extinction;
    if (!is_drawn)
        return path.medium.emission * mix(vec3(way), (1.0 - exp(-extinction * way)) / max(extinction, 1e-20), greaterThan(extinction * way, vec3(1e-4)));
    return path.medium.emission * (way * weight_of_way(chance, extinction, vec3(0.0), way * next_random().x, false));
}

bool scatters(Medium medium)
{
    return medium.scattering.r + medium.scattering.g + medium.scattering.b > 0.0;
}

// Light has a collision, or turns otherwise inside a body.
void turn_inside(inout Path path, vec3 direction)
{
    if (path.medium.collisions++ == 0u)
        count_turn(path);
    path.density = 0.0;
    path.direction = direction;
}

// Stops the path until the kernel runs once more: lavapipe ends all loops of an invocation after 65,536 rounds together, and other devices
// do not like to be busy for long, either; or until that of a body runs that varies.
bool rests(inout Path path, uint body)
{
    const uint MOST = 3000u; // a round of `work` is several of the driver's: with 8,000 long walks lose light
    uint shader = majorant_of(body) > 0.0 ? objects[body / 4u - 1u].shader : this_shader();
    if (path.waits != 0u || (work < MOST && shader == this_shader()))
        return false;
    path.waits_for = shader;
    path.waits = AT_REST;
    return true;
}

// A way to the next collision with the majorant; 0: there is none.
float draw_tentative(float majorant)
{
    return majorant > 0.0 ? -log(1.0 - next_random().x) / majorant : FAR;
}

// Follows the path to the next surface, through what it is in.
int fly(inout Path path, out Hit hit)
{
    for (;;) {
        vec4 xi = vec4(0.0);
        vec3 chance = chance_of_channels(path), extinction = path.medium.extinction;
        bool may_collide = scatters(path.medium);
        float majorant = majorant_of(path.medium.body);
        if (rests(path, path.medium.body))
            return RESTS;
        if (may_collide)
            xi = next_random();
        float limit = min(may_collide ? draw_way(chance, extinction, xi.xy) : draw_tentative(majorant), FAR);
        left_out = path.medium.triangle;
        int what = meet(path, path.origin, path.direction, limit, hit);
        left_out = ~0u;
        if (what == ANOTHERS)
            return what;
        path.medium.triangle = ~0u;
        bool collides = what == NOTHING && limit < FAR;
        float way = what == OURS ? hit.distance : limit;
        if (is_light(path.medium.emission) && way < FAR)
            path.light += path.through * light_of_way(path, chance, way, may_collide);
        if (collides && majorant > 0.0) {
            path.origin += path.direction * way;
            path.phase = COLLIDED;
            return COLLIDES;
        }
        vec3 scattering = path.medium.is_volume != 0u ? vec3(1.0) : path.medium.scattering; // a volume's shader has its own
        path.through *= may_collide ? weight_of_way(chance, extinction, scattering, way, collides) : exp(-extinction * way);
        if (!collides)
            return what;
        path.origin += path.direction * way;
        if (path.medium.is_volume != 0u) {
            path.phase = COLLIDED;
            return COLLIDES;
        }
        turn_inside(path, draw_phase(path.medium.anisotropy, path.direction, xi.zw));
        if (!goes_on(path, path.medium.collisions)) {
            path.phase = ENDED;
            return what;
        }
    }
}

#ifdef MATTER

// The path meets the mesh of a body that it is in, or false. The side where light came in is another part of the mesh, in the same medium,
// and the mesh of a body around the one where the path is does nothing to its light.
bool meet_boundary(inout Path path, Hit hit)
{
    uint side = side_of(hit, path.direction), at = find_around(OF_PATH, path.around, side);
    bool is_own = is_same_object(side, path.medium.body);
    if (is_in_solid(path, side))
        return false;
    if (!is_own && at == path.around)
        return false;
    if (!is_own || side == path.medium.body) {
        path.origin += path.direction * hit.distance;
        path.medium.triangle = hit.triangle;
        if (!is_own && side != media[place_around(OF_PATH, at)].body)
            leave_medium(path, side);
        return true;
    }
    path.place = hit;
    path.side = path.medium.body;
    path.matter = vec2(path.medium.level.x < 0.0 ? FROM_BELOW : path.medium.level.x, path.medium.level.y);
    path.goes = path.medium.collisions != 0u ? OUT : OUT | BENT;
    path.phase = IN_MATTER;
    return true;
}

// The normal of the facet on the side where light came in.
vec3 outside(Path path, Point point)
{
    return (path.side & 1u) == 0u ? point.facet : -point.facet;
}

// A direction on this side of the facet: shading normals may send light to the other one. `density`: of the direction, where lights know it.
vec3 on_side(vec3 direction, vec3 side, inout float density)
{
    float height = dot(direction, side);
    density = height < 0.0 ? 0.0 : density;
    return height < 0.0 ? direction - side * (2.0 * height) : direction;
}

// Into the mesh, where no matter fills it.
void enter_hollow(inout Path path, float number)
{
    Medium medium = no_medium();
    medium.body = path.side;
    medium.level.y = number;
    enter_medium(path, medium);
}

// Through a hole of the surface, which may be the mesh of a body.
void pass_hole(inout Path path, Hit hit)
{
    path.side = side_of(hit, path.direction);
    if (out12.w > -1.5 && !AS_DRAWN)
        enter_hollow(path, 0.0);
}

void enter_body(inout Path path, Point point, Medium medium)
{
    medium.body = path.side;
    medium.triangle = path.place.triangle;
    medium.collisions = (path.goes & BENT) != 0u ? 0u : 1u;
    medium.level = vec2(medium.level.x, path.matter.y);
    enter_medium(path, medium);
    path.direction = on_side(path.direction, -outside(path, point), path.density);
    path.origin = point.position;
    path.phase = GOING;
}

// False: other matter is at this point, and sends light back into the body.
bool leave_body(inout Path path, Point point)
{
    bool is_hollow = path.medium.level.x < 0.0;
    if (is_hollow || out12.w == path.medium.level.x) {
        leave_medium(path, path.medium.body);
        path.goes &= ~OUT;
        return true;
    }
    turn_inside(path, draw_cosine(frame_of(-outside(path, point)), 1.0, next_random().xy));
    path.medium.level.y = floor(path.medium.level.y) + next_random().x;
    path.medium.triangle = path.place.triangle;
    path.origin = point.position;
    path.phase = GOING;
    return false;
}

// As above for a shadow ray; pass_surface() handles the side where it leaves its own medium.
bool meet_boundary(inout Shadow ray, uint number, uint side)
{
    uint at = find_around(number, ray.around, side);
    bool is_around = !is_same_object(side, ray.body) && at < ray.around;
    if (is_around && side != media[place_around(number, at)].body)
        remove_around(number, ray.around, at);
    return is_around || side == ray.body;
}

#endif

#ifndef VOLUME
bool pass_surface(inout Shadow ray, uint number, Hit hit)
{
#ifdef TRANSPARENT
#ifdef MATTER
    uint side = side_of(hit, ray.direction);
    bool is_inside = meet_boundary(ray, number, side), leaves = ray.body == (side ^ 1u);
#else
    const bool is_inside = false, leaves = false;
#endif
    at_level = leaves ? vec2(FROM_BELOW, ray.number) : vec2(-1.0, next_random().x);
    ray.origin = shade(hit, leaves ? -ray.direction : ray.direction, vec4(0.0)).position + ray.direction * NEAR;
    ray.limit -= hit.distance;
    if (is_inside)
        return true;
    bool is_hole = next_random().x >= out1.a;
#ifdef MATTER
    if (!is_hole)
        ray.through *= leaves && out12.w < 0.0 && ray.extinction != vec3(0.0) ? vec3(0.0) : out11.rgb;
    if (leaves)
        leave_medium(ray, number);
    else if (out12.w > -1.5)
        enter_medium(ray, number, side, is_hole ? vec3(0.0) : out12.rgb);
#else
    ray.through *= is_hole ? 1.0 : 0.0;
#endif
    return is_light(ray.through);
#else
    return true; // not asked: it blocks light
#endif
}
#endif
