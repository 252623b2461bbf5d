// SPDX-License-Identifier: Apache-2.0
/*
 * The back half of the language: printing, reaching, evaluating, specialising and lowering what the
 * parser has read.
 */
#include "lower/lower.h"
#include "parse/parse.h"
#include "print/print.h"
#include "specialise/specialise.h"
#include "tree/eval.h"
#include "tree/reach.h"

#include "one_file.h"
#include "test.h"

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

/* What is read is printed as it stands here. */
static void prints_as(const char *source)
{
    struct fixture f;
    setup(&f, source);
    struct text text;
    text_init(&text, &f.arena);
    for (uint32_t i = 0; i < f.library.functions.len; i++)
        text_str(&text, print_function(&f, &lang_syntax_portable, NULL, i));
    REQUIRE_STR(text_cstr(&text), source);
    teardown(&f);
}

static void test_print_expressions(void)
{
    prints_as("float f(float a, float b, float c)\n{\n"
              "    return a - (b - c) + a * (b + c) / (a * b) - -c;\n}\n");
    prints_as("float f(vec3 v, mat3 m, int i)\n{\n    return -(v.x + v.y) * m[i][2] + (-v).z + (v "
              "* m).xyz[i];\n}\n");
    prints_as(
        "bool f(int a, int b, bool c)\n{\n"
        "    return (a & 255) == b && !(c || a << 2 >= (b ^ ~a) % 7) ^^ (c ? a > b : a < b);\n}\n");
    prints_as("float f(float a, bool c)\n{\n    return (c ? a : 2.0) + (a < 1.0 ? 0.5 : c ? 1.0 : "
              "-1.0);\n}\n");
    prints_as("vec4 f(float a, uint u)\n{\n"
              "    return vec4(1.0, a, float(u + 5u), -1e-20) + mix(vec4(0.5), vec4(0.0, 1.0, 2.0, "
              "3.0), clamp(a, 0.0, 1.0));\n}\n");
    prints_as("mat3 f(mat4 m)\n{\n    return mat3(2.0) * mat3(m) + mat3(vec3(1.0, 2.0, 3.0), "
              "m[0].xyz, m[1].xyz);\n}\n");
    prints_as("bool f(string s)\n{\n    return s == \"a b\" || s != \"\";\n}\n");
    prints_as("float f(float x)\n{\n    return atan(x, 2.0) + atan(x) + pow(2.0, -x) * "
              "inversesqrt(abs(x));\n}\n");
}

