// SPDX-License-Identifier: Apache-2.0
// A path tracer around the function scatter() of a generated shader. Above this text stand the shader, path_structs.glsl, fill_vertex_data(),
// keep_aovs(), light_aovs(), keep_light(), and macros:
//
//     TRACER_SET    the descriptor set of the tracer's buffers
//     AS_DRAWN      whether a path goes as a drawn picture has it
//     PARTS         one more than AOVs of BSDFs
//     PICKS         so many paths in a row differ only in the closure that they pick where they hit first
//     LIGHTS        defined: lights are bound
//     TRANSPARENT   defined: light may go through
//     MATTER        defined: a surface is a pile of matter
//     INTERIOR      defined: a medium inside a surface may scatter
//     VOLUME        defined: what the mesh holds is a medium, and the mesh no surface
//     DISPLACES     defined: it is a program of its own, which moves the corners and traces nothing
//
// A scene may have several such shaders. Each is a kernel of its own: a path that meets a surface of another one waits in `paths` until that
// kernel runs.
//
// Light comes from the environment, from bound lights and from what surfaces emit. Directions are drawn by closures and by the environment
// alike, and weighed by the balance heuristic (Veach and Guibas 1995); src/closure/scatter.c tells how closures take part.

layout(set = TRACER_SET, binding = 0, std430) readonly buffer Nodes { Node nodes[]; };
layout(set = TRACER_SET, binding = 1, std430) readonly buffer Corners { Corner corners[]; };
layout(set = TRACER_SET, binding = 2, std430) buffer Film { vec4 film[]; }; // light of all pixels, then what they let straight through
// Sums of the map's light: over rows (height + 1 of them, from 0 to 1), then for each row over its texels (width + 1).
layout(set = TRACER_SET, binding = 3, std430) readonly buffer Sums { float sums[]; };
layout(set = TRACER_SET, binding = 4, std430) readonly buffer Objects { Object objects[]; };
layout(set = TRACER_SET, binding = 5, std430) readonly buffer Values { vec4 values[]; };
layout(set = TRACER_SET, binding = 6, std430) buffer Paths { Path paths[]; };
layout(set = TRACER_SET, binding = 7, std430) buffer Waiting { uint waiting[]; }; // how many paths wait for each shader
layout(set = TRACER_SET, binding = 9, std430) buffer Media { Medium media[]; };
layout(set = TRACER_SET, binding = 10) uniform sampler2D environment_map;
layout(push_constant) uniform Camera {
    vec4 eye, right, up, forward;  // a ray through (x, y), each from -1 to 1, goes along forward + x * right + y * up
    vec4 environment[3];           // columns: from the world to the map
    uvec4 frame;                   // width, height, first sample, number of samples
} camera;                          // eye.w: how often a path may turn;
                                   // up.w: brightness of the environment; forward.w: the most media around a path
                                   // environment[0].w: a distance that nothing has; [1].w: number of this shader
layout(local_size_x = 8, local_size_y = 8) in;

#define NEAR camera.environment[0].w
const float FAR = 1e29;
const float PI = 3.14159265;
const int MAX_HITS = 64; // those that a path goes straight through, too

uint pixel_number() { return gl_GlobalInvocationID.y * camera.frame.x + gl_GlobalInvocationID.x; }
uint this_shader() { return uint(camera.environment[1].w); }

// ---- Random numbers: Jarzynski and Olano 2020, "Hash Functions for GPU Rendering", pcg4d ----

uvec4 random_state;

vec4 next_random()
{
    uvec4 v = random_state * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v ^= v >> 16u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    ++random_state.w;
    return vec4(v >> 8u) * (1.0 / 16777216.0);
}

// ---- Intersection ----

float enter_box(uint node, vec3 origin, vec3 inverse, float limit)
{
    vec3 a = (nodes[node].low - origin) * inverse, b = (nodes[node].high - origin) * inverse;
    vec3 near = min(a, b), far = max(a, b);
    float first = max(max(near.x, near.y), max(near.z, 0.0)), last = min(min(far.x, far.y), min(far.z, limit));
    return first <= last ? first : 1e38;
}

uint left_out = ~0u; // a triangle that rays do not meet, because they start there

// Moeller and Trumbore 1997, both sides.
void meet_triangle(uint triangle, vec3 origin, vec3 direction, inout Hit hit)
{
    vec3 a = corners[triangle * 3u].position_s.xyz;
    vec3 u = corners[triangle * 3u + 1u].position_s.xyz - a, v = corners[triangle * 3u + 2u].position_s.xyz - a;
    vec3 p = cross(direction, v);
    float determinant = dot(u, p);
    if (abs(determinant) < 1e-20 || triangle == left_out)
        return;
    vec3 t = origin - a, q = cross(t, u);
    vec3 solution = vec3(dot(t, p), dot(direction, q), dot(v, q)) / determinant;
    if (solution.x >= 0.0 && solution.y >= 0.0 && solution.x + solution.y <= 1.0 && solution.z > 0.0 && solution.z < hit.distance)
        hit = Hit(solution.z, triangle, solution.xy);
}

