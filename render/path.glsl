// SPDX-License-Identifier: Apache-2.0
// The paths of the path tracer.
//
// A scene may have several such shaders. Each is a kernel of its own: a path that meets a surface of another one waits in `paths` until that
// kernel runs.
//
// Light comes from the environment, from bound lights and from what surfaces emit. Directions are drawn by closures and by the environment
// alike, and weighed by the balance heuristic (Veach and Guibas 1995); src/closure/scatter.c tells how closures take part.

// ---- Media: media.glsl ----

const uint IS_BODY = 2u; // of Medium.body: it is no solid
uint side_of(Hit hit, vec3 direction);
Medium no_medium();
void enter_medium(inout Path path, Medium medium);
void leave_medium(inout Path path, uint body);
void leave_medium(inout Shadow ray, uint number);
void copy_media(Path path, inout Shadow ray, uint number);
bool is_in_body(Path path);
bool is_in_solid(Path path, uint side);
float majorant_of(uint body);

// ---- Lights ----

bool is_light(vec3 color)
{
    float most = max(abs(color.x), max(abs(color.y), abs(color.z)));
    return most > 0.0 && most < FAR; // and a number
}

// Where light goes: to the first hit from the path, the environment, a bound light; or to a later one.
const uint BY_PATH = 0u, BY_ENVIRONMENT = 1u, BY_LIGHT = 2u, LATER = 3u;

void receive(inout Path path, vec3 light, uint of, vec3 through)
{
    if (of == LATER)
        path.light += through * light;
    else {
        path.seen += through * light;
        light_aovs(pixel_number(), of, through);
    }
}

// Light that comes to the point from there, unless something stands before it; what is behind `limit` is behind the light. `most`: the most
// that AOVs take of it.
void add_light(inout Path path, Point point, vec3 direction, float limit, vec3 light, vec3 most, uint of)
{
    if (!is_light(max(light, most)))
        return;
    if (AS_DRAWN) // it has no shadows
        receive(path, light, of, path.through);
    else {
        Shadow ray = Shadow(beside(point, direction), limit, direction, 0u, light, of, path.through, 0u, vec3(0.0), 0.0, 0u);
        copy_media(path, ray, path.num_shadows + 1u);
        path.shadows[path.num_shadows++] = ray;
    }
}

// Light that lights send to the point where scatter() has run, and that goes on from there. `arrives`: that the environment sends;
// `most`: the most that AOVs take of it.
void gather(inout Path path, Point point, vec3 direction, vec3 arrives, mat3 most, bool is_first)
{
    vec3 around = out5.rgb * arrives;
    add_light(path, point, direction, FAR, around, most[BY_ENVIRONMENT], is_first ? BY_ENVIRONMENT : LATER);
#ifdef LIGHTS
    add_light(path, point, out6.xyz, min(out6.w, FAR), out7.rgb, most[BY_LIGHT], is_first ? BY_LIGHT : LATER);
#endif
}

// Light that escaped paths meet; `density`: of the closure that sent it there, 0 where lights could not have done so.
vec3 meet_environment(vec3 direction, float density)
{
    float weight = density > 0.0 ? 1.0 / (1.0 + environment_density(direction) / density) : 1.0;
    return weight * environment(direction);
}

// ---- Paths ----

// Why a path waits.
const uint AT_HIT = 1u, AT_REST = 2u;

const float FROM_SOLID = -2.0; // a level: the first one for light in the solid that the surface bounds

// Results of meet() and fly(). RESTS: the path has worked enough for now; COLLIDES: in a volume.
const int NOTHING = 0, OURS = 1, ANOTHERS = 2, RESTS = 3, COLLIDES = 4;

int meet(inout Path path, vec3 origin, vec3 direction, float limit, out Hit hit)
{
    if (path.waits == AT_HIT) {
        hit = path.hit;
        path.waits = 0u;
        return OURS;
    }
    if (!find_hit(origin, direction, limit, hit))
        return NOTHING;
    path.waits_for = objects[corners[hit.triangle * 3u].object].shader;
    return path.waits_for == this_shader() ? OURS : ANOTHERS;
}

// Stops the path until the kernel of another shader runs.
bool wait(inout Path path, Hit hit)
{
    path.hit = hit;
    path.waits = AT_HIT;
    return false;
}

// Goes through the surface with the ray; false: nothing of its light does.
bool pass_surface(inout Shadow ray, uint number, Hit hit); // body.glsl
bool rests(inout Path path, uint body);
float draw_tentative(float majorant);
#ifdef VARIES
void pass_collision(inout Shadow ray); // varying.glsl
#endif

