// SPDX-License-Identifier: Apache-2.0
/*
 * The table of a language: functions and stages in a language that differs from GLSL in every entry
 * (toy/toy.c).
 */
#include "shader_fixture.h"
#include "test.h"

#include "spell/spell.h"

extern const struct lang_syntax toy_syntax;
extern const struct target target_toy;

/* A new entry needs a text of its own in the toy, so that the tests below see it. */
static void test_differs(void)
{
    const struct lang_syntax *glsl = target_find("glsl")->syntax;
    for (int i = 0; i < NUM_PHRASES; i++) {
        const char *own = lang_syntax_phrase(&toy_syntax, (enum lang_phrase)i),
                   *other = lang_syntax_phrase(glsl, (enum lang_phrase)i);
        if (!REQUIRE(own && (!other || strcmp(own, other) != 0)))
            printf("    phrase %d: %s\n", i, own ? own : "none");
    }
    REQUIRE(toy_syntax.one_per_declaration != glsl->one_per_declaration);
    REQUIRE(toy_syntax.always_braces != glsl->always_braces);
    REQUIRE(toy_syntax.no_directives != glsl->no_directives);
    REQUIRE(toy_syntax.copies_params != glsl->copies_params);
    REQUIRE(toy_syntax.exact_constructors != glsl->exact_constructors);
    REQUIRE(toy_syntax.splat.text && !glsl->splat.text);
    REQUIRE(toy_syntax.block_bool && !glsl->block_bool);
    REQUIRE(toy_syntax.sampler_type && !glsl->sampler_type);
    REQUIRE((target_toy.caps ^ target_find("vulkan")->caps) & CAP_OVERLOADS);
    REQUIRE((target_toy.caps ^ target_find("vulkan")->caps) & CAP_SAMPLER_BINDINGS);
}

static const char *print_by(struct fixture *f, const struct lang_syntax *syntax, const char *called)
{
    struct lang_style style;
    struct text text;
    lang_style_init(&style, syntax, &f->arena);
    text_init(&text, &f->arena);
    lang_print_results(&style, NULL, &f->unit, function(f, called), &text);
    lang_print_function(&style, NULL, &f->unit, function(f, called), &text);
    return text_cstr(&text);
}

static const char *print(struct fixture *f, const char *called)
{
    return print_by(f, &toy_syntax, called);
}

static const char source[] =
    "const float weights[2] = float[2](0.5, 2.0);\n"
    "struct Ray { vec3 from; float at[2]; };\n"
    "void split(vec3 v, out float x, inout float y) { x = v.x; y += x; }\n"
    "void read(sampler2D map, vec2 uv, out vec4 texel) { texel = texture(map, uv); }\n"
    "float f(float a, vec4 v, out float total, inout Ray ray, sampler2D map, int n) {\n"
    "    float part, own[2]; vec4 texel; const float near = 1.0;\n"
    "    split(vec3(v), part, total); split(vec3(a), total, ray.from.x);\n"
    "    read(map, vec2(v), texel);\n"
    "    for (int i = 0; i < 2; ++i) total += weights[i];\n"
    "    for (;;) { if (total > 9.0) break; else --n; }\n"
    "    while (total > 4.0) total *= 0.5;\n"
    "    do { a -= 1.0; } while (a > 0.0);\n"
    "    own[0] = float(n); ray.at[1] = part + own[0]; mat2 m = mat2(a);\n"
    "    vec3 all = vec3(part, v);\n"
    "    return m[0].x + all.y + texel.x; }\n"
    "float[2] pair(float x) { return float[2](x, 1.0); }\n";