uint work = 0u; // rounds of loops

bool find_hit(vec3 origin, vec3 direction, float limit, out Hit hit)
{
    uint stack[40];
    int top = 0;
    stack[0] = 0u;
    hit.distance = limit;
    vec3 inverse = 1.0 / direction;
    while (top >= 0) {
        ++work;
        uint node = stack[top--];
        if (enter_box(node, origin, inverse, hit.distance) > hit.distance)
            continue;
        uint first = nodes[node].first, count = nodes[node].count;
        work += count;
        for (uint i = 0u; i < count; ++i)
            meet_triangle(first + i, origin, direction, hit);
        if (count == 0u) {
            stack[++top] = first + 1u;
            stack[++top] = first;
        }
    }
    return hit.distance < limit;
}

// ---- Environment ----

mat3 to_map()
{
    return mat3(camera.environment[0].xyz, camera.environment[1].xyz, camera.environment[2].xyz);
}

vec2 place_on_map(vec3 direction)
{
    vec3 d = normalize(to_map() * direction);
    return vec2(atan(d.x, -d.z), -2.0 * asin(clamp(d.y, -1.0, 1.0))) * (0.5 / PI) + 0.5;
}

vec3 environment(vec3 direction)
{
    return camera.up.w * textureLod(environment_map, place_on_map(direction), 0.0).rgb;
}

// The last of `count` sums from `first` on, which rise from 0 to 1, that is not above x.
uint find_sum(uint first, uint count, float x)
{
    uint low = 0u, high = count - 1u;
    while (high - low > 1u) {
        ++work;
        uint middle = (low + high) / 2u;
        if (sums[first + middle] <= x)
            low = middle;
        else
            high = middle;
    }
    return low;
}

uint row_sums(uint row, uvec2 size)
{
    return size.y + 1u + row * (size.x + 1u);
}

// Density of a direction in a texel: its chance over its solid angle.
float texel_density(uvec2 texel, uvec2 size, float latitude)
{
    uint row = row_sums(texel.y, size);
    float chance = (sums[texel.y + 1u] - sums[texel.y]) * (sums[row + texel.x + 1u] - sums[row + texel.x]);
    return chance * float(size.x * size.y) / (2.0 * PI * PI * max(cos(latitude), 1e-6));
}

float environment_density(vec3 direction)
{
    uvec2 size = uvec2(textureSize(environment_map, 0));
    vec2 at = place_on_map(direction);
    return texel_density(min(uvec2(at * vec2(size)), size - 1u), size, PI * (0.5 - at.y));
}

// A direction, and one over its density.
vec4 draw_environment(vec4 xi)
{
    uvec2 size = uvec2(textureSize(environment_map, 0)), texel;
    texel.y = find_sum(0u, size.y + 1u, xi.x);
    texel.x = find_sum(row_sums(texel.y, size), size.x + 1u, xi.y);
    vec2 at = (vec2(texel) + xi.zw) / vec2(size);
    float latitude = PI * (0.5 - at.y), longitude = 2.0 * PI * (at.x - 0.5);
    vec3 d = vec3(cos(latitude) * sin(longitude), sin(latitude), -cos(latitude) * cos(longitude));
    return vec4(transpose(to_map()) * d, 1.0 / max(texel_density(texel, size, latitude), 1e-20));
}

// ---- Surfaces ----

Hit met;           // where attributes are read

// Attribute number i at the hit.
vec4 hit_value(uint i)
{
    Corner corner = corners[met.triangle * 3u];
    Object object = objects[corner.object];
    uint at = object.first_value + (i * object.num_triangles + corner.triangle) * 3u;
    return values[at] * (1.0 - met.weights.x - met.weights.y) + values[at + 1u] * met.weights.x + values[at + 2u] * met.weights.y;
}

vec3 mixed(vec3 a, vec3 b, vec3 c, vec2 weights)
{
    return a * (1.0 - weights.x - weights.y) + b * weights.x + c * weights.y;
}

struct Point { vec3 position, facet, normal; };

vec3 beside(Point point, vec3 direction)
{
    return point.position + point.facet * (dot(point.facet, direction) < 0.0 ? -NEAR : NEAR);
}