// Follows the ray to a light to its end, or false where it has to wait.
bool follow_shadow(inout Path path)
{
    Hit hit;
    Shadow ray = path.shadows[path.num_shadows - 1u];
    while (ray.hits < uint(MAX_HITS) && is_light(ray.through)) {
        if (rests(path, ray.body)) {
            path.shadows[path.num_shadows - 1u] = ray;
            return false;
        }
        float way = min(draw_tentative(majorant_of(ray.body)), ray.limit);
        int what = meet(path, ray.origin, ray.direction, way, hit);
        if (what == NOTHING && way < ray.limit) {
            ray.origin += ray.direction * way;
            ray.limit -= way;
#ifdef VARIES
            pass_collision(ray);
#endif
            continue;
        }
        if (what != ANOTHERS)
            ray.through *= exp(-ray.extinction * (what == OURS ? hit.distance : ray.limit));
        if (what == NOTHING) {
            receive(path, ray.light, ray.of, ray.through);
            break;
        }
        if (objects[corners[hit.triangle * 3u].object].blocks_light != 0u)
            break;
        if (what == ANOTHERS) {
            path.shadows[path.num_shadows - 1u] = ray;
            return wait(path, hit);
        }
        if (!pass_surface(ray, path.num_shadows, hit))
            break;
        ++ray.hits;
    }
    --path.num_shadows;
    return true;
}

// The next step of a path. CROSSING: it has gone into a solid, as a drawn picture has it, and leaves at the other side, whole. IN_MATTER: it
// goes through a pile of matter on a surface. COLLIDED: it has a collision in a volume. BEGINS: it learns what is around the eye.
const uint GOING = 0u, CROSSING = 1u, ENDED = 2u, IN_MATTER = 3u, COLLIDED = 4u, BEGINS = 5u;
// How it goes through matter: away from where it came in; as it is outside, where it enters a medium of index 1.5; out of a body;
// into a solid or out of it.
const uint DOWN = 1u, BENT = 2u, OUT = 4u, ACROSS = 8u;

void count_turn(inout Path path)
{
    if (path.turns++ == 0u)
        keep_aovs(pixel_number(), path.number == 0u, path.share);
}

// False for the light of an AOV: what is behind the closure is not of that.
bool sees_behind(Path path) { return path.turns > 0u || path.share > 0.0; }

int fly(inout Path path, out Hit hit); // body.glsl
void meet_surface(inout Path path, Hit hit);
#ifdef VOLUME
void scatter_in_volume(inout Path path); // volume.glsl
void begin_in_volume(inout Path path, uint body);
#elif defined VARIES
void scatter_in_solid(inout Path path); // varying.glsl
#endif
#ifdef MATTER
void pass_hole(inout Path path, Hit hit);
bool meet_boundary(inout Path path, Hit hit);
void enter_matter(inout Path path, Hit hit, Point point, vec4 towards); // matter.glsl
void go_on_in_matter(inout Path path);
#endif

// True where the kernel of the object runs; until then the path waits.
bool has_kernel_of(inout Path path, uint object)
{
    path.waits_for = objects[object].shader;
    path.waits = path.waits_for == this_shader() ? 0u : AT_REST;
    return path.waits == 0u;
}

// The next level of a pile; false where the path has to wait.
bool follow_matter(inout Path path)
{
    if (!has_kernel_of(path, corners[path.place.triangle * 3u].object))
        return false;
#ifdef MATTER
    go_on_in_matter(path);
#endif
    return true;
}

// A collision in a volume, or in what varies in a solid; false where the path has to wait for the shader of that.
bool follow_collision(inout Path path)
{
    if (!has_kernel_of(path, path.medium.body / 4u - 1u))
        return false;
#ifdef VOLUME
    scatter_in_volume(path);
#elif defined VARIES
    scatter_in_solid(path);
#endif
    return true;
}

// The next medium around the eye; false where the path has to wait for its shader.
bool follow_begin(inout Path path)
{
    uint number = path.medium.body == 0u ? 0u : path.around + 1u;
    uint body = number < uint(objects.length()) ? objects[number].around_eye : 0u;
    path.phase = body == 0u ? GOING : BEGINS;
    if (body == 0u)
        return true;
    if (!has_kernel_of(path, body / 4u - 1u))
        return false;
#ifdef VOLUME
    begin_in_volume(path, body);
#endif
    return true;
}

// Into a solid that lets `inside` through over a unit of the world, or out of it.
void cross_surface(inout Path path, Point point, vec3 inside)
{
    Medium solid = no_medium();
    solid.body = side_of(met, path.direction) & ~IS_BODY;
    solid.extinction = -log(max(inside, 1e-30));
#ifdef INTERIOR
    solid.extinction = out14.rgb;
    solid.scattering = out13.rgb;
    solid.anisotropy = out13.a;
    if (majorant_of(solid.body) > 0.0) // each collision asks for those of its place
        solid.extinction = solid.scattering = vec3(0.0);
#endif
    if (AS_DRAWN) {
        path.phase = CROSSING;
        path.through *= inside;
    } else if (dot(point.facet, path.direction) < 0.0)
        enter_medium(path, solid);
    else
        leave_medium(path, solid.body);
}

