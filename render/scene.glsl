// SPDX-License-Identifier: Apache-2.0
// A path tracer around the function scatter() of a generated shader: scene.glsl has what rays meet, path.glsl how paths go. Above this text stand
// the shader, path_structs.glsl, fill_vertex_data(), keep_aovs(), light_aovs(), keep_light(), and macros:
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
//     MEASURES      defined: it is a program of its own, which finds the extinction at points of a volume and traces nothing

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
layout(set = TRACER_SET, binding = 10, std430) readonly buffer TheCamera { Camera camera; };
layout(set = TRACER_SET, binding = 11) uniform sampler2D environment_map;

#define NEAR camera.environment[0].w
const float FAR = 1e29;
const float PI = 3.14159265;
const int MAX_HITS = 64; // those that a path goes straight through, too

uvec2 this_pixel() { return uvec2(gl_FragCoord.xy); }
uint pixel_number() { return this_pixel().y * camera.frame.x + this_pixel().x; }
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

// Runs scatter() at a place in the volume of an object.
Point shade_inside(uint object, vec3 position, vec3 direction, vec4 light)
{
    work += 32u;
    to_object = objects[object].to_object;
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