static void test_functions(void)
{
    struct fixture f;
    fixture_open(&f, source);
    REQUIRE_STR(print(&f, "split"), "fn split(in v: f32x3, x: ptr<f32>, y: ptr<f32, both>)\n{\n"
                                    "    (*x) = v.x;\n    (*y) += (*x);\n}\n");
    REQUIRE_STR(print(&f, "read"),
                "fn read(map: texture, map_sampler: sampler, in uv: f32x2, texel: ptr<f32x4>)\n{\n"
                "    (*texel) = sample(map, map_sampler, uv);\n}\n");
    REQUIRE_STR(
        print(&f, "f"),
        "fn f(copy a_in: f32, in v: f32x4, total: ptr<f32>, ray: ptr<Ray, both>, map: texture, "
        "map_sampler: sampler, copy n_in: i32) -> f32\n{\n"
        "    var a: f32 = a_in;\n"
        "    var n: i32 = n_in;\n"
        "    var part: f32;\n"
        "    var own: array<f32, 2>;\n"
        "    var texel: f32x4;\n"
        "    val near: f32 = 1.0;\n"
        "    split(v.xyz, &part, total);\n"
        "    split(splat<f32x3>(a), total, &(*ray).from.x);\n"
        "    read(map, map_sampler, v.xy, &texel);\n"
        "    loop (var i: i32 = 0 | i < 2 | i++) {\n        (*total) += weights[i];\n    }\n"
        "    loop ( | |) {\n        if ((*total) > 9.0) {\n            break;\n        } else {\n"
        "            n--;\n        }\n    }\n"
        "    loop while ((*total) > 4.0) {\n        (*total) *= 0.5;\n    }\n"
        "    loop {\n        a -= 1.0;\n        until !(a > 0.0); }\n"
        "    own[0] = convert<f32>(n);\n"
        "    (*ray).at[1] = part + own[0];\n"
        "    val m: f32x2x2 = a * f32x2x2(1.0, 0.0, 0.0, 1.0);\n"
        "    val all: f32x3 = f32x3(part, v.xy);\n"
        "    return m[0].x + all.y + texel.x;\n}\n");
    REQUIRE_STR(print(&f, "pair"), "fn pair(in x: f32) -> array<f32, 2>\n{\n"
                                   "    return array<f32, 2>(x, 1.0);\n}\n");
    fixture_close(&f);
}

static void test_file_scope(void)
{
    struct fixture f;
    fixture_open(&f, source);
    struct lang_style style;
    struct text text;
    struct lang_reach reach = {.arena = &f.arena};
    lang_reach_add(&reach, &f.unit, function(&f, "f"));
    lang_style_init(&style, &toy_syntax, &f.arena);
    text_init(&text, &f.arena);
    lang_print_constant(&style, NULL, &f.unit, reach.globals.items[0], &text);
    lang_print_struct(&style, NULL, &f.unit, reach.user_types.items[0], &text);
    REQUIRE_STR(text_cstr(&text), "const weights: array<f32, 2> := array<f32, 2>(0.5, 2.0);\n"
                                  "struct Ray {\n    from: f32x3,\n    at: array<f32, 2>,\n}\n");
    fixture_close(&f);
}

/* ---- Stages ---- */

static const char functions[] =
    "uniform bool u_flipped;\n"
    "float twin(float x) { float y = 0.0; for (int i = 0; i < 3; ++i) y += x; return y; }\n"
    "float twin(vec2 x) { float y = u_flipped ? 1.0 : 0.0; for (int i = 0; i < 3; ++i) y += x.x; "
    "return y; }\n"
    "float both(float x) { float y = 0.0; for (int i = 0; i < 3; ++i) y += twin(x) + "
    "twin(vec2(x)); return y; }\n"
    "void split(vec3 a, out float x, out float y) { x = a.x; y = a.y; for (int i = 0; i < 2; ++i) "
    "y *= 2.0; }\n";