// Rays to lights that come into the solid at this surface begin outside of it.
void leave_with_light(inout Path path, Point point)
{
    uint side = side_of(met, path.direction);
    for (uint i = 0u; i < path.num_shadows; ++i)
        if (is_in_solid(path, side) && dot(point.facet, path.direction) > 0.0 && dot(point.facet, path.shadows[i].direction) > 0.0)
            leave_medium(path.shadows[i], i + 1u);
}

// Where a path goes that has met a surface.
void bounce(inout Path path, Point point, vec4 towards)
{
    bool is_first = path.turns == 0u;
    vec4 next = out2, weight = out3;
    vec3 inside = out4.rgb, arrives = towards.w * environment(towards.xyz);
    if (is_first) { // what it has so far comes from matter before this surface
        path.seen = path.weight * path.light + path.through * out1.rgb;
        path.light = vec3(0.0);
    } else
        path.light += path.through * out1.rgb;
    mat3 most = is_first ? keep_light(pixel_number(), arrives) : mat3(0.0); // that AOVs take of light that comes here
    count_turn(path);
    gather(path, point, towards.xyz, arrives, most, is_first);
    leave_with_light(path, point);
    if (is_first)
        path.weight = is_light(weight.rgb) ? weight.rgb : vec3(0.0);
    else
        path.through *= weight.rgb;
    path.direction = normalize(next.xyz);
    path.density = weight.w;
    path.origin = beside(point, path.direction);
    path.medium.collisions = 0u;
    if (!is_light(is_first ? max(path.weight, most[BY_PATH]) : path.through))
        path.phase = ENDED;
    else if (next.w > 0.5)
        cross_surface(path, point, inside);
}

#ifndef VOLUME
void meet_surface(inout Path path, Hit hit)
{
#ifdef MATTER
    if (meet_boundary(path, hit))
        return;
#endif
    if (!sees_behind(path)) {
        path.phase = ENDED;
        return;
    }
    vec4 towards = draw_environment(next_random());
    at_level = vec2(is_in_solid(path, side_of(hit, path.direction)) ? FROM_SOLID : -1.0, next_random().x * (path.turns == 0u ? float(PARTS) : 1.0));
    pick = path.turns == 0u ? path.number % PICKS : PICKS;
    Point point = shade(hit, path.direction, towards);
    pick = PICKS;
    if (next_random().x >= out1.a) {
        path.origin = point.position + path.direction * NEAR;
#ifdef MATTER
        pass_hole(path, hit);
#endif
        return;
    }
#ifdef MATTER
    enter_matter(path, hit, point, towards);
#else
    bounce(path, point, towards);
#endif
}
#endif

// Goes to the next surface; false where it has to wait.
bool follow_ray(inout Path path)
{
    Hit hit;
    bool is_inside = is_in_body(path); // from where light comes out yet, however often it turns there
    uint most = uint(camera.eye.w) + (is_inside ? 1u : 0u) + (path.medium.is_volume != 0u && path.medium.collisions > 0u ? 1u : 0u);
    if (path.hits >= uint(MAX_HITS) || (AS_DRAWN && path.turns > 0u) || path.turns >= most) {
        if (path.hits < uint(MAX_HITS) && path.turns > 0u && !is_inside)
            path.light += path.through * meet_environment(path.direction, path.density);
        path.phase = ENDED;
        return true;
    }
    int what = fly(path, hit);
    if (what == NOTHING) {
        if (path.turns > 0u && path.phase != ENDED)
            path.light += path.through * meet_environment(path.direction, path.density);
        path.phase = ENDED;
    }
    if (what == ANOTHERS)
        return wait(path, hit);
    if (what == RESTS)
        return false;
    if (what != OURS)
        return true;
    ++path.hits;
    meet_surface(path, hit);
    return true;
}

bool cross_solid(inout Path path)
{
    Hit hit;
    int what = meet(path, path.origin, path.direction, FAR, hit);
    if (what == ANOTHERS)
        return wait(path, hit);
    vec3 behind = path.direction;
    at_level = vec2(FROM_SOLID, path.matter.y);
    for (int i = 0; what == OURS && i < 16; ++i) {
        Point point = shade(hit, path.direction, vec4(0.0));
        if (out2.w > 0.5 && dot(out2.xyz, point.facet) > 0.0) {
            behind = out2.xyz;
            break;
        }
    }
    path.light += path.through * environment(behind);
    path.phase = ENDED;
    return true;
}

