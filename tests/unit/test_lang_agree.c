// SPDX-License-Identifier: Apache-2.0
/*
 * Four ways to the same number: a function evaluated as it is written, a version with some of its
 * arguments bound, the one version of a planned shader, and the IR that a call becomes. They must
 * agree for whatever is bound.
 */
#include "lower/lower.h"
#include "parse/parse.h"
#include "print/print.h"
#include "specialise/specialise.h"
#include "tree/interpret.h"
#include "tree/reach.h"

#include "one_file.h"
#include "test.h"

#include <math.h>

enum { MAX_ARGS = 8, MAX_STEPS = 100000, NUM_TRIALS = 200 };

static const char source[] =
    "const float weights[4] = float[4](0.25, -1.0, 2.0, 0.5);\n"
    "struct Ray { vec3 origin; float scale[2]; };\n"
    "float branch(float x, float y, bool a, int n) {\n"
    "    float r = x; if (a) { if (y > 0.5) return x * y; r += 1.0; } else if (n == 2) r = y; else "
    "{ float t = x - y; r = t * t; }\n"
    "    if (n > 1) r *= 2.0; return r - y; }\n"
    "float loop(float x, int n, float w, bool early) {\n"
    "    float sum = 0.0; float last = x; int i = 0;\n"
    "    while (true) { if (i >= n) break; ++i; if (early && sum > 2.0) return sum + w;\n"
    "        if ((i & 1) == 0) continue; last = sum; sum += x * w + weights[i & 3]; }\n"
    "    do { sum -= 0.5; } while (sum > 3.0); return sum * last; }\n"
    "float carried(float x, int n) { float k = 1.0; float r = 0.0; for (int i = 0; i < n; ++i) { r "
    "+= k; k = x; } return r; }\n"
    "float stopped(float x, int n) { float k = 0.0;\n"
    "    for (int i = 0; i < 5; ++i) { k = x + float(i); if (i == n) break; k = 0.5; } return k; "
    "}\n"
    "vec3 outs(vec3 v, float s, out vec2 a, inout float b, int n) {\n"
    "    a = v.zx; vec3 r = v; r.yx = v.xz * s; r[n & 1] += b; b = r.y; if (s > 1.0) { a.y = s; "
    "return r; } a *= 2.0; return r + v; }\n"
    "float twice(float x, float k) { vec2 a; float b = k; vec3 r = outs(vec3(x, k, 1.0), k, a, b, "
    "0);\n"
    "    float c = 1.0; outs(r, 2.0, a, c, 1); return dot(r, r) + a.x * a.y + b * c; }\n"
    "float parts(float x, float y, int n) { Ray r = Ray(vec3(x, y, 1.0), float[2](y, 2.0)); Ray q "
    "= r;\n"
    "    q.origin.xy = r.origin.yx; q.scale[1] *= x; if (n > 0) { r = q; r.origin.z = 0.0; }\n"
    "    return dot(r.origin, q.origin) + r.scale[n & 1] * q.scale[1]; }\n"
    "float calls(float x, float y, bool a, int n) { float z = branch(x, y, a, n); z += branch(1.0, "
    "y, !a, 2) * y;\n"
    "    if (n == 3) z = loop(z, n, 0.5, a); return twice(z, y) + parts(y, 2.0, n) + branch(2.0, "
    "1.0, true, 0); }\n"
    "mat3 matrices(vec3 v, float s, mat3 m) { mat3 r = m * s; r[1] = v; r[2].x = s; mat3 i = "
    "mat3(1.0);\n"
    "    i[0][1] += s; return r * i + transpose(m) * v.x; }\n"
    "float chain(float x, int n) { float a, b = 2.0; vec2 c = vec2(x); c.y = a = b = x + float(n); "
    "c.x += a *= b;\n"
    "    for (a = b = 1.0; a < c.x; a += 1.0) { b += a; if (b > 9.0) break; } return a + b * c.y; "
    "}\n"
    "bvec3 relations(vec3 a, vec3 b, bvec3 c, int n) { bvec3 r = lessThan(a, b);\n"
    "    if (any(c) && !all(c)) r = not(r); if (n == 1) r = lessThanEqual(a, b);\n"
    "    if (n == 2) { r = greaterThan(a, b); r.x = c[n]; }\n"
    "    if (n == 3) r.zy = greaterThanEqual(a.xy, b.yx); if (n == 4) r = notEqual(c, r);\n"
    "    return equal(r, bvec3(c.yx, n > 2)); }\n"
    "vec3 chosen(vec3 a, vec3 b, bvec3 c, int n) { vec3 r = mix(a, b, c); bvec2 d = isnan(a.xy);\n"
    "    for (int i = 0; i < n; ++i) { r = mix(r, a * 2.0, lessThan(r, b)); c = not(c.zxy); }\n"
    "    r.xy = mix(r.xy, vec2(1, n), d); return c == bvec3(true) ? r : mix(r, vec3(c), c); }\n"
    "uvec3 unsigned_parts(uvec3 a, uint s, int n) { uvec3 r = a & 6u; r.x |= s << 3; r[n & 1] += "
    "7u;\n"
    "    r = (r << 1) ^ (a >> ivec3(n)); uvec4 w = uvec4(r, s); w.wz %= 5u; if (n > 2) w = ~w;\n"
    "    return min(w.xyz, uvec3(1u, 2u, 3u) * s) + uvec3(vec3(a)); }\n"
    "ivec4 signed_parts(ivec4 a, ivec3 b, float x) { ivec4 r = a - 2 * ivec4(b, int(x)); r.yz -= "
    "b.xx;\n"
    "    ivec3 q = max(abs(r.xyz), b); vec4 f = vec4(q, 1) * x; return ivec4(f) + r * "
    "ivec4(notEqual(a, r)); }\n";

