// SPDX-License-Identifier: Apache-2.0
/*
 * The back half of the language: printing, reaching, evaluating, specialising and lowering what the
 * parser has read.
 */
#include "lower/lower.h"
#include "parse/parse.h"
#include "print/print.h"
#include "specialise/specialise.h"
#include "tree/interpret.h"
#include "tree/reach.h"

#include "cases.h"
#include "one_file.h"

#include <math.h>

struct fixture {
    struct mem mem;
    struct arena arena;
    struct strpool strings;
    struct diag_list diags;
    struct lang_unit library, generated;
    struct ir_graph graph;
    uint32_t file;
    int option; /* the value of every option */
};

static void setup(struct fixture *f, const char *source)
{
    *f = (struct fixture){0};
    mem_init(&f->mem, NULL, NULL);
    arena_init(&f->arena, &f->mem);
    strpool_init(&f->strings, &f->arena, NULL);
    lang_unit_init(&f->library, &f->arena, &f->strings, NULL);
    diag_list_init(&f->diags, &f->arena);
    f->file = parse_one_file(&f->library, source);
    REQUIRE(f->file != LANG_NONE);
    lang_unit_init(&f->generated, &f->arena, &f->strings, &f->library);
    ir_graph_init(&f->graph, &f->arena, &f->strings);
}

static void teardown(struct fixture *f)
{
    ir_ref node;
    const char *problem = ir_check(&f->graph, &node);
    if (problem)
        printf("node %u: %s\n", (unsigned)node, problem);
    REQUIRE(!problem);
    arena_finish(&f->arena);
    REQUIRE_EQ(f->mem.used, 0);
}

static uint32_t find(struct fixture *f, const char *name)
{
    uint32_t id =
        lang_find_function(&f->library, f->file, str_intern_z(&f->strings, name), NULL, 0);
    if (!REQUIRE(id != LANG_NONE))
        printf("    %s\n", name);
    return id;
}

static const char *print_function(struct fixture *f, const struct lang_syntax *syntax,
                                  const struct lang_names *names, uint32_t id)
{
    struct lang_style style;
    struct text text;
    lang_style_init(&style, syntax, &f->arena);
    text_init(&text, &f->arena);
    lang_print_function(&style, names, &f->generated, id, &text);
    return text_cstr(&text);
}

/* Printing */

/* A text that is read is printed as it stands there. */
static void prints(struct fixture *f, const struct test_case *c)
{
    struct text text;
    text_init(&text, &f->arena);
    for (uint32_t i = 0; i < f->library.functions.len; i++)
        text_str(&text, print_function(f, &lang_syntax_portable, NULL, i));
    REQUIRE_STR(text_cstr(&text), c->in);
}

static void test_print_types(void)
{
    const char *source = "const float weights[3] = float[3](0.25, 0.5, 0.25);\n"
                         "struct Light {\n    vec3 direction;\n    float power[2];\n};\n"
                         "Light make(vec3 d)\n{\n    Light l = Light(d, float[2](1.0, 2.0));\n    "
                         "l.power[1] += weights[2];\n    return l;\n}\n";
    struct fixture f;
    setup(&f, source);
    struct text text;
    text_init(&text, &f.arena);
    struct lang_reach reach = {.arena = &f.arena};
    lang_reach_add(&reach, &f.generated, find(&f, "make"));
    REQUIRE_EQ(reach.globals.len, 1);
    REQUIRE_EQ(reach.user_types.len, 1);
    struct lang_style style;
    lang_style_init(&style, &lang_syntax_portable, &f.arena);
    lang_print_constant(&style, NULL, &f.generated, reach.globals.items[0], &text);
    lang_print_struct(&style, NULL, &f.generated, reach.user_types.items[0], &text);
    lang_print_function(&style, NULL, &f.generated, find(&f, "make"), &text);
    REQUIRE_STR(text_cstr(&text), source);
    teardown(&f);
}

static const char *other_name(void *user_data, uint32_t id)
{
    (void)user_data, (void)id;
    return "helper";
}