// How much position, normal and texture coordinates change over a pixel, whose ray is beside this one by `size` at the hit (Igehy 1999,
// "Tracing Ray Differentials", to the first order).
void find_differentials(Corner a, Corner b, Corner c, vec3 facet, vec3 direction, float size)
{
    vec3 x = camera.right.xyz - direction * dot(direction, camera.right.xyz);
    x = normalize(dot(x, x) > 1e-12 ? x : cross(direction, vec3(direction.z, direction.x, direction.y)));
    vec3 y = cross(x, direction), u = b.position_s.xyz - a.position_s.xyz, v = c.position_s.xyz - a.position_s.xyz;
    float slope = dot(facet, direction);
    slope = abs(slope) < 0.05 ? (slope < 0.0 ? -0.05 : 0.05) : slope;
    x = (x - direction * (dot(facet, x) / slope)) * size;
    y = (y - direction * (dot(facet, y) / slope)) * size;
    mat2 squares = mat2(dot(u, u), dot(u, v), dot(u, v), dot(v, v)); // the triangle's weights at x and y
    if (abs(determinant(squares)) < 1e-30)
        return;
    mat2 weights = inverse(squares) * mat2(dot(u, x), dot(v, x), dot(u, y), dot(v, y));
    u = b.rest.xyz - a.rest.xyz;
    v = c.rest.xyz - a.rest.xyz;
    dx_point = u * weights[0].x + v * weights[0].y;
    dy_point = u * weights[1].x + v * weights[1].y;
    u = b.normal_t.xyz - a.normal_t.xyz;
    v = c.normal_t.xyz - a.normal_t.xyz;
    dx_normal = u * weights[0].x + v * weights[0].y;
    dy_normal = u * weights[1].x + v * weights[1].y;
    mat2 texcoord = mat2(vec2(b.position_s.w, b.normal_t.w) - vec2(a.position_s.w, a.normal_t.w),
                         vec2(c.position_s.w, c.normal_t.w) - vec2(a.position_s.w, a.normal_t.w));
    dx_texcoord = texcoord * weights[0];
    dy_texcoord = texcoord * weights[1];
}

// Axes whose last one is z.
mat3 frame_of(vec3 z)
{
    vec3 x = normalize(abs(z.x) > 0.5 ? vec3(-z.z, 0.0, z.x) : vec3(0.0, z.z, -z.y));
    return mat3(x, cross(z, x), z);
}

// A direction in a cone around z with a density like its cosine; `radius`: the sine of half the cone's angle (Pharr, Jakob, Humphreys,
// "Physically Based Rendering", section A.5.3, with a smaller disk).
vec3 draw_cosine(mat3 frame, float radius, vec2 xi)
{
    float square = radius * radius * xi.x, turn = 2.0 * PI * xi.y;
    return frame * vec3(sqrt(square) * cos(turn), sqrt(square) * sin(turn), sqrt(1.0 - square));
}

// The part of the cone around the normal that nothing closes up to `limit`; `angle`: half of the cone's, in degrees.
float trace_occlusion(vec3 normal, vec3 view, float angle, float limit)
{
    const int RAYS = 16;
    vec3 a = corners[met.triangle * 3u].position_s.xyz, b = corners[met.triangle * 3u + 1u].position_s.xyz,
         c = corners[met.triangle * 3u + 2u].position_s.xyz;
    vec3 n = dot(normal, view) < 0.0 ? -normal : normal, facet = cross(b - a, c - a);
    facet = normalize(dot(facet, n) < 0.0 ? -facet : facet);
    mat3 frame = frame_of(n);
    vec3 origin = mixed(a, b, c, met.weights) + facet * NEAR;
    float radius = sin(radians(clamp(angle, 0.0, 90.0)));
    int num_open = 0;
    for (int i = 0; i < RAYS; ++i) {
        Hit hit;
        vec4 xi = next_random();
        vec3 d = draw_cosine(frame, radius, vec2((float(i) + xi.x) / float(RAYS), xi.y));
        num_open += dot(d, facet) > 0.0 && !find_hit(origin, d, min(limit, FAR), hit) ? 1 : 0;
    }
    return float(num_open) / float(RAYS);
}

uint pick = PICKS; // the part of the numbers that may pick a closure; PICKS: all

// Runs scatter() at a place in a volume.
Point shade_inside(vec3 position, vec3 direction, vec4 light)
{
    work += 32u;
    fill_vertex_data(position, -direction, frame_of(direction)[0], vec2(0.0), -direction, next_random(), light, -direction);
    scatter();
    return Point(position, vec3(0.0), vec3(0.0));
}

