// SPDX-License-Identifier: Apache-2.0
/*
 * Fragments: a call of a library's function is restored where it was taken down for arguments of
 * the same pattern, and only there. Behind the recording the constant 2.5 in the trees becomes 3.5:
 * so the result tells where it comes from. And versions of functions, which are taken down in the
 * same rehearsals.
 */
#include "lang/lang.h"

#include "one_file.h"
#include "test.h"

struct fixture {
    struct mem mem;
    struct arena arena;
    struct strpool strings;
    struct lang_unit library, generated;
    struct ir_graph graph;
    struct lang_recorder recorder;
    struct lang_host host;
    uint32_t file;
};

static ir_ref global_node(void *user_data, struct ir_graph *graph, const struct lang_unit *unit,
                          uint32_t global_id)
{
    (void)user_data, (void)unit;
    return ir_build(graph, IR_UNIFORM, IR_TYPE_FLOAT, 100 + global_id, NULL, 0);
}

/* A new generation over the library. */
static void begin(struct fixture *f)
{
    lang_unit_init(&f->generated, &f->arena, &f->strings, &f->library);
    ir_graph_init(&f->graph, &f->arena, &f->strings);
}

static void setup(struct fixture *f, const char *source)
{
    *f = (struct fixture){.host = {.global = global_node, .max_inline_nodes = 40}};
    mem_init(&f->mem, NULL, NULL);
    arena_init(&f->arena, &f->mem);
    strpool_init(&f->strings, &f->arena, NULL);
    lang_unit_init(&f->library, &f->arena, &f->strings, NULL);
    f->file = parse_one_file(&f->library, source);
    REQUIRE(f->file != LANG_NONE);
    lang_make_canonical(&f->library);
    begin(f);
}

static void teardown(struct fixture *f)
{
    ir_ref node;
    REQUIRE(!ir_check(&f->graph, &node));
    arena_finish(&f->arena);
    REQUIRE_EQ(f->mem.used, 0);
}

static ir_ref uniform(struct fixture *f, ir_type_id type, uint32_t number)
{
    return ir_build(&f->graph, IR_UNIFORM, type, number, NULL, 0);
}

/* The graph behind a call of f, as text. */
static const char *call(struct fixture *f, const ir_ref *args)
{
    ir_ref results[4];
    uint32_t id = lang_find_function(&f->library, f->file, str_find(&f->strings, "f", 1), NULL, 0);
    lang_lower_call(&f->generated, &f->graph, &f->host, id, args, results);
    struct text text;
    text_init(&text, &f->arena);
    ir_print(&f->graph, results, lang_num_results(&f->generated, id), &text);
    return text_cstr(&text);
}

/*
 * Takes down a call, gives the fragments to the library, and changes its trees. Returns what the
 * call became.
 */
static const char *record(struct fixture *f, const ir_ref *args)
{
    lang_recorder_init(&f->recorder, &f->arena, &f->library, 0);
    f->generated.recorder = &f->recorder;
    const char *text = call(f, args);
    lang_recorder_give(&f->recorder, &f->library);
    for (uint32_t i = 0; i < f->library.words.len; i++)
        if (f->library.words.items[i].f == 2.5f)
            f->library.words.items[i].f = 3.5f;
    begin(f);
    return text;
}

static bool is_restored(struct fixture *f, const ir_ref *args)
{
    const char *text = call(f, args);
    bool restored = strstr(text, "2.5"), read = strstr(text, "3.5");
    REQUIRE(!restored || !read);
    return restored;
}

static const char two_factors[] = "float f(float x, float y) { return x * 2.5 + sin(y); }";

static void record_two(struct fixture *f, const char *source)
{
    setup(f, source);
    record(f, (ir_ref[]){uniform(f, IR_TYPE_FLOAT, 0), uniform(f, IR_TYPE_FLOAT, 1)});
    REQUIRE_EQ(f->recorder.fragments.len, 1);
}

static void test_same_pattern(void)
{
    struct fixture f;
    record_two(&f, two_factors);
    REQUIRE(
        is_restored(&f, (ir_ref[]){uniform(&f, IR_TYPE_FLOAT, 7), uniform(&f, IR_TYPE_FLOAT, 8)}));
    /* no rule looks through a sine */
    ir_ref sine = ir_op1(&f.graph, IR_SIN, uniform(&f, IR_TYPE_FLOAT, 3));
    REQUIRE(is_restored(&f, (ir_ref[]){sine, uniform(&f, IR_TYPE_FLOAT, 8)}));
    teardown(&f);
}