/* A target with words of its own, no operator for a remainder, and another name for a type. */
static void test_print_target(void)
{
    static const char *const reserved[] = {"half", "sample", "texture"};
    static const char *const type_names[IR_NUM_TYPES] = {[IR_TYPE_VEC3] = "float3"};
    static const struct lang_form forms[IR_NUM_OPS] = {
        [IR_REM] = {"rem($0, $1)", LANG_PREC_POSTFIX, false},
        [IR_MIX] = {"lerp($0, $1, $2)", LANG_PREC_POSTFIX, false},
        [IR_RSQRT] = {"1.0f / sqrt($0)", LANG_PREC_PRODUCT, false},
        [IR_MOD] = {"$0 - $1 * floor($0 / $1)", LANG_PREC_SUM, false},
    };
    static const char *const phrases[NUM_PHRASES] = {[PHRASE_PARAM_IN] = "const $T $N"};
    const struct lang_syntax target = {
        .name = "target",
        .base = &lang_syntax_portable,
        .type_names = type_names,
        .forms = forms,
        .reserved = reserved,
        .num_reserved = 3,
        .phrases = phrases,
        .infinity = "INFINITY",
        .nan = "NAN",
        .float_suffix = "f",
        .array_braces = true,
    };
    const struct lang_names names = {.function = other_name};
    struct fixture f;
    setup(&f, "float g(float x) { return x; }\n"
              "vec3 f(vec3 sample, int half_, int helper, float x, sampler2D map) {\n"
              "    int half = half_; half %= 3; x = mod(x + 1.0, 2.0) * inversesqrt(x);\n"
              "    float a[2] = float[2](1.0, g(x));\n"
              "    return mix(sample, vec3(x, a[1], 2.0), float(half + helper)); }\n");
    REQUIRE_STR(print_function(&f, &target, &names, find(&f, "f")),
                "float3 helper(const float3 sample_, const int half_, const int helper_, float x, "
                "sampler2D map)\n{\n"
                "    int half_2 = half_;\n"
                "    half_2 = rem(half_2, 3);\n"
                "    x = ((x + 1.0f) - 2.0f * floor((x + 1.0f) / 2.0f)) * (1.0f / sqrt(x));\n"
                "    float a[2] = {1.0f, helper(x)};\n"
                "    return lerp(sample_, float3(x, a[1], 2.0f), float(half_2 + helper_));\n}\n");
    teardown(&f);
}

static const char *other_type(void *user_data, ir_type_id type)
{
    (void)user_data, (void)type;
    return "Other";
}

/*
 * A text that an image holds is taken from there, as long as all of its names are those of the
 * source.
 */