struct agree {
    struct mem mem;
    struct arena arena, scratch; /* scratch: of one trial */
    struct strpool strings;
    struct lang_unit library, generated;
    uint32_t seed;
    const struct lang_function *fn; /* under test */
    uint32_t id;
    struct ir_value args[MAX_ARGS]; /* by parameter */
    bool bound[MAX_ARGS];
    struct ir_value expected[MAX_ARGS];
};

static uint32_t next_random(struct agree *a, uint32_t limit)
{
    a->seed = a->seed * 1664525u + 1013904223u;
    return (a->seed >> 8) % limit;
}

/* Numbers with few bits, whose sums and products are exact in any order; 0 and 1 often. */
static struct ir_value random_value(struct agree *a, ir_type_id type)
{
    struct ir_value value = {.type = type};
    uint32_t kind = next_random(a, 4);
    for (unsigned i = 0; i < ir_type_info(type)->components; i++)
        if (ir_type_info(type)->scalar == IR_TYPE_FLOAT)
            value.w[i].f = kind < 2 ? (float)kind : (float)next_random(a, 17) * 0.25f - 1.0f;
        else
            value.w[i].u = next_random(a, ir_type_info(type)->scalar == IR_TYPE_BOOL ? 2 : 5);
    return value;
}

static const struct lang_slot *param(const struct agree *a, uint32_t index)
{
    return &a->library.slots.items[a->fn->first_slot + index];
}

static bool is_near(const struct ir_value *x, const struct ir_value *y)
{
    const struct ir_type_info *info = ir_type_info(x->type);
    for (unsigned i = 0; i < info->components; i++)
        if (info->scalar == IR_TYPE_FLOAT
                ? fabsf(x->w[i].f - y->w[i].f) > 1e-4f * (1.0f + fabsf(x->w[i].f))
                : x->w[i].u != y->w[i].u)
            return false;
    return x->type == y->type;
}

static void require_results(const struct agree *a, const struct ir_value *results, const char *how)
{
    for (unsigned i = 0; i < lang_num_results(&a->library, a->id); i++)
        if (!REQUIRE(is_near(&a->expected[i], &results[i])))
            printf("    result %u of %s %s\n", i, str_text(&a->strings, a->fn->name), how);
}

/* The version evaluated with the arguments that it has left. */
static void try_version(struct agree *a, uint32_t version, const char *how)
{
    struct ir_value left[MAX_ARGS], results[MAX_ARGS];
    unsigned num_left = 0;
    for (uint32_t i = 0; i < a->fn->num_params; i++)
        if (param(a, i)->mode != LANG_OUT && !lang_param_dropped(&a->generated, version, a->id, i))
            left[num_left++] = a->args[i];
    if (REQUIRE(lang_eval_call(&a->generated, version, left, results, &(uint32_t){MAX_STEPS},
                               &a->scratch)))
        require_results(a, results, how);
}

