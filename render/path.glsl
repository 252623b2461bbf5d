// SPDX-License-Identifier: Apache-2.0
// A path tracer around the function scatter() of a generated shader, which stands above, as do fill_vertex_data() and
// TRACER_SET. Paths go where closures send them; light comes from the environment and from what surfaces emit.

struct Node { vec3 low; uint first; vec3 high; uint count; };
struct Corner { vec4 position_s, normal_t, tangent; };

layout(set = TRACER_SET, binding = 0, std430) readonly buffer Nodes { Node nodes[]; };
layout(set = TRACER_SET, binding = 1, std430) readonly buffer Corners { Corner corners[]; };
layout(set = TRACER_SET, binding = 2, std430) buffer Film { vec4 film[]; };
layout(set = TRACER_SET, binding = 3) uniform sampler2D environment_map;
layout(push_constant) uniform Camera {
    vec4 eye, right, up, forward;  // a ray through (x, y), each from -1 to 1, goes along forward + x * right + y * up
    vec4 environment[3];           // columns: from the world to the map
    uvec4 frame;                   // width, height, first sample, number of samples
} camera;
layout(local_size_x = 8, local_size_y = 8) in;

const float NEAR = 1e-4;
const int MAX_BOUNCES = 32;

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

struct Hit { float distance; uint triangle; vec2 weights; };

float enter_box(uint node, vec3 origin, vec3 inverse, float limit)
{
    vec3 a = (nodes[node].low - origin) * inverse, b = (nodes[node].high - origin) * inverse;
    vec3 near = min(a, b), far = max(a, b);
    float first = max(max(near.x, near.y), max(near.z, 0.0)), last = min(min(far.x, far.y), min(far.z, limit));
    return first <= last ? first : 1e30;
}

// Moeller and Trumbore 1997, both sides.
void meet_triangle(uint triangle, vec3 origin, vec3 direction, inout Hit hit)
{
    vec3 a = corners[triangle * 3u].position_s.xyz;
    vec3 u = corners[triangle * 3u + 1u].position_s.xyz - a, v = corners[triangle * 3u + 2u].position_s.xyz - a;
    vec3 p = cross(direction, v);
    float determinant = dot(u, p);
    if (abs(determinant) < 1e-20)
        return;
    vec3 t = origin - a, q = cross(t, u);
    vec3 solution = vec3(dot(t, p), dot(direction, q), dot(v, q)) / determinant;
    if (solution.x >= 0.0 && solution.y >= 0.0 && solution.x + solution.y <= 1.0 && solution.z > 0.0 && solution.z < hit.distance)
        hit = Hit(solution.z, triangle, solution.xy);
}

bool find_hit(vec3 origin, vec3 direction, out Hit hit)
{
    uint stack[40];
    int top = 0;
    stack[0] = 0u;
    hit.distance = 1e29;
    vec3 inverse = 1.0 / direction;
    while (top >= 0) {
        uint node = stack[top--];
        if (enter_box(node, origin, inverse, hit.distance) > hit.distance)
            continue;
        uint first = nodes[node].first, count = nodes[node].count;
        for (uint i = 0u; i < count; ++i)
            meet_triangle(first + i, origin, direction, hit);
        if (count == 0u) {
            stack[++top] = first + 1u;
            stack[++top] = first;
        }
    }
    return hit.distance < 1e29;
}

// ---- Paths ----

vec3 environment(vec3 direction)
{
    vec3 d = normalize(mat3(camera.environment[0].xyz, camera.environment[1].xyz, camera.environment[2].xyz) * direction);
    vec2 at = vec2(atan(d.x, -d.z), -2.0 * asin(clamp(d.y, -1.0, 1.0))) * (0.5 / 3.14159265) + 0.5;
    return textureLod(environment_map, at, 0.0).rgb;
}

vec3 mixed(vec3 a, vec3 b, vec3 c, vec2 weights)
{
    return a * (1.0 - weights.x - weights.y) + b * weights.x + c * weights.y;
}

// Runs scatter() at the hit; returns the point and the normal of the triangle.
void shade(Hit hit, vec3 direction, out vec3 point, out vec3 facet)
{
    Corner a = corners[hit.triangle * 3u], b = corners[hit.triangle * 3u + 1u], c = corners[hit.triangle * 3u + 2u];
    point = mixed(a.position_s.xyz, b.position_s.xyz, c.position_s.xyz, hit.weights);
    facet = normalize(cross(b.position_s.xyz - a.position_s.xyz, c.position_s.xyz - a.position_s.xyz));
    vec3 normal = normalize(mixed(a.normal_t.xyz, b.normal_t.xyz, c.normal_t.xyz, hit.weights));
    vec3 tangent = normalize(mixed(a.tangent.xyz, b.tangent.xyz, c.tangent.xyz, hit.weights));
    vec2 texcoord = mixed(vec3(a.position_s.w, a.normal_t.w, 0.0), vec3(b.position_s.w, b.normal_t.w, 0.0),
                          vec3(c.position_s.w, c.normal_t.w, 0.0), hit.weights).xy;
    fill_vertex_data(point, normal, tangent, texcoord, -direction, next_random());
    scatter();
}

// Light towards the origin, and whether the path met anything that it did not pass straight through.
vec4 trace(vec3 origin, vec3 direction)
{
    vec3 light = vec3(0.0), through = vec3(1.0);
    bool met = false;
    for (int bounce = 0; bounce < MAX_BOUNCES; ++bounce) {
        Hit hit;
        if (!find_hit(origin, direction, hit))
            return met ? vec4(light + through * environment(direction), 1.0) : vec4(0.0);
        vec3 point, facet;
        shade(hit, direction, point, facet);
        if (next_random().x >= out1.a) {
            origin = point + direction * NEAR;
            continue;
        }
        met = true;
        light += through * out1.rgb;
        through *= out3.rgb;
        if (!(max(through.x, max(through.y, through.z)) > 0.0))
            break;
        direction = normalize(out2.xyz);
        origin = point + facet * (dot(facet, direction) < 0.0 ? -NEAR : NEAR);
    }
    return vec4(light, met ? 1.0 : 0.0);
}

void main()
{
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (pixel.x >= camera.frame.x || pixel.y >= camera.frame.y)
        return;
    vec4 sum = vec4(0.0);
    for (uint i = 0u; i < camera.frame.w; ++i) {
        random_state = uvec4(pixel, camera.frame.z + i, 0u);
        vec2 at = (vec2(pixel) + next_random().xy) / vec2(camera.frame.xy) * 2.0 - 1.0;
        sum += trace(camera.eye.xyz, normalize(camera.forward.xyz + at.x * camera.right.xyz - at.y * camera.up.xyz));
    }
    film[pixel.y * camera.frame.x + pixel.x] += sum;
}