static void test_print_from_image(void)
{
    struct fixture f;
    setup(&f, "float tiny(float x) { return x * 2.0; }\n"
              "float helper(float x) { float y = x * x + 1.0; return y * y * (x - 3.0); }\n"
              "float f(float x) { return helper(x) * helper(x + 1.0) - x * x * x; }\n"
              "struct Ray { vec3 from; vec3 to; }; float reach(Ray ray) { return length(ray.to - "
              "ray.from) * 2.0 + ray.to.x; }\n"
              "float slope(float x) { return dFdx(x) * dFdx(x) + dFdy(x) * dFdy(x); }\n");
    struct lang_syntax shared = lang_syntax_portable, lonely;
    shared.in_images = true;
    lonely = shared;
    lonely.without_neighbours = true;
    lang_make_canonical(&f.library);
    const char *tiny = print_function(&f, &shared, NULL, find(&f, "tiny"));
    const char *tree = print_function(&f, &shared, NULL, find(&f, "f")),
               *slope = print_function(&f, &shared, NULL, find(&f, "slope"));
    lang_make_texts(&f.library, &shared, &f.arena);
    REQUIRE_STR(print_function(&f, &shared, NULL, find(&f, "f")), tree);
    REQUIRE_STR(print_function(&f, &shared, NULL, find(&f, "slope")), slope);
    for (uint32_t i = 0; i < f.library.text_bytes.len; i++)
        if (f.library.text_bytes.items[i] == ';') /* shows which is the text of the image */
            f.library.text_bytes.items[i] = '@';
    REQUIRE(strchr(print_function(&f, &shared, NULL, find(&f, "f")), '@'));
    REQUIRE(strchr(print_function(&f, &shared, NULL, find(&f, "slope")), '@'));
    REQUIRE(strchr(print_function(&f, &lonely, NULL, find(&f, "f")), '@'));
    REQUIRE_STR(print_function(&f, &lonely, NULL, find(&f, "slope")), slope);
    /* nobody calls it: it is not held */
    REQUIRE_STR(print_function(&f, &shared, NULL, find(&f, "tiny")), tiny);
    REQUIRE_STR(print_function(&f, &lang_syntax_portable, NULL, find(&f, "f")), tree);
    struct lang_names names = {.function = other_name};
    const char *renamed = print_function(&f, &shared, &names, find(&f, "f"));
    REQUIRE(strstr(renamed, "float helper(float x)") && !strchr(renamed, '@'));
    REQUIRE(strchr(print_function(&f, &shared, NULL, find(&f, "reach")), '@'));
    names = (struct lang_names){.user_type = other_type};
    const char *retyped = print_function(&f, &shared, &names, find(&f, "reach"));
    REQUIRE(strstr(retyped, "float reach(Other ray)") && !strchr(retyped, '@'));
    teardown(&f);
}

/* Reaching */

static void test_reach(void)
{
    struct fixture f;
    setup(&f, "uniform float u_a; uniform float u_b;\n"
              "float low(float x) { return x + u_a; }\nfloat left(float x) { return low(x); }\n"
              "float unused(float x) { return x * u_b; }\n"
              "float right(float x) { return low(x) * 2.0; }\nfloat top(float x) { return right(x) "
              "+ left(x); }\n");
    struct lang_reach reach = {.arena = &f.arena};
    lang_reach_add(&reach, &f.generated, find(&f, "left"));
    lang_reach_add(&reach, &f.generated, find(&f, "top"));
    lang_reach_add(&reach, &f.generated, find(&f, "low"));
    const char *const expected[] = {"low", "left", "right", "top"};
    REQUIRE_EQ(reach.functions.len, 4);
    for (uint32_t i = 0; i < 4 && i < reach.functions.len; i++)
        REQUIRE_EQ(reach.functions.items[i], find(&f, expected[i]));
    REQUIRE_EQ(reach.globals.len, 1);
    teardown(&f);
}

/* Evaluating */

static bool evaluate(struct fixture *f, const char *name, const struct ir_value *args,
                     struct ir_value *results, uint32_t steps)
{
    return lang_eval_call(&f->generated, find(f, name), args, results, &steps, &f->arena);
}

static bool is_near(float a, double b)
{
    return fabs((double)a - b) <= 1e-5 * (1.0 + fabs(b));
}