// Follows the path to its end, or false where it has to wait. Paths beside each other take turns: all cast shadows, then all go on.
bool follow(inout Path path)
{
    bool goes = true;
    while (goes && (path.num_shadows > 0u || path.phase != ENDED)) {
        while (goes && path.num_shadows > 0u)
            goes = follow_shadow(path);
        if (goes && AS_DRAWN && path.phase == CROSSING) // or else the driver compiles scatter() once more
            goes = cross_solid(path);
        else if (goes && path.phase == IN_MATTER)
            goes = follow_matter(path);
        else if (goes && path.phase == COLLIDED)
            goes = follow_collision(path);
        else if (goes && path.phase == BEGINS)
            goes = follow_begin(path);
        else if (goes && path.phase == GOING)
            goes = follow_ray(path);
    }
    return goes;
}

#ifdef DISPLACES
// How far a vertex moves: the film has the number of one of its corners.
void main()
{
    uint at = pixel_number();
    if (this_pixel().x >= camera.frame.x || at >= camera.frame.y)
        return;
    uint i = floatBitsToUint(film[at].w);
    Corner c = corners[i];
    if (objects[c.object].shader != this_shader())
        return;
    met = Hit(0.0, i / 3u, vec2(i % 3u == 1u ? 1.0 : 0.0, i % 3u == 2u ? 1.0 : 0.0));
    to_object = objects[c.object].to_object;
    fill_vertex_data(c.rest, c.normal_t.xyz, c.tangent, vec2(c.position_s.w, c.normal_t.w), c.normal_t.xyz, vec4(0.5),
                     vec4(c.normal_t.xyz, 0.0), c.normal_t.xyz);
    scatter();
    film[at].xyz = out8.xyz;
}
#elif defined MEASURES
// The extinction at a point in each cell of a box, whose corners are camera.eye and camera.right: `frame.z` cells along each edge of object
// number `frame.w`.
void main()
{
    uint at = pixel_number(), side = camera.frame.z;
    random_state = uvec4(at, camera.frame.w, 0u, 0u);
    vec3 place = (vec3(at % side, at / side % side, at / (side * side)) + next_random().xyz) / float(side);
    if (at >= side * side * side)
        return;
    shade_inside(camera.frame.w, mix(camera.eye.xyz, camera.right.xyz, place), vec3(0.0, 0.0, 1.0), vec4(0.0));
#ifdef VOLUME
    film[at] = out10;
#else
    film[at] = out14;
#endif
}
#else
// The path of sample number `number` through the pixel; a draw of random numbers per path.
Path begin(uvec2 pixel, uint number)
{
    Path path;
    random_state = uvec4(pixel, number / PICKS, 0u);
    vec2 at = (vec2(pixel) + next_random().xy) / vec2(camera.frame.xy) * 2.0 - 1.0;
    path.origin = camera.eye.xyz;
    path.direction = normalize(camera.forward.xyz + at.x * camera.right.xyz - at.y * camera.up.xyz);
    path.through = vec3(1.0);
    path.medium = no_medium();
    path.light = path.weight = path.seen = vec3(0.0);
    path.density = 0.0;
    path.share = 1.0;
    path.turns = path.hits = path.num_shadows = path.waits = path.waits_for = path.side = path.around = 0u;
    path.phase = BEGINS;
    path.number = number;
    return path;
}

void main()
{
    uvec2 pixel = this_pixel();
    if (pixel.x >= camera.frame.x || pixel.y >= camera.frame.y)
        return;
    uint index = pixel.y * camera.frame.x + pixel.x, end = camera.frame.z + camera.frame.w;
    // the first kernel of a batch begins the paths; others go on with those that wait for them
    bool begins = camera.environment[2].w > 0.5;
    if (!begins && (paths[index].waits == 0u || paths[index].waits_for != this_shader()))
        return;
    Path path;
    if (begins)
        path = begin(pixel, camera.frame.z);
    else {
        path = paths[index];
        path.waits = path.waits == AT_REST ? 0u : path.waits;
        random_state = uvec4(pixel, path.number / PICKS, path.random);
    }
    vec3 light = vec3(0.0), through = vec3(0.0);
    for (;;) {
        if (!follow(path)) {
            atomicAdd(waiting[path.waits_for], 1u);
            break;
        }
        bool is_straight = path.turns == 0u && sees_behind(path);
        light += path.seen + path.weight * path.light;
        if (!is_straight)
            light_aovs(index, BY_PATH, path.light);
        else
            through += path.through;
        if (path.number + 1u == end)
            break;
        path = begin(pixel, path.number + 1u);
    }
    path.random = random_state.w;
    paths[index] = path;
    film[index].rgb += light;
    film[camera.frame.x * camera.frame.y + index].rgb += through;
}
#endif