static const char *spell_toy(struct fixture *f)
{
    struct spell_mark *marks;
    uint32_t num_marks;
    struct text out;
    text_init(&out, &f->arena);
    f->shader.style = ARENA_NEW(&f->arena, struct lang_style);
    lang_style_init(f->shader.style, &toy_syntax, &f->arena);
    shader_finish(&f->shader, &(struct shader_layout_rules){
                                  .blocks = true, .bindings = true, .sampler_bindings = true});
    spell_shader_stage(&target_toy, &(struct spell_options){.interface = "complete"}, &f->shader,
                       STAGE_PIXEL, &f->arena, &out, &marks, &num_marks);
    return text_cstr(&out);
}

static bool has(const char *text, const char *part)
{
    bool found = strstr(text, part) != NULL;
    if (!found)
        printf("---- no\n%s\n---- in\n%s\n", part, text);
    return found;
}

/* Functions of one name get numbers, and so do the calls of them, in the graph and in functions. */
static void test_overloads(void)
{
    struct fixture f;
    fixture_open(&f, functions);
    ir_ref a = uniform(&f, "a", IR_TYPE_FLOAT), uv = uniform(&f, "uv", IR_TYPE_VEC2);
    effect(&f, EFFECT_VAR, f.color, vec3_of(&f, call(&f, "twin", &a, 1)));
    accumulate(&f, vec3_of(&f, call(&f, "twin", &uv, 1)));
    accumulate(&f, vec3_of(&f, call(&f, "both", &a, 1)));
    write_color(&f);
    const char *text = spell_toy(&f);
    REQUIRE(has(text, "fn twin(in x: f32) -> f32\n"));
    REQUIRE(has(text, "fn twin_2(in x: f32x2) -> f32\n"));
    REQUIRE(has(text, "y += twin(x) + twin_2(splat<f32x2>(x));\n"));
    REQUIRE(has(text, "    var color: f32x3 = splat<f32x3>(twin(a));\n"));
    REQUIRE(has(text, "    color += splat<f32x3>(twin_2(uv));\n"));
    REQUIRE(has(text, "    color += splat<f32x3>(both(a));\n"));
    fixture_close(&f);
}

/* A boolean is a number in a block, and converted where an expression or a function reads it. */
static void test_booleans(void)
{
    struct fixture f;
    fixture_open(&f, functions);
    ir_ref flag = uniform(&f, "walled", IR_TYPE_BOOL), v = uniform(&f, "v", IR_TYPE_VEC3),
           uv = uniform(&f, "uv", IR_TYPE_VEC2);
    effect(&f, EFFECT_VAR, f.color, vec3_of(&f, call(&f, "twin", &uv, 1)));
    effect(&f, EFFECT_IF, 0, flag);
    accumulate(&f, v);
    effect(&f, EFFECT_END, 0, 0);
    accumulate(&f,
               ir_op3(&f.graph, IR_SELECT, op1(&f, IR_NOT, flag), v, vec3_of(&f, number(&f, 1))));
    write_color(&f);
    const char *text = spell_toy(&f);
    REQUIRE(has(text, "walled: u32,\n"));
    REQUIRE(has(text, "u_flipped: u32,\n"));
    REQUIRE(has(text, "    if (walled != 0u) {\n        color += v;\n    }\n"));
    REQUIRE(has(text, "(u_flipped != 0u) ? 1.0 : 0.0"));
    REQUIRE(has(text, "    color += walled != 0u ? f32x3(1.0) : v;\n"));
    fixture_close(&f);
}