static const char eval_source[] =
    "const int primes[4] = int[4](2, 3, 5, 7);\n"
    "uniform float u_x;\n"
    "const int option_a = 1;\n"
    "struct Pair { vec2 a; float b[2]; };\n"
    "float fresnel(float c, float ior) {\n"
    "    float g = sqrt(max(ior * ior + c * c - 1.0, 0.0));\n"
    "    float s = (g - c) / (g + c);\n"
    "    float t = ((g + c) * c - 1.0) / ((g - c) * c + 1.0);\n"
    "    return 0.5 * s * s * (1.0 + t * t); }\n"
    "int collatz(int n) { int steps = 0;\n"
    "    while (n != 1) { if ((n & 1) == 0) { n /= 2; } else { n = 3 * n + 1; } ++steps; } return "
    "steps; }\n"
    "int nested(int n) { int sum = 0;\n"
    "    for (int i = 0; i < n; ++i) { if (i == 2) continue; for (int j = 0; ; ++j) { if (j >= i) "
    "break; sum += primes[j & 3]; } }\n"
    "    return sum; }\n"
    "int once(int n) { do { n += 10; if (n > 15) break; } while (n < 100); return n; }\n"
    "void swap(inout float a, inout float b) { float t = a; a = b; b = t; }\n"
    "float parts(float x) { Pair p = Pair(vec2(x, 2.0 * x), float[2](3.0, 4.0)); Pair q = p;\n"
    "    q.a.yx = p.a; swap(q.a.x, q.b[1]); q.b[0] *= 10.0; mat2 m = mat2(1.0); m[1].x = 5.0; "
    "m[0][1] += 7.0;\n"
    "    return q.a.x + 100.0 * q.a.y + q.b[0] + 1000.0 * q.b[1] + 10000.0 * (m[1][0] + m[0].y); "
    "}\n"
    "vec3 outs(float x, out vec2 o, inout int n) { o = vec2(x, -x); n = n * n; return vec3(o, "
    "float(n)); }\n"
    "float undefined(bool set) { float x; if (set) x = 1.0; return x; }\n"
    "float reads() { return u_x; }\n"
    "int reads_option() { return option_a; }\n"
    "float outside(int i) { float a[2] = float[2](1.0, 2.0); return a[i]; }\n"
    "int divides(int i) { return 1 / i; }\n"
    "bool lazy(int i) { return i == 0 || 1 / i == 1; }\n"
    "int chooses(int i) { return i == 0 ? 5 : 10 / i; }\n"
    "bool known(string s) { return s == \"yes\"; }\n";

static void test_eval_values(struct fixture *f)
{
    struct ir_value args[3] = {ir_value_float(0.5f), ir_value_float(1.5f)}, out[3];
    /* c = 0.5, n = 1.5: sin t = sin 60° / 1.5, the Fresnel equations by angles give 0.0891867 */
    REQUIRE(evaluate(f, "fresnel", args, out, 1000) && is_near(out[0].w[0].f, 0.08918669));
    args[0] = ir_value_int(27);
    REQUIRE(evaluate(f, "collatz", args, out, 10000) && out[0].w[0].i == 111);
    args[0] = ir_value_int(6); /* i = 1: 2; 3: 2+3+5; 4: 2+3+5+7; 5: 2+3+5+7+2 */
    REQUIRE(evaluate(f, "nested", args, out, 10000) && out[0].w[0].i == 2 + 10 + 17 + 19);
    args[0] = ir_value_int(1);
    REQUIRE(evaluate(f, "once", args, out, 1000) && out[0].w[0].i == 21);
    /* q.a = (2, 1) → swapped (4, 1), q.b = (30, 2); m[1].x = 5, m[0].y = 7 */
    args[0] = ir_value_float(1.0f);
    REQUIRE(evaluate(f, "parts", args, out, 1000)
            && is_near(out[0].w[0].f, 4.0 + 100.0 + 30.0 + 2000.0 + 120000.0));
    args[0] = ir_value_float(2.0f);
    args[1] = ir_value_int(3);
    REQUIRE(evaluate(f, "outs", args, out, 1000));
    REQUIRE(out[0].type == IR_TYPE_VEC3 && is_near(out[0].w[1].f, -2.0)
            && is_near(out[0].w[2].f, 9.0));
    REQUIRE(out[1].type == IR_TYPE_VEC2 && is_near(out[1].w[0].f, 2.0) && out[2].type == IR_TYPE_INT
            && out[2].w[0].i == 9);
    args[0] = ir_value_int(0);
    REQUIRE(evaluate(f, "lazy", args, out, 100) && out[0].w[0].u == 1);
    REQUIRE(evaluate(f, "chooses", args, out, 100) && out[0].w[0].i == 5);
    args[0] =
        (struct ir_value){.type = IR_TYPE_STRING, .w = {{.u = str_intern_z(&f->strings, "yes")}}};
    REQUIRE(evaluate(f, "known", args, out, 100) && out[0].w[0].u == 1);
}