static ir_ref no_global(void *user_data, struct ir_graph *graph, const struct lang_unit *unit,
                        uint32_t global_id)
{
    (void)user_data, (void)unit, (void)global_id;
    return ir_poison(graph, IR_TYPE_FLOAT);
}

static bool source_value(void *user_data, const struct ir_graph *graph, ir_ref ref,
                         struct ir_value *out)
{
    *out = ((struct agree *)user_data)->args[ir_get(graph, ref)->attr];
    return true;
}

static uint32_t call_value(void *user_data, const struct ir_graph *graph, ir_ref call,
                           const struct ir_value *args, struct ir_value *out)
{
    struct agree *a = user_data;
    return lang_eval_node(&a->generated, graph, call, args, &(uint32_t){LANG_MAX_STEPS},
                          &a->scratch, out);
}

static void try_lowering(struct agree *a, uint32_t max_inline_nodes)
{
    struct ir_graph graph;
    ir_graph_init(&graph, &a->scratch, &a->strings);
    struct lang_host host = {.global = no_global, .max_inline_nodes = max_inline_nodes};
    ir_ref args[MAX_ARGS], results[MAX_ARGS];
    unsigned num_args = 0;
    for (uint32_t i = 0; i < a->fn->num_params; i++)
        if (param(a, i)->mode != LANG_OUT)
            args[num_args++] = a->bound[i]
                                   ? ir_const(&graph, &a->args[i])
                                   : ir_build(&graph, IR_UNIFORM, param(a, i)->type, i, NULL, 0);
    lang_lower_call(&a->generated, &graph, &host, a->id, args, results);
    ir_ref node;
    REQUIRE(!ir_check(&graph, &node));
    struct ir_eval_env env = {a, source_value, call_value};
    struct ir_value values[MAX_ARGS];
    for (unsigned i = 0; i < lang_num_results(&a->library, a->id); i++)
        REQUIRE(ir_eval(&graph, results[i], &env, &a->scratch, &values[i]));
    require_results(a, values, max_inline_nodes ? "lowered" : "called from IR");
}

static void try_plan(struct agree *a)
{
    const union ir_word *bound[MAX_ARGS] = {0};
    for (uint32_t i = 0; i < a->fn->num_params; i++)
        bound[i] = a->bound[i] ? a->args[i].w : NULL;
    uint32_t call = lang_plan_call(&a->generated, a->id, bound);
    lang_plan_finish(&a->generated);
    try_version(a, lang_plan_version(&a->generated, call), "specialised");
}

static void try_once(struct agree *a)
{
    struct ir_value in[MAX_ARGS];
    unsigned num_in = 0;
    for (uint32_t i = 0; i < a->fn->num_params; i++) {
        a->args[i] = random_value(a, param(a, i)->type);
        a->bound[i] = param(a, i)->mode == LANG_IN && next_random(a, 2);
        if (param(a, i)->mode != LANG_OUT)
            in[num_in++] = a->args[i];
    }
    arena_init(&a->scratch, &a->mem);
    lang_unit_init(&a->generated, &a->scratch, &a->strings, &a->library);
    REQUIRE(
        lang_eval_call(&a->generated, a->id, in, a->expected, &(uint32_t){MAX_STEPS}, &a->scratch));
    try_lowering(a, 0);
    try_lowering(a, 1000);
    try_plan(a);
    arena_finish(&a->scratch);
}

static void try_all(struct agree *a)
{
    for (a->id = 0; a->id < a->library.functions.len; a->id++) {
        a->fn = &a->library.functions.items[a->id];
        for (unsigned trial = 0; trial < NUM_TRIALS; trial++)
            try_once(a);
    }
}

int main(void)
{
    struct agree a = {.seed = 1};
    mem_init(&a.mem, NULL, NULL);
    arena_init(&a.arena, &a.mem);
    strpool_init(&a.strings, &a.arena, NULL);
    lang_unit_init(&a.library, &a.arena, &a.strings, NULL);
    REQUIRE(parse_one_file(&a.library, source) != LANG_NONE);
    try_all(&a);
    lang_make_canonical(&a.library);
    try_all(&a);
    arena_finish(&a.arena);
    REQUIRE_EQ(a.mem.used, 0);
    return test_report("lang_agree");
}