static void test_other_pattern(void)
{
    struct fixture f;
    record_two(&f, two_factors);
    ir_ref a = uniform(&f, IR_TYPE_FLOAT, 0), b = uniform(&f, IR_TYPE_FLOAT, 1);
    ir_ref product = ir_op2(&f.graph, IR_MUL, a, b),
           sample = ir_build(&f.graph, IR_SAMPLE, IR_TYPE_INT, 0, NULL, 0);
    REQUIRE(!is_restored(&f, (ir_ref[]){a, a}));
    REQUIRE(!is_restored(&f, (ir_ref[]){ir_const_float(&f.graph, 1.0f), b}));
    REQUIRE(!is_restored(&f, (ir_ref[]){a, ir_const_float(&f.graph, 4.0f)}));
    REQUIRE(!is_restored(&f, (ir_ref[]){product, uniform(&f, IR_TYPE_FLOAT, 2)}));
    REQUIRE(!is_restored(&f, (ir_ref[]){a, ir_convert(&f.graph, IR_TYPE_FLOAT, sample)}));
    REQUIRE(is_restored(&f, (ir_ref[]){a, b}));
    f.host.max_inline_nodes--;
    REQUIRE(!is_restored(&f, (ir_ref[]){a, b}));
    f.host.max_inline_nodes++;
    f.host.choice = 1;
    REQUIRE(!is_restored(&f, (ir_ref[]){a, b}));
    f.host.choice = LANG_NONE;
    REQUIRE(!is_restored(&f, (ir_ref[]){a, b}));
    teardown(&f);
}

/* What is looked through belongs to the pattern, with what is behind it. */
static void test_looked_through(void)
{
    struct fixture f;
    setup(&f, two_factors);
    ir_ref a = uniform(&f, IR_TYPE_FLOAT, 0), b = uniform(&f, IR_TYPE_FLOAT, 1);
    record(&f, (ir_ref[]){ir_op2(&f.graph, IR_MUL, a, b), a});
    a = uniform(&f, IR_TYPE_FLOAT, 5), b = uniform(&f, IR_TYPE_FLOAT, 6);
    ir_ref product = ir_op2(&f.graph, IR_MUL, a, b);
    REQUIRE(is_restored(&f, (ir_ref[]){product, a}));
    REQUIRE(!is_restored(&f, (ir_ref[]){product, b}));
    REQUIRE(!is_restored(&f, (ir_ref[]){a, b}));
    REQUIRE(!is_restored(
        &f, (ir_ref[]){ir_op2(&f.graph, IR_MUL, a, ir_const_float(&f.graph, 4.0f)), a}));
    teardown(&f);
}

/*
 * What is computed from a derivative weighs as much as anything else: only derivatives in a branch
 * of their own do not.
 */
static void test_derivatives(void)
{
    struct fixture f;
    record_two(&f, two_factors);
    ir_ref slope = ir_op1(&f.graph, IR_DFDX, uniform(&f, IR_TYPE_FLOAT, 0));
    REQUIRE(is_restored(&f, (ir_ref[]){slope, uniform(&f, IR_TYPE_FLOAT, 1)}));
    teardown(&f);
    record_two(
        &f, "float f(float x, float y) { float z = 2.5 * y; if (x > 0.0) z = z - x; return z; }");
    slope = ir_op1(&f.graph, IR_DFDX, uniform(&f, IR_TYPE_FLOAT, 0));
    ir_ref args[] = {uniform(&f, IR_TYPE_FLOAT, 1), slope};
    REQUIRE(is_restored(&f, args));
    f.host.choice = LANG_NONE;
    REQUIRE(!strstr(call(&f, args), "call")); /* read and lowered, it is no call either */
    teardown(&f);
    setup(&f,
          "float f(float x, float y) { float z = 2.5 * y; if (x > 0.0) z = dFdx(z); return z; }");
    REQUIRE(
        strstr(call(&f, (ir_ref[]){uniform(&f, IR_TYPE_FLOAT, 0), uniform(&f, IR_TYPE_FLOAT, 1)}),
               "call"));
    teardown(&f);
}

/* Every kind of node, and operands in the order in which they stand where they are restored. */
static void test_same_nodes(void)
{
    static const char source[] =
        "uniform float u_gain;\n"
        "float large(float x) { for (int i = 0; i < 4; ++i) { x += sin(x) * x; } return x; }\n"
        "float two(float x, out float y) { for (int i = 0; i < 4; ++i) { x += x; } y = x; return x "
        "- 1.0; }\n"
        "vec3 f(vec3 v, float s, mat3 m) { float t; float r = two(s, t); vec4 w = vec4(v.zxy, "
        "large(s));\n"
        "  vec3 q = s * s > 0.5 ? w.xyz + v : v * vec3(1.0, 2.0, -3.0);\n"
        "  return m * q + (w.w + r * t) * vec3(u_gain, s, v.y) + mat3(s, v.x, s, v.y, s, v.z, s, "
        "s, r)[1]; }";
    struct fixture f;
    setup(&f, source);
    const ir_ref forwards[3] = {uniform(&f, IR_TYPE_VEC3, 0), uniform(&f, IR_TYPE_FLOAT, 1),
                                uniform(&f, IR_TYPE_MAT3, 2)};
    const char *recorded = record(&f, forwards);
    REQUIRE_EQ(f.recorder.fragments.len, 1);
    const ir_ref again[3] = {uniform(&f, IR_TYPE_VEC3, 0), uniform(&f, IR_TYPE_FLOAT, 1),
                             uniform(&f, IR_TYPE_MAT3, 2)};
    REQUIRE_STR(call(&f, again), recorded);
    uint32_t num_nodes = f.graph.nodes.len;
    call(&f, again);
    REQUIRE_EQ(f.graph.nodes.len, num_nodes);
    begin(&f);
    ir_ref m = uniform(&f, IR_TYPE_MAT3, 2), s = uniform(&f, IR_TYPE_FLOAT, 1),
           v = uniform(&f, IR_TYPE_VEC3, 0);
    const char *restored = call(&f, (ir_ref[]){v, s, m});
    begin(&f);
    f.host.choice = LANG_NONE;
    m = uniform(&f, IR_TYPE_MAT3, 2), s = uniform(&f, IR_TYPE_FLOAT, 1),
    v = uniform(&f, IR_TYPE_VEC3, 0);
    REQUIRE_STR(restored, call(&f, (ir_ref[]){v, s, m}));
    teardown(&f);
}