static void test_eval_refusals(struct fixture *f)
{
    struct ir_value args[2] = {ir_value_bool(true)}, out[3];
    REQUIRE(evaluate(f, "undefined", args, out, 100));
    args[0] = ir_value_bool(false);
    REQUIRE(!evaluate(f, "undefined", args, out, 100));
    REQUIRE(!evaluate(f, "reads", NULL, out, 100));
    REQUIRE(!evaluate(f, "reads_option", NULL, out, 100));
    args[0] = ir_value_int(2);
    REQUIRE(!evaluate(f, "outside", args, out, 100));
    args[0] = ir_value_int(0);
    REQUIRE(!evaluate(f, "divides", args, out, 100));
    REQUIRE(!evaluate(f, "collatz", args, out, 5000)); /* never comes to an end */
    args[0] = ir_value_int(27);
    REQUIRE(!evaluate(f, "collatz", args, out, 200));
}

static void test_eval(void)
{
    struct fixture f;
    setup(&f, eval_source);
    test_eval_values(&f);
    test_eval_refusals(&f);
    teardown(&f);
}

/* Specialising */

static ir_ref global_node(void *user_data, struct ir_graph *graph, const struct lang_unit *unit,
                          uint32_t global_id)
{
    struct fixture *f = user_data;
    const struct lang_global *global = lang_global(unit, global_id, NULL);
    if (global->kind == LANG_GLOBAL_OPTION)
        return ir_const_int(graph, f->option);
    enum ir_op op = global->type == IR_TYPE_SAMPLER ? IR_TEXTURE : IR_UNIFORM;
    return ir_build(graph, op, global->type, 100 + global_id, NULL, 0);
}

/*
 * "name=value;…" of scalars: f(loat), i(nt), b(ool), s(tring) by the parameter's type; a vector is
 * filled.
 */
static void read_binding(struct fixture *f, const char *text, const struct lang_slot *slot,
                         struct ir_value *out)
{
    const struct ir_type_info *info = ir_type_info(slot->type);
    *out = (struct ir_value){.type = slot->type};
    for (unsigned i = 0; i < info->components; i++) {
        float number = 0.0f;
        int integer = 0;
        sscanf(text, "%f", &number);
        sscanf(text, "%d", &integer);
        if (info->scalar == IR_TYPE_FLOAT)
            out->w[i].f = number;
        else if (info->scalar == IR_TYPE_STRING)
            out->w[i].u = str_intern(&f->strings, text, strcspn(text, ";"));
        else
            out->w[i].i = integer;
    }
}

/*
 * The version for a shader whose only call of a function has the constant arguments that
 * "name=value;…" names.
 */
static uint32_t specialise(struct fixture *f, uint32_t id, const char *bindings)
{
    const struct lang_unit *layer;
    const struct lang_function *fn = lang_function(&f->generated, id, &layer);
    struct ir_value values[16];
    const union ir_word *bound[16] = {0};
    for (uint32_t i = 0; i < fn->num_params; i++) {
        const struct lang_slot *slot = &layer->slots.items[fn->first_slot + i];
        const char *name = str_text(&f->strings, slot->name), *at = bindings;
        for (size_t len = strlen(name); *at; at += strcspn(at, ";"), at += *at == ';')
            if (strncmp(at, name, len) == 0 && at[len] == '=') {
                read_binding(f, at + len + 1, slot, &values[i]);
                bound[i] = values[i].w;
            }
    }
    f->generated.host = (struct lang_host){.user_data = f, .global = global_node};
    f->generated.graph = &f->graph;
    uint32_t call = lang_plan_call(&f->generated, id, bound);
    lang_plan_finish(&f->generated);
    return lang_plan_version(&f->generated, call);
}