/* Results of calls, and of a function of the graph. */
static void test_results(void)
{
    struct fixture f;
    fixture_open(&f, functions);
    static const ir_type_id types[] = {IR_TYPE_VEC3};
    uint32_t inner = ir_add_function(&f.graph, word(&f, "inner"), types, 1);
    ir_ref p = ir_param(&f.graph, inner, 0), v = uniform(&f, "v", IR_TYPE_VEC3);
    ir_set_results(&f.graph, inner, (ir_ref[]){op1(&f, IR_NORMALIZE, p), op1(&f, IR_LENGTH, p)}, 2);
    name(&f, "deep");
    ir_ref deep = ir_build(&f.graph, IR_GRAPH_CALL, IR_TYPE_VEC3, inner, &v, 1);
    name(&f, "s");
    ir_ref s = call(&f, "split", &v, 1);
    f.graph.origin = 0;
    effect(&f, EFFECT_VAR, f.color, result(&f, deep, 0, IR_TYPE_VEC3));
    accumulate(&f, vec3_of(&f, result(&f, deep, 1, IR_TYPE_FLOAT)));
    accumulate(&f, vec3_of(&f, result(&f, s, 1, IR_TYPE_FLOAT)));
    accumulate(&f, vec3_of(&f, result(&f, s, 2, IR_TYPE_FLOAT)));
    write_color(&f);
    const char *text = spell_toy(&f);
    REQUIRE(
        has(text, "fn inner(in p0: f32x3, r1: ptr<f32>) -> f32x3\n{\n    (*r1) = length(p0);\n"));
    REQUIRE(
        has(text, "    var deep_result: f32;\n    val deep: f32x3 = inner(v, &deep_result);\n"));
    REQUIRE(has(text, "    var s_x: f32;\n    var s_y: f32;\n    split(v, &s_x, &s_y);\n"));
    fixture_close(&f);
}

static void test_bindings(void)
{
    struct fixture f;
    fixture_open(&f, NULL);
    ir_ref uv = uniform(&f, "uv", IR_TYPE_VEC2), color = 0;
    static const char *const names[] = {"first", "second"};
    for (unsigned i = 0; i < 2; i++) {
        ir_ref args[] = {uniform(&f, names[i], IR_TYPE_SAMPLER), uv};
        ir_ref texel = ir_build(&f.graph, IR_TEX, IR_TYPE_VEC4, 0, args, 2);
        color = color ? op2(&f, IR_ADD, color, texel) : texel;
    }
    effect(&f, EFFECT_OUTPUT, add_output(&f), color);
    const char *text = spell_toy(&f);
    REQUIRE(has(text, "@3 shared first: texture;\n@4 shared first_sampler: sampler;\n"
                      "@5 shared second: texture;\n@6 shared second_sampler: sampler;\n"));
    REQUIRE(has(text, "sample(first, first_sampler, uv) + sample(second, second_sampler, uv)"));
    fixture_close(&f);
}

/* A language whose functions have no parameters for results. */
static void test_results_in_struct(void)
{
    struct fixture f;
    struct lang_syntax syntax = toy_syntax;
    syntax.base = &toy_syntax;
    syntax.results_in_struct = true;
    syntax.reserved_prefix = "toy_";
    fixture_open(
        &f, "float both(float a, out float b, inout float c) { b = a; c += a; return 2.0 * a; }\n"
            "void none(out float b) { b = 1.0; }\n"
            "float use(float a) { float b, c = 0.0; none(b); if (both(a, b, c) > 1.0) b += both(c, "
            "c, b);\n"
            "    return b + c; }\n");
    const char *text = print_by(&f, &syntax, "both");
    REQUIRE(has(text, "struct toy_results_both {\n"));
    REQUIRE(has(text, "fn both(in a: f32, copy c: f32) -> toy_results_both\n{\n    var b: f32;\n"));
    REQUIRE(has(text, "    return toy_results_both(2.0 * a, b, c);\n"));
    REQUIRE(has(print_by(&f, &syntax, "none"), "    b = 1.0;\n    return toy_results_none(b);\n"));
    text = print_by(&f, &syntax, "use");
    REQUIRE(has(text,
                "    toy_results_none toy_r1 = none();\n    b = toy_r1.b;\n"
                "    toy_results_both toy_r2 = both(a, c);\n    b = toy_r2.b;\n    c = toy_r2.c;\n"
                "    if (toy_r2.value > 1.0) {\n"));
    REQUIRE(has(text, "        toy_results_both toy_r3 = both(c, b);\n        c = toy_r3.b;\n"
                      "        b = toy_r3.c;\n        b += toy_r3.value;\n"));
    fixture_close(&f);
}