static void test_print_statements(void)
{
    prints_as("float f(float a, out vec3 b, inout int n)\n{\n"
              "    if (a < 0.0)\n        return 1.0;\n    else if (a > 1.0)\n        return 2.0;\n "
              "   else\n        b = vec3(a);\n"
              "    if (n == 0) {\n        b.xy = b.yx;\n        ++n;\n    } else {\n        b[1] "
              "*= 2.0;\n    }\n"
              "    return a;\n}\n");
    prints_as("int f(int n)\n{\n    int sum = 0;\n"
              "    for (int i = 0; i < n; ++i)\n        sum += i;\n"
              "    for (int i = n; i > 0; i -= 2) {\n        if (i == 7)\n            continue;\n  "
              "      --sum;\n    }\n"
              "    while (sum > 100) {\n        sum >>= 1;\n        if (sum == 150)\n            "
              "break;\n    }\n"
              "    do {\n        ++sum;\n    } while (sum < 10);\n"
              "    for (;;) {\n        for (int j = 0; j < 2; ++j)\n            sum <<= 1;\n       "
              " if (sum > 0)\n            break;\n    }\n"
              "    return sum;\n}\n");
    prints_as("void f(out float x)\n{\n    x = 1.0;\n}\nfloat g()\n{\n    float y;\n    f(y);\n    "
              "return y;\n}\n");
    prints_as("float f(bool a, bool b)\n{\n    if (a) {\n        if (b)\n            return 1.0;\n "
              "   } else {\n        return 2.0;\n    }\n    return 3.0;\n}\n");
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
        .float_literals_need_suffix = true,
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
 * What an image holds as text is taken from there, as long as all of its names are those of the
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

static void specialises(const char *source, const char *name, const char *bindings,
                        const char *expected)
{
    struct fixture f;
    setup(&f, source);
    f.option = 1;
    REQUIRE_STR(text_with_callees(&f, specialise(&f, find(&f, name), bindings)), expected);
    teardown(&f);
}

static void test_specialise_values(void)
{
    specialises("const float K = 3.0; float f(float x, float y) { const float two = 2.0; float z = "
                "y * two + K; return x * z; }",
                "f", "y=1", "float f0(float x)\n{\n    return x * 5.0;\n}\n");
    specialises("vec3 f(vec3 v, float w) { return mix(v * w + (1.0 - w), vec3(0.25), 1.0 - w) * "
                "vec3(2.0); }",
                "f", "w=1", "vec3 f0(vec3 v)\n{\n    return v * 2.0;\n}\n");
    specialises("vec3 f(vec3 v, float w) { return v * w + vec3(1.0, 2.0, 3.0).zyx; }", "f", "w=0",
                "vec3 f0()\n{\n    return vec3(3.0, 2.0, 1.0);\n}\n");
    specialises("float f(float a, float b) { a += b; a *= 2.0; return a; }", "f", "a=1;b=2",
                "float f0()\n{\n    return 6.0;\n}\n");
    specialises("float f(float a, float b) { a += b; return a; }", "f", "a=1",
                "float f0(float b)\n{\n    float a = 1.0;\n    a += b;\n    return a;\n}\n");
    specialises("const float table[3] = float[3](1.0, 4.0, 9.0); float f(float x, int i) { float "
                "own[2] = float[2](5.0, 6.0);\n"
                "    return x * table[i] + own[i - 1]; }",
                "f", "i=2", "float f0(float x)\n{\n    return x * 9.0 + 6.0;\n}\n");
    specialises(
        "float f(float x, bool a, bool b) { return a && x > 0.0 || b && x < -1.0 ? x : 0.0; }", "f",
        "a=1;b=0", "float f0(float x)\n{\n    return x > 0.0 ? x : 0.0;\n}\n");
    specialises("float f(float x, float y) { return vec3(x + 1.0).y * vec3(y, 0.0, 0.0).z; }", "f",
                "",
                "float f0(float x, float y)\n{\n    return (x + 1.0) * vec3(y, 0.0, 0.0).z;\n}\n");
}

static void test_specialise_branches(void)
{
    const char *modes = "float f(float x, string mode) { float y = x;\n"
                        "    if (mode == \"clamp\") y = clamp(x, 0.0, 1.0); else if (mode == "
                        "\"mirror\") { float t = mod(x, 2.0); y = t > 1.0 ? 2.0 - t : t; }\n"
                        "    else return 0.0; return y * 2.0; }";
    specialises(
        modes, "f", "mode=clamp",
        "float f0(float x)\n{\n    float y = clamp(x, 0.0, 1.0);\n    return y * 2.0;\n}\n");
    specialises(modes, "f", "mode=mirror",
                "float f0(float x)\n{\n    float t = mod(x, 2.0);\n    float y = t > 1.0 ? 2.0 - t "
                ": t;\n    return y * 2.0;\n}\n");
    specialises(modes, "f", "mode=other", "float f0()\n{\n    return 0.0;\n}\n");
    specialises("float f(float x, bool early) { if (early) { x += 1.0; return x; } float y = x * "
                "2.0; return y; }",
                "f", "early=1", "float f0(float x)\n{\n    x += 1.0;\n    return x;\n}\n");
    specialises(
        "const int option_a = 0; float f(float x) { if (option_a == 1) return x; return x * 2.0; }",
        "f", "", "float f0(float x)\n{\n    return x;\n}\n");
    specialises("float f(float x, bool a) { float r; if (x > 0.0) { if (a) r = 1.0; else r = x; } "
                "else r = 1.0; return r; }",
                "f", "a=1", "float f0()\n{\n    return 1.0;\n}\n");
    specialises("float f(float x, bool a) { float r = 0.0; if (x > 0.0) { if (a) r = 1.0; } else { "
                "r = 2.0; } return r; }",
                "f", "a=0",
                "float f0(float x)\n{\n    float r = 0.0;\n    if (!(x > 0.0))\n        r = 2.0;\n "
                "   return r;\n}\n");
    specialises("float f(float x, bool a) { float x2 = x; if (a) { float t = x * x; x2 = t * t; } "
                "float t = x2 + x2; return t * t; }",
                "f", "a=1",
                "float f0(float x)\n{\n    float t = x * x;\n    float x2 = t * t;\n    float t_ = "
                "x2 + x2;\n    return t_ * t_;\n}\n");
}

/* The same condition holds where it is known, and does not where it may only turn out to hold. */
static void test_specialise_known(void)
{
    const char *round = "float f(vec2 a, float x) { return mx_known(a.x == a.y) ? x : x * a.y; }";
    specialises(round, "f", "a=2", "float f0(float x)\n{\n    return x;\n}\n");
    specialises(round, "f", "x=3", "float f0(vec2 a)\n{\n    return 3.0 * a.y;\n}\n");
}

static void test_specialise_loops(void)
{
    specialises(
        "float f(float x, int n, float w) { float sum = 0.0; float idle = 0.0; int count = 0;\n"
        "    for (int i = 0; i < n; ++i) { sum += x * w; idle += w; ++count; } if (count == 0) "
        "return 1.0; return sum; }",
        "f", "n=4;w=1",
        "float f0(float x)\n{\n    float sum = 0.0;\n    int count = 0;\n    for (int i = 0; i < "
        "4; ++i) {\n        sum += x;\n        ++count;\n    }\n"
        "    if (count == 0)\n        return 1.0;\n    return sum;\n}\n");
    specialises("float f(float x, int n) { for (int i = 0; i < n; ++i) x += 1.0; while (false) x = "
                "0.0; return x; }",
                "f", "n=0",
                "float f0(float x)\n{\n    for (int i = 0; i < 0; ++i)\n        x += 1.0;\n    "
                "return x;\n}\n");
    specialises("float f(float x) { float y = 2.0; float dead = 0.0; for (int i = 0; i < 3; ++i) { "
                "dead = x; } x *= y; return x; }",
                "f", "", "float f0(float x)\n{\n    x *= 2.0;\n    return x;\n}\n");
    specialises("float f(float x) { int i = 0; for (int k = 0; k < 3; ++k) { x += float(i); "
                "for (i = 5; x < 0.0;) x += 1.0; } return x; }",
                "f", "",
                "float f(float x)\n{\n    int i = 0;\n    for (int k = 0; k < 3; ++k) {\n"
                "        x += float(i);\n        for (i = 5; x < 0.0;)\n            x += 1.0;\n"
                "    }\n    return x;\n}\n");
    specialises("float f(float x, float w) { float k = 1.0; for (int i = 0; i < 3; ++i) { x *= k; "
                "if (x > w) { k = 2.0; continue; } x += 1.0; } return x; }",
                "f", "w=5",
                "float f0(float x)\n{\n    float k = 1.0;\n    for (int i = 0; i < 3; ++i) {\n     "
                "   x *= k;\n        if (x > 5.0) {\n            k = 2.0;\n"
                "            continue;\n        }\n        x += 1.0;\n    }\n    return x;\n}\n");
}

static void test_specialise_calls(void)
{
    specialises(
        "float film(float c, float d) { return cos(c * d); } float plain(float c) { float s = c * "
        "c; return s + s; }\n"
        "float fresnel(float c, float d) { if (d > 0.0) return film(c, d); return plain(c); }\n"
        "float f(float c, float d) { return fresnel(c, d) + fresnel(1.0, d) * fresnel(c, 0.0); }",
        "f", "d=0",
        "float plain(float c)\n{\n    float s = c * c;\n    return s + s;\n}\n"
        "float f1(float c)\n{\n    return plain(c) + 2.0 * plain(c);\n}\n");
    specialises("float g(float x, out float y) { y = x * 2.0; return x + 1.0; }\n"
                "float f(float x, float w) { float a; float b = g(x, a); float c; float d = g(b, "
                "c); return a * w + d; }",
                "f", "w=0",
                "float g(float x, out float y)\n{\n    y = x * 2.0;\n    return x + 1.0;\n}\n"
                "float f0(float x)\n{\n    float a;\n    float b = g(x, a);\n    float c;\n    "
                "float d = g(b, c);\n    return d;\n}\n");
    specialises("float g(float x, out float y) { y = x * 2.0; return x + 1.0; }\n"
                "float f(float x, float w) { float a; float b = g(x, a); return a + w * b; }",
                "f", "w=0",
                "float g(float x, out float y)\n{\n    y = x * 2.0;\n    return x + 1.0;\n}\n"
                "float f0(float x)\n{\n    float a;\n    g(x, a);\n    return a;\n}\n");
    specialises("vec3 g(vec3 c, vec3 x) { return c * x + c; } vec3 f(vec3 x) { return g(vec3(1.0, "
                "2.0, 3.0), x); }",
                "f", "",
                "vec3 g0(vec3 x)\n{\n    vec3 c = vec3(1.0, 2.0, 3.0);\n    return c * x + "
                "c;\n}\nvec3 f1(vec3 x)\n{\n    return g0(x);\n}\n");
    specialises("float g(float a, float unused) { float s = a * a; return s + s; } float f(float "
                "x, float y) { return g(x, y * y); }",
                "f", "",
                "float g0(float a)\n{\n    float s = a * a;\n    return s + s;\n}\nfloat f1(float "
                "x)\n{\n    return g0(x);\n}\n");
}

/*
 * A parameter is bound where all calls agree, through callers as well; a flag makes a version of
 * its own.
 */
static void test_plan(void)
{
    specialises(
        "float g(float x, float k, float c) { float s = sin(x * k); return s * s + c; }\n"
        "float h(float x, float c) { float t = g(x, 4.0, c); return t * t; }\n"
        "float f(float x, float c) { return g(x, 2.0, 0.0) + g(x + 1.0, 3.0, c) + h(x, c); }",
        "f", "c=0",
        "float g0(float x, float k)\n{\n    float s = sin(x * k);\n    return s * s;\n}\n"
        "float h1(float x)\n{\n    float t = g0(x, 4.0);\n    return t * t;\n}\n"
        "float f2(float x)\n{\n    return g0(x, 2.0) + g0(x + 1.0, 3.0) + h1(x);\n}\n");
    specialises(
        "float g(float x, bool twice) { float s = x * x; if (twice) s *= 2.0; return s + sin(s); "
        "}\n"
        "float f(float x) { return g(x, true) + g(x, false) + g(x + 1.0, true); }",
        "f", "",
        "float g0(float x)\n{\n    float s = x * x;\n    s *= 2.0;\n    return s + sin(s);\n}\n"
        "float g1(float x)\n{\n    float s = x * x;\n    return s + sin(s);\n}\n"
        "float f2(float x)\n{\n    return g0(x) + g1(x) + g0(x + 1.0);\n}\n");
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
 * An argument: a number fills the type's components, "" is absent, anything else is a uniform with
 * that number.
 */
static ir_ref argument(struct fixture *f, ir_type_id type, const char *text, uint32_t number)
{
    float value;
    if (!*text)
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

static void lowers(const char *source, const char *name, uint32_t max_inline,
                   const char *const *args, const char *expected)
{
    struct fixture f;
    setup(&f, source);
    f.option = 1;
    REQUIRE_STR(lower(&f, find(&f, name), max_inline, args), expected);
    teardown(&f);
}

#define ARGS(...) \
    (const char *const[]) \
    { \
        __VA_ARGS__, NULL \
    }

static void test_lower_straight(void)
{
    lowers("float f(float x, float y) { float z = x * 2.0; z += y; return z * z; }", "f", 24,
           ARGS("x", "y"),
           "%1 = uniform float\n"
           "%2 = uniform float @1\n"
           "%3 = mul float %1, 2.0\n"
           "%4 = add float %2, %3\n"
           "%5 = mul float %4, %4\n"
           "return %5\n");
    lowers("vec3 f(vec3 v, float s) { v.xz = v.zx * s; v[1] = 0.0; return v; }", "f", 24,
           ARGS("v", "2"),
           "%1 = uniform vec3\n"
           "%2 = swizzle vec2 .zx %1\n"
           "%3 = mul vec2 %2, 2.0\n"
           "%4 = swizzle float .x %3\n"
           "%5 = swizzle float .y %3\n"
           "%6 = construct vec3 %4, 0.0, %5\n"
           "return %6\n");
    lowers("vec2 f(float s, out float twice, inout int n) { twice = s + s; ++n; return vec2(s, "
           "twice); }",
           "f", 24, ARGS("s", "n"),
           "%1 = uniform float\n"
           "%2 = uniform int @1\n"
           "%3 = add float %1, %1\n"
           "%4 = add int %2, 1\n"
           "%5 = construct vec2 %1, %3\n"
           "return %5, %3, %4\n");
    lowers("struct P { vec2 a; float b; }; P make(float x) { P p; p.a = vec2(x, 1.0); p.b = x; "
           "p.a.y = p.b; return p; }\n"
           "float f(float x) { P p = make(x); P q = p; q.b += p.a.y; return q.b; }",
           "f", 40, ARGS("x"),
           "%1 = uniform float\n"
           "%2 = add float %1, %1\n"
           "return %2\n");
    lowers("const float t[3] = float[3](1.0, 2.0, 4.0); float f(float x, int i) { float a[2]; a[0] "
           "= x; a[1] = t[i]; return a[0] * a[i - 1]; }",
           "f", 40, ARGS("x", "2"),
           "%1 = uniform float\n"
           "%2 = mul float %1, 4.0\n"
           "return %2\n");
}

static void test_lower_branches(void)
{
    lowers("float f(float x, string mode) { if (mode == \"a\") return x + 1.0; if (mode == \"b\") "
           "{ return x * 2.0; } return x; }",
           "f", 40, ARGS("x", "b"),
           "%1 = uniform float\n"
           "%2 = mul float %1, 2.0\n"
           "return %2\n");
    lowers("float f(float x, float y) { if (y == 0.0) return x; return x / y; }", "f", 24,
           ARGS("x", "y"),
           "%1 = uniform float\n"
           "%2 = uniform float @1\n"
           "%3 = eq bool %2, 0.0\n"
           "%4 = div float %1, %2\n"
           "%5 = select float %3, %1, %4\n"
           "return %5\n");
    lowers("float f(float x, float y) { float r = x; if (y > 0.0) { r = x * y; } else if (y < "
           "-1.0) r = 2.0; return r + 1.0; }",
           "f", 40, ARGS("x", "y"),
           "%1 = uniform float\n"
           "%2 = uniform float @1\n"
           "%3 = gt bool %2, 0.0\n"
           "%4 = mul float %1, %2\n"
           "%5 = lt bool %2, -1.0\n"
           "%6 = select float %5, 2.0, %1\n"
           "%7 = select float %3, %4, %6\n"
           "%8 = add float %7, 1.0\n"
           "return %8\n");
    lowers("float f(float x, bool c) { return c ? x : 3.0; }", "f", 24, ARGS("", "0"),
           "return 3.0\n");
    lowers("const int option_a = 0; uniform float u_k; float f(float x) { if (option_a == 1) "
           "return u_k * x; return x; }",
           "f", 24, ARGS("x"),
           "%1 = uniform float\n"
           "%2 = uniform float @101\n"
           "%3 = mul float %1, %2\n"
           "return %3\n");
    lowers("void f(float x, out float y) { y = 1.0; if (x > 0.0) return; y = x; }", "f", 24,
           ARGS("x"),
           "%1 = uniform float\n"
           "%2 = gt bool %1, 0.0\n"
           "%3 = select float %2, 1.0, %1\n"
           "return %3\n");
}

/* A call in a branch stays in its function, though there be an equal one already. */
static void test_lower_call_in_branch(void)
{
    lowers("float sum(float x) { float s = 0.0; for (int i = 0; i < 3; ++i) s += x; return s; }\n"
           "float h(float x) { if (x > 0.0) return sum(x); return x; }\n"
           "float f(float x) { return sum(x) + h(x); }",
           "f", 24, ARGS("x"),
           "callee \"sum\" function 0 pure\n"
           "callee \"h\" function 1 pure\n"
           "%1 = uniform float\n"
           "%2 = call float %1\n"
           "%3 = call float @1 %1\n"
           "%4 = add float %2, %3\n"
           "return %4\n");
}

static void test_lower_calls(void)
{
    const char *texture_source = "vec4 f(sampler2D map, vec2 uv, bool on) { if (on) return "
                                 "texture(map, uv); return vec4(0.0); }";
    lowers(texture_source, "f", 24, ARGS("map", "uv", "1"),
           "%1 = texture_input sampler2D\n"
           "%2 = uniform vec2 @1\n"
           "%3 = texture vec4 %1, %2\n"
           "return %3\n");
    lowers(texture_source, "f", 24, ARGS("map", "uv", "on"),
           "callee \"f\" function 0 derivative\n"
           "%1 = texture_input sampler2D\n"
           "%2 = uniform vec2 @1\n"
           "%3 = uniform bool @2\n"
           "%4 = call vec4 %1, %2, %3\n"
           "return %4\n");
    lowers("float sum(float x, int n) { float s = 0.0; for (int i = 0; i < n; ++i) s += x; return "
           "s; }\n"
           "float f(float x) { return sum(x, 3) + sum(2.0, 3); }",
           "f", 24, ARGS("x"),
           "callee \"sum\" function 0 pure\n"
           "%1 = uniform float\n"
           "%2 = call float %1, 3\n"
           "%3 = add float %2, 6.0\n"
           "return %3\n");
    lowers("vec2 big(vec2 x, float k, out float y, bool b) { y = k; for (int i = 0; i < 3; ++i) x "
           "+= k; return b ? x.yx : x; }",
           "big", 0, ARGS("x", "k", "1"),
           "callee \"big\" function 0 pure\n"
           "%1 = uniform vec2\n"
           "%2 = uniform float @1\n"
           "%3 = call vec2 %1, %2, true\n"
           "%4 = result vec2 %3\n"
           "%5 = result float @1 %3\n"
           "return %4, %5\n");
    lowers("float f(float x, float y) { return sin(x) * cos(y) + sin(y) * cos(x) + sqrt(x); }", "f",
           4, ARGS("x", "y"),
           "callee \"f\" function 0 pure\n"
           "%1 = uniform float\n"
           "%2 = uniform float @1\n"
           "%3 = call float %1, %2\n"
           "return %3\n");
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
        REQUIRE_STR(lower(&f, id, 24, ARGS("a", "in")), "%1 = uniform float\n"
                                                        "%2 = uniform vec3 @1\n"
                                                        "%3 = mul float %1, 2.0\n"
                                                        "%4 = mul vec3 %2, %3\n"
                                                        "%5 = add vec3 %4, vec3(1.0, 1.0, 1.0)\n"
                                                        "return %5\n");
    if (id != LANG_NONE)
        REQUIRE_STR(lower(&f, id, 24, ARGS("3", "2")), "return vec3(13.0, 13.0, 13.0)\n");
    teardown(&f);
}

int main(void)
{
    test_print_expressions();
    test_print_statements();
    test_print_types();
    test_print_target();
    test_print_from_image();
    test_reach();
    test_eval();
    test_specialise_values();
    test_specialise_branches();
    test_specialise_known();
    test_specialise_loops();
    test_specialise_calls();
    test_plan();
    test_dropped_params();
    test_lower_straight();
    test_lower_branches();
    test_lower_call_in_branch();
    test_lower_calls();
    test_lower_expression();
    return test_report("lang");
}