static const char *numbered_name(void *user_data, uint32_t id)
{
    struct fixture *f = user_data;
    const struct lang_function *fn = lang_function(&f->generated, id, NULL);
    if (id < f->generated.base_functions)
        return NULL;
    struct text text;
    text_init(&text, &f->arena);
    text_fmt(&text, "%s%u", str_text(&f->strings, fn->name),
             (unsigned)(id - f->generated.base_functions));
    return text_cstr(&text);
}

/* A function and what it needs. */
static const char *text_with_callees(struct fixture *f, uint32_t id)
{
    struct lang_reach reach = {.arena = &f->arena};
    lang_reach_add(&reach, &f->generated, id);
    struct lang_names names = {.user_data = f, .function = numbered_name};
    struct text text;
    text_init(&text, &f->arena);
    struct lang_style style;
    lang_style_init(&style, &lang_syntax_portable, &f->arena);
    for (uint32_t i = 0; i < reach.functions.len; i++)
        lang_print_function(&style, &names, &f->generated, reach.functions.items[i], &text);
    return text_cstr(&text);
}

/* "specialise NAME BINDINGS" */
static void specialises(struct fixture *f, const struct test_case *c)
{
    char name[32] = "", bindings[64] = "";
    sscanf(c->words, "%*s %31s %63s", name, bindings);
    REQUIRE_STR(text_with_callees(f, specialise(f, find(f, name), bindings)), c->out);
}

static void test_dropped_params(void)
{
    struct fixture f;
    setup(&f, "float f(float a, float b, float c, float d) { return a * b + d; }");
    uint32_t id = find(&f, "f"), version = specialise(&f, id, "b=0");
    const bool gone[4] = {true, true, true, false};
    for (unsigned i = 0; i < 4; i++)
        REQUIRE_EQ(lang_param_dropped(&f.generated, version, id, i), gone[i]);
    REQUIRE(!lang_param_dropped(&f.generated, id, id, 2));
    REQUIRE_EQ(f.generated.versions.items[version - f.generated.base_functions].origin, id);
    teardown(&f);
}

/* Lowering */

/*
 * An argument: a number fills the type's components, "_" is absent, anything else is a uniform with
 * that number.
 */
static ir_ref argument(struct fixture *f, ir_type_id type, const char *text, uint32_t number)
{
    float value;
    if (strcmp(text, "_") == 0)
        return 0;
    if (type == IR_TYPE_STRING)
        return ir_const_string(&f->graph, str_intern_z(&f->strings, text));
    if (sscanf(text, "%f", &value) == 1 && type == IR_TYPE_INT)
        return ir_const_int(&f->graph, (int32_t)value);
    if (sscanf(text, "%f", &value) == 1 && type == IR_TYPE_BOOL)
        return ir_const_bool(&f->graph, value != 0.0f);
    if (sscanf(text, "%f", &value) == 1)
        return ir_type_info(type)->components > 1 ? ir_const_splat(&f->graph, type, value)
                                                  : ir_const_float(&f->graph, value);
    return ir_build(&f->graph, type == IR_TYPE_SAMPLER ? IR_TEXTURE : IR_UNIFORM, type, number,
                    NULL, 0);
}

static const char *lower(struct fixture *f, uint32_t id, uint32_t max_inline,
                         const char *const *args)
{
    const struct lang_unit *layer;
    const struct lang_function *fn = lang_function(&f->generated, id, &layer);
    struct lang_host host = {.user_data = f, .global = global_node, .max_inline_nodes = max_inline};
    ir_ref refs[16] = {0}, results[8];
    unsigned num_refs = 0;
    for (uint32_t i = 0; i < fn->num_params; i++) {
        const struct lang_slot *slot = &layer->slots.items[fn->first_slot + i];
        if (slot->mode != LANG_OUT) {
            refs[num_refs] = argument(f, slot->type, args[num_refs], num_refs);
            num_refs++;
        }
    }
    lang_lower_call(&f->generated, &f->graph, &host, id, refs, results);
    struct text text;
    text_init(&text, &f->arena);
    ir_print(&f->graph, results, lang_num_results(&f->generated, id), &text);
    return text_cstr(&text);
}