/* In such a language, what a head evaluates more than once or not at all stands in the body. */
static void test_results_in_heads(void)
{
    struct fixture f;
    struct lang_syntax syntax = toy_syntax;
    syntax.base = &toy_syntax;
    syntax.results_in_struct = true;
    syntax.reserved_prefix = "toy_";
    syntax.always_braces = true;
    fixture_open(
        &f, "bool next(inout float a) { a += 1.0; return a < 8.0; }\n"
            "float logic(float x) { if (x > 0.0 && next(x)) x = 2.0; return x; }\n"
            "float chain(float x) { if (x > 0.0) x = 1.0; else if (next(x)) x = 2.0; return x; }\n"
            "float loops(float x) { while (next(x)) { if (x > 5.0) continue; x += 0.5; }\n"
            "    do { x -= 0.25; } while (next(x)); for (int i = 0; i < 3; next(x)) i++; return x; "
            "}\n");
    REQUIRE(has(print_by(&f, &syntax, "logic"),
                "    bool toy_r1 = x > 0.0;\n    if (toy_r1) {\n"
                "        toy_results_next toy_r2 = next(x);\n        x = toy_r2.a;\n"
                "        toy_r1 = toy_r2.value;\n    }\n    if (toy_r1) {\n        x = 2.0;\n"));
    REQUIRE(has(print_by(&f, &syntax, "chain"),
                "    } else {\n        toy_results_next toy_r1 = next(x);\n        x = toy_r1.a;\n"
                "        if (toy_r1.value) {\n"));
    const char *text = print_by(&f, &syntax, "loops");
    REQUIRE(has(text, "        while (true) {\n            toy_results_next toy_r1 = next(x);\n"
                      "            x = toy_r1.a;\n            if (!(toy_r1.value)) {\n"
                      "                break;\n            }\n            if (x > 5.0) {\n"));
    REQUIRE(has(text,
                "        bool toy_r2 = false;\n        while (true) {\n"
                "            if (toy_r2) {\n                toy_results_next toy_r3 = next(x);\n"
                "                x = toy_r3.a;\n                if (!(toy_r3.value)) {\n"));
    REQUIRE(has(text, "            toy_r2 = true;\n            x -= 0.25;\n"));
    REQUIRE(has(text, "        var i: i32 = 0;\n        bool toy_r4 = false;\n"));
    REQUIRE(has(text, "            toy_r4 = true;\n            if (!(i < 3)) {\n"));
    fixture_close(&f);
}

/* Names that begin as no name of the language does. */
static void test_beginnings(void)
{
    struct fixture f;
    struct lang_syntax syntax = toy_syntax;
    syntax.base = &toy_syntax;
    syntax.reserved_prefix = "toy_";
    syntax.begins_with_letter = true;
    fixture_open(&f, "struct S { float toy_m; float _m; };\n"
                     "float names(float toy_a, float _b, S s) { float _c = toy_a; float x_c = _b;\n"
                     "    return _c + x_c + s.toy_m + s._m; }\n");
    const char *text = print_by(&f, &syntax, "names");
    REQUIRE(has(text, "fn names(in xtoy_a_: f32, in x_b_: f32, in s: S) -> f32\n"));
    REQUIRE(has(text, "val x_c_: f32 = xtoy_a_;\n    val x_c: f32 = x_b_;\n"));
    REQUIRE(has(text, "return x_c_ + x_c + s.xtoy_m_ + s.x_m_;\n"));
    fixture_close(&f);
}

int main(void)
{
    test_differs();
    test_functions();
    test_file_scope();
    test_overloads();
    test_booleans();
    test_results();
    test_bindings();
    test_results_in_struct();
    test_results_in_heads();
    test_beginnings();
    return test_report("syntax");
}