// Runs scatter() at the hit.
Point shade(Hit hit, vec3 direction, vec4 light)
{
    Corner a = corners[hit.triangle * 3u], b = corners[hit.triangle * 3u + 1u], c = corners[hit.triangle * 3u + 2u];
    Point point;
    work += 32u; // about as many as a shader has
    point.position = mixed(a.position_s.xyz, b.position_s.xyz, c.position_s.xyz, hit.weights);
    point.facet = normalize(cross(b.position_s.xyz - a.position_s.xyz, c.position_s.xyz - a.position_s.xyz));
    vec3 normal = normalize(mixed(a.normal_t.xyz, b.normal_t.xyz, c.normal_t.xyz, hit.weights));
    vec3 tangent = normalize(mixed(a.tangent.xyz, b.tangent.xyz, c.tangent.xyz, hit.weights));
    vec2 texcoord = mixed(vec3(a.position_s.w, a.normal_t.w, 0.0), vec3(b.position_s.w, b.normal_t.w, 0.0),
                          vec3(c.position_s.w, c.normal_t.w, 0.0), hit.weights).xy;
    vec3 rest = mixed(a.rest.xyz, b.rest.xyz, c.rest.xyz, hit.weights);
    vec3 moved = normalize(mixed(a.moved.xyz, b.moved.xyz, c.moved.xyz, hit.weights));
    find_differentials(a, b, c, point.facet, direction, hit.distance * length(camera.right.xyz) / float(camera.frame.x));
    point.normal = dot(moved, direction) > 0.0 ? -moved : moved;
    met = hit;
    to_object = objects[a.object].to_object;
    vec4 random = next_random();
    random.w = pick < PICKS ? (float(pick) + random.w) / float(PICKS) : random.w;
    fill_vertex_data(rest, normal, tangent, texcoord, -direction, random, light, moved);
    scatter();
    return point;
}

// ---- Media: media.glsl ----

const uint IS_BODY = 2u; // of Medium.body: it is no solid
uint side_of(Hit hit, vec3 direction);
Medium no_medium();
void enter_medium(inout Path path, Medium medium);
void leave_medium(inout Path path, uint body);
void copy_media(Path path, inout Shadow ray, uint number);
bool is_in_body(Path path);
bool is_in_solid(Path path, uint side);

// ---- Lights ----

bool is_light(vec3 color)
{
    float most = max(color.x, max(color.y, color.z));
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

// Follows the ray to a light to its end, or false where it has to wait.
bool follow_shadow(inout Path path)
{
    Hit hit;
    Shadow ray = path.shadows[path.num_shadows - 1u];
    for (; ray.hits < uint(MAX_HITS); ++ray.hits) {
        int what = meet(path, ray.origin, ray.direction, ray.limit, hit);
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
    }
    --path.num_shadows;
    return true;
}

// The next step of a path. CROSSING: it has gone into a solid, as a drawn picture has it, and leaves at the other side, whole. IN_MATTER: it
// goes through a pile of matter on a surface. COLLIDED: it has a collision in a volume.
const uint GOING = 0u, CROSSING = 1u, ENDED = 2u, IN_MATTER = 3u, COLLIDED = 4u;
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
#endif
#ifdef MATTER
void pass_hole(inout Path path, Hit hit);
bool meet_boundary(inout Path path, Hit hit);
void enter_matter(inout Path path, Hit hit, Point point, vec4 towards); // matter.glsl
void go_on_in_matter(inout Path path);
#endif

// The next level of a pile; false where the path has to wait.
bool follow_matter(inout Path path)
{
    path.waits_for = objects[corners[path.place.triangle * 3u].object].shader;
    if (path.waits_for != this_shader())
        return wait(path, path.place);
    path.waits = 0u;
#ifdef MATTER
    go_on_in_matter(path);
#endif
    return true;
}

// A collision in a volume; false where the path has to wait for the shader of that.
bool follow_collision(inout Path path)
{
    path.waits_for = objects[path.medium.body / 4u - 1u].shader;
    if (path.waits_for != this_shader())
        return wait(path, path.hit);
    path.waits = 0u;
#ifdef VOLUME
    scatter_in_volume(path);
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
#endif
    if (AS_DRAWN) {
        path.phase = CROSSING;
        path.through *= inside;
    } else if (dot(point.facet, path.direction) < 0.0)
        enter_medium(path, solid);
    else
        leave_medium(path, solid.body);
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
        else if (goes && path.phase == GOING)
            goes = follow_ray(path);
    }
    return goes;
}

#ifdef DISPLACES
// How far a vertex moves: the film has the number of one of its corners.
void main()
{
    uint at = gl_GlobalInvocationID.y * camera.frame.x + gl_GlobalInvocationID.x;
    if (gl_GlobalInvocationID.x >= camera.frame.x || at >= camera.frame.y)
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
    path.phase = GOING;
    path.number = number;
    return path;
}

void main()
{
    uvec2 pixel = gl_GlobalInvocationID.xy;
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