/* "lower NAME LIMIT ARGUMENTS" */
static void lowers(struct fixture *f, const struct test_case *c)
{
    char name[32] = "", words[4][16] = {""};
    unsigned max_inline = 0;
    sscanf(c->words, "%*s %31s %u %15s %15s %15s %15s", name, &max_inline, words[0], words[1],
           words[2], words[3]);
    const char *const args[] = {words[0], words[1], words[2], words[3]};
    REQUIRE_STR(lower(f, find(f, name), max_inline, args), c->out);
}

static void test_lower_expression(void)
{
    struct fixture f;
    setup(&f, "float twice(float x) { return 2.0 * x; }\n");
    struct lang_input inputs[2] = {{str_intern_z(&f.strings, "a"), IR_TYPE_FLOAT},
                                   {str_intern_z(&f.strings, "in"), IR_TYPE_VEC3}};
    const char *text = "{{in}} * twice({{a}}) + (false ? {{a}} : 1.0)";
    uint32_t id = lang_parse_expression(&f.generated, text, strlen(text), inputs, 2, IR_TYPE_VEC3,
                                        f.file, (struct diag_place){0}, &f.diags);
    if (REQUIRE(id != LANG_NONE))
        REQUIRE_STR(lower(&f, id, 24, (const char *const[]){"a", "in"}),
                    "%1 = uniform float\n"
                    "%2 = uniform vec3 @1\n"
                    "%3 = mul float %1, 2.0\n"
                    "%4 = mul vec3 %2, %3\n"
                    "%5 = add vec3 %4, vec3(1.0, 1.0, 1.0)\n"
                    "return %5\n");
    if (id != LANG_NONE)
        REQUIRE_STR(lower(&f, id, 24, (const char *const[]){"3", "2"}),
                    "return vec3(13.0, 13.0, 13.0)\n");
    teardown(&f);
}

/* The name of the youngest node with this op. */
static const char *name_of_last(const struct fixture *f, enum ir_op op)
{
    ir_ref ref = f->graph.nodes.len;
    while (--ref > 0 && ir_get(&f->graph, ref)->op != op)
        ;
    str_id name = ref ? ir_label(&f->graph, ref)->name : 0;
    return name ? str_text(&f->strings, name) : "";
}

/* A library has no variables with a single read and no calls of small functions; names stay. */
static void test_names_in_canonical_trees(void)
{
    struct fixture f;
    setup(&f, "float root_of(float a) { return sqrt(a); }\n"
              "float far(float x) { float mean = x * x; float tail = exp(mean);\n"
              "return root_of(tail) - 1.0; }\n");
    lang_make_canonical(&f.library);
    lower(&f, find(&f, "far"), 24, (const char *const[]){"x"});
    REQUIRE_STR(name_of_last(&f, IR_MUL), "mean");
    REQUIRE_STR(name_of_last(&f, IR_EXP), "tail");
    REQUIRE_STR(name_of_last(&f, IR_SQRT), "root_of");
    teardown(&f);
}

/* ---- Cases that stand in a file ---- */

static void run_case(const struct test_case *c)
{
    static const struct {
        const char *word;
        void (*run)(struct fixture *f, const struct test_case *c);
    } kinds[] = {{"print", prints}, {"specialise ", specialises}, {"lower ", lowers}};
    struct fixture f;
    unsigned num_runs = 0;
    setup(&f, c->in);
    f.option = 1;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (strncmp(c->words, kinds[i].word, strlen(kinds[i].word)) == 0) {
            kinds[i].run(&f, c);
            num_runs++;
        }
    REQUIRE_EQ(num_runs, 1);
    teardown(&f);
}

/* The argument is the path of lang.txt. */
int main(int argc, char **argv)
{
    test_cases(argc > 1 ? argv[1] : NULL, run_case);
    test_print_types();
    test_print_target();
    test_print_from_image();
    test_reach();
    test_eval();
    test_dropped_params();
    test_lower_expression();
    test_names_in_canonical_trees();
    return test_report("lang");
}