/* A document's string has a number that means another one in the next document. */
static void test_foreign_strings(void)
{
    struct fixture f;
    setup(&f, "float f(float x, string mode) { if (mode == \"twice\") return x * 2.5 * 2.0; return "
              "x + 2.5; }");
    struct strpool own;
    strpool_init(&own, &f.arena, &f.strings);
    ir_ref foreign = ir_const_string(&f.graph, str_intern_z(&own, "of the document"));
    record(&f, (ir_ref[]){uniform(&f, IR_TYPE_FLOAT, 0), foreign});
    REQUIRE_EQ(f.recorder.fragments.len, 0);
    teardown(&f);
}

/* ---- Versions of functions ---- */

static const char nested[] =
    "float g(float x, float k, float unused) { for (int i = 0; i < 4; ++i) { x += sin(x * k) * k; "
    "} return x; }\n"
    "float f(float x) { for (int i = 0; i < 3; ++i) { x += g(x, 2.5, x); } return x; }\n";

/*
 * What a plan makes of calls of a function, by name, with nothing known; of f first. Returns f's
 * version.
 */
static uint32_t plan(struct fixture *f, unsigned num_calls, const char *const *names,
                     const union ir_word *const (*args)[3])
{
    f->generated.host = f->host;
    uint32_t first = 0;
    for (unsigned i = 0; i < num_calls; i++) {
        uint32_t id =
            lang_find_function(&f->library, f->file, str_find(&f->strings, names[i], 1), NULL, 0);
        uint32_t call = lang_plan_call(&f->generated, id, args[i]);
        first = i ? first : call;
    }
    lang_plan_finish(&f->generated);
    return lang_plan_version(&f->generated, first);
}

static const char *text_of(struct fixture *f, uint32_t function)
{
    struct text text;
    struct lang_style style;
    struct lang_names names = {0};
    text_init(&text, &f->arena);
    lang_style_init(&style, &lang_syntax_portable, &f->arena);
    lang_print_function(&style, &names, &f->generated, function, &text);
    return text_cstr(&text);
}

static void test_known_versions(void)
{
    static const union ir_word three = {.f = 3.0f};
    static const union ir_word *const args[][3] = {{NULL}, {NULL, &three, NULL}};
    static const char *const names[] = {"f", "g"};
    struct fixture f;
    setup(&f, nested);
    lang_recorder_init(&f.recorder, &f.arena, &f.library, 0);
    f.generated.recorder = &f.recorder;
    uint32_t made = plan(&f, 1, names, args);
    REQUIRE(made >= f.generated.base_functions);
    const char *text = text_of(&f, made);
    REQUIRE_EQ(f.recorder.library.known.len, 2);
    lang_recorder_give(&f.recorder, &f.library);
    /* The same calls get the version that is there. */
    begin(&f);
    uint32_t known = plan(&f, 1, names, args);
    REQUIRE(known < f.generated.base_functions && lang_known(&f.generated, known));
    REQUIRE_STR(text_of(&f, known), text);
    REQUIRE(strstr(text, "g(x)")); /* what is the same in all calls went */
    REQUIRE_EQ(f.generated.functions.len, 0);
    /* Where g is called otherwise, too, both change. */
    begin(&f);
    uint32_t other = plan(&f, 2, names, args);
    REQUIRE(other >= f.generated.base_functions);
    REQUIRE(strstr(text_of(&f, other), "g(x, 2.5)"));
    /* Another choice, other versions. */
    begin(&f);
    f.host.choice = 7;
    REQUIRE(plan(&f, 1, names, args) >= f.generated.base_functions);
    teardown(&f);
}

int main(void)
{
    test_same_pattern();
    test_other_pattern();
    test_looked_through();
    test_derivatives();
    test_same_nodes();
    test_foreign_strings();
    test_known_versions();
    return test_report("fragment");
}
