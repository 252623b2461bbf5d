// SPDX-License-Identifier: Apache-2.0
/*
 * The speller and its targets. With a folder as argument, the shaders of the op walk and of the
 * whole stages are written there, for a GLSL compiler to judge.
 */
#include "shader/verbatim.h"

#include "shader_fixture.h"
#include "test.h"

#include <math.h>

static const char *folder;

static const char *spell(struct fixture *f, const char *target_name, enum shader_stage_id stage,
                         const struct spell_options *options, struct spell_mark **out_marks,
                         uint32_t *out_num_marks)
{
    struct text out;
    text_init(&out, &f->arena);
    spell_shader_stage(target_find(target_name), options, &f->shader, stage, &f->arena, &out,
                       out_marks, out_num_marks);
    return text_cstr(&out);
}

static const struct spell_options plain = {.generator = "mxgen 0.1", .interface = "complete"};

/* Keeps the rules that the test has set. */
static void finish(struct fixture *f, const struct target *target)
{
    f->shader.style = ARENA_NEW(&f->arena, struct lang_style);
    lang_style_init(f->shader.style, target->syntax, &f->arena);
    struct shader_layout_rules rules = f->shader.interface.rules;
    rules.blocks |= (target->caps & CAP_UNIFORM_BLOCKS) != 0;
    rules.bindings = (target->caps & CAP_BINDINGS) != 0;
    shader_finish(&f->shader, &rules);
}

/* The statements of main in the pixel stage. */
static const char *body(struct fixture *f, const struct spell_options *options)
{
    struct spell_mark *marks;
    uint32_t num_marks;
    finish(f, target_find("glsl"));
    const char *text = spell(f, "glsl", STAGE_PIXEL, options, &marks, &num_marks);
    const char *start = strstr(text, "void main()\n{\n") + strlen("void main()\n{\n");
    return arena_strndup(&f->arena, start, strlen(start) - 2);
}

static const char functions[] =
    "in vec3 normalWorld;\n"
    "uniform float u_time;\n"
    "const float weights[3] = float[3](1.0, 2.0, 3.5);\n"
    "struct Pair { float a; vec3 b; };\n"
    "float noise(vec2 p) { float s = 0.0; for (int i = 0; i < 3; ++i) s += weights[i] * sin(p.x * "
    "u_time); return s; }\n"
    "void split(vec3 a, out float x, out float y) { x = a.x; y = a.y; for (int i = 0; i < 2; ++i) "
    "y *= 2.0; }\n"
    "float step_on(float a, inout float b) { for (int i = 0; i < 2; ++i) b *= a; return b + 1.0; "
    "}\n"
    "Pair make_pair(float x) { Pair p; p.a = x; p.b = vec3(x, 1.0, 2.0) + normalWorld; for (int i "
    "= 0; i < 3; ++i) p.a *= 3.0; return p; }\n"
    "float twin(float x) { float y = 0.0; for (int i = 0; i < 3; ++i) y += x; return y; }\n"
    "float twin(vec2 x) { float y = 0.0; for (int i = 0; i < 3; ++i) y += x.x; return y; }\n";

/* ---- Expressions ---- */

#define EXPRESSION(expected, value) \
    do { \
        struct fixture fixture, *f = &fixture; \
        fixture_open(f, functions); \
        ir_ref a = uniform(f, "a", IR_TYPE_FLOAT), b = uniform(f, "b", IR_TYPE_FLOAT), \
               c = uniform(f, "c", IR_TYPE_FLOAT); \
        ir_ref v = uniform(f, "v", IR_TYPE_VEC3), t = uniform(f, "t", IR_TYPE_BOOL), \
               i = uniform(f, "i", IR_TYPE_INT); \
        (void)a, (void)b, (void)c, (void)v, (void)t, (void)i; \
        f->graph.no_fold = true; \
        effect(f, EFFECT_OUTPUT, add_output(f), (value)); \
        REQUIRE_STR(body(f, &plain), "    out1 = " expected ";\n"); \
        fixture_close(f); \
    } while (0)

static ir_ref select_of(struct fixture *f, ir_ref c, ir_ref a, ir_ref b)
{
    return ir_op3(&f->graph, IR_SELECT, c, a, b);
}

static ir_ref component(struct fixture *f, ir_ref v, unsigned index)
{
    return ir_build(&f->graph, IR_SWIZZLE, IR_TYPE_FLOAT, 1u << 8 | index, &v, 1);
}

static void test_expressions(void)
{
    EXPRESSION("a + b - c", op2(f, IR_SUB, op2(f, IR_ADD, a, b), c));
    EXPRESSION("a - (b - c)", op2(f, IR_SUB, a, op2(f, IR_SUB, b, c)));
    EXPRESSION("(a + b) * c", op2(f, IR_MUL, op2(f, IR_ADD, a, b), c));
    EXPRESSION("a / (b * c)", op2(f, IR_DIV, a, op2(f, IR_MUL, b, c)));
    EXPRESSION("-(a * b)", op1(f, IR_NEG, op2(f, IR_MUL, a, b)));
    EXPRESSION("-(-a)", op1(f, IR_NEG, op1(f, IR_NEG, a)));
    EXPRESSION("a - -1.0", op2(f, IR_SUB, a, number(f, -1)));
    EXPRESSION("-a * b", op2(f, IR_MUL, op1(f, IR_NEG, a), b));
    EXPRESSION("max(a + b, c)", op2(f, IR_MAX, op2(f, IR_ADD, a, b), c));
    EXPRESSION("(v * a).x", component(f, op2(f, IR_MUL, v, a), 0));
    EXPRESSION("normalize(v).z", component(f, op1(f, IR_NORMALIZE, v), 2));
    EXPRESSION("t ? a : t ? b : c", select_of(f, t, a, select_of(f, t, b, c)));
    EXPRESSION("(t ? a : b) + c", op2(f, IR_ADD, select_of(f, t, a, b), c));
    EXPRESSION("a < b ? a + b : c", select_of(f, op2(f, IR_LT, a, b), op2(f, IR_ADD, a, b), c));
    EXPRESSION("(t ? t : t) ? a : b", select_of(f, select_of(f, t, t, t), a, b));
    EXPRESSION("!(t || t) && t ? a : b",
               select_of(f, op2(f, IR_LAND, op1(f, IR_NOT, op2(f, IR_LOR, t, t)), t), a, b));
    EXPRESSION("(t || t) && t ? a : b",
               select_of(f, op2(f, IR_LAND, op2(f, IR_LOR, t, t), t), a, b));
    EXPRESSION("t || (t && t) || t ? a : b",
               select_of(f, op2(f, IR_LOR, t, op2(f, IR_LOR, op2(f, IR_LAND, t, t), t)), a, b));
    EXPRESSION("(i << (i & 3)) | ~i",
               op2(f, IR_OR, op2(f, IR_SHL, i, op2(f, IR_AND, i, ir_const_int(&f->graph, 3))),
                   op1(f, IR_BITNOT, i)));
    EXPRESSION("vec3(a)", (f->graph.no_fold = false, vec3_of(f, a)));
    EXPRESSION("vec4(v, 1.0)",
               (f->graph.no_fold = false,
                ir_construct(&f->graph, IR_TYPE_VEC4, (ir_ref[]){v, number(f, 1)}, 2)));
    EXPRESSION("float(i)", ir_convert(&f->graph, IR_TYPE_FLOAT, i));
    EXPRESSION("v[i]", ir_build(&f->graph, IR_INDEX, IR_TYPE_FLOAT, 0, (ir_ref[]){v, i}, 2));
    EXPRESSION("roundEven(a)", op1(f, IR_ROUND, a));
    EXPRESSION("atan(a, b)", op2(f, IR_ATAN2, a, b));
    EXPRESSION("twin(a)", call(f, "twin", &a, 1));
    EXPRESSION("fract(1e-9)", op1(f, IR_FRACT, number(f, 1e-9f)));
}

/* ---- Statements ---- */

#define STATEMENTS(expected, options, ...) \
    do { \
        struct fixture fixture, *f = &fixture; \
        fixture_open(f, functions); \
        ir_ref a = uniform(f, "a", IR_TYPE_FLOAT), v = uniform(f, "v", IR_TYPE_VEC3); \
        (void)a, (void)v; \
        __VA_ARGS__ \
        REQUIRE_STR(body(f, (options)), expected); \
        fixture_close(f); \
    } while (0)

static const char *path_of(void *user_data, uint32_t origin)
{
    struct fixture *f = user_data;
    struct text path;
    text_init(&path, &f->arena);
    text_str(&path, "NG/");
    text_str(&path, str_text(&f->strings, f->graph.origins.items[origin].name));
    return text_cstr(&path);
}

static ir_ref sine(struct fixture *f, const char *called, ir_ref a)
{
    name(f, called);
    ir_ref value = op1(f, IR_SIN, a);
    ir_suggest_name(&f->graph, value, word(f, called), IR_NAME_RESULT);
    f->graph.origin = 0;
    return value;
}

static void use_twice(struct fixture *f, ir_ref value)
{
    ir_type_id type = ir_type_of(&f->graph, value);
    accumulate(f, type == IR_TYPE_VEC3 ? value : vec3_of(f, value));
    accumulate(f, op2(f, IR_ADD, type == IR_TYPE_VEC3 ? value : vec3_of(f, value), number(f, 1)));
}

/* Names of locals: from the document's nodes, made fit, without clashes. */
static void test_locals(void)
{
    static const struct {
        const char *first, *second, *got_first, *got_second;
    } cases[] = {
        {"roughness", "roughness", "roughness", "roughness_2"},
        {"mix", "vec3", "mix_", "vec3_"},
        {"mix", "mix", "mix_", "mix_2"},
        {"mix", "mix_", "mix_", "mix_2"},
        {"a", "v", "a_2", "v_2"},
        {"2nd", "a  b", "x2nd", "a_b"},
        {"x__y", "x_y", "x_y", "x_y_2"},
        {"main", "vd", "main_2", "vd_2"},
        {"x_", "x_", "x_", "x_2"},
        {"", "", "sine_a", "sine_v"},
        {"gl_in", "out1", "xgl_in", "out1_2"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct fixture f;
        fixture_open(&f, functions);
        ir_ref a = uniform(&f, "a", IR_TYPE_VEC3), v = uniform(&f, "v", IR_TYPE_VEC3);
        ir_ref first = sine(&f, cases[i].first, a), second = sine(&f, cases[i].second, v);
        effect(&f, EFFECT_VAR, f.color, 0);
        use_twice(&f, first);
        use_twice(&f, second);
        write_color(&f);
        char want[128];
        const char *text = body(&f, &plain);
        (void)snprintf(want, sizeof want, "    vec3 %s = sin(a);\n", cases[i].got_first);
        if (!REQUIRE(strstr(text, want) != NULL))
            printf("%s in\n%s", want, text);
        (void)snprintf(want, sizeof want, "    vec3 %s = sin(v);\n", cases[i].got_second);
        if (!REQUIRE(strstr(text, want) != NULL))
            printf("%s in\n%s", want, text);
        fixture_close(&f);
    }
}

static void test_statements(void)
{
    STATEMENTS("    vec3 color = vec3(0.0);\n    if (a > 0.0)\n        color += v;\n    out1 = "
               "vec4(color, 1.0);\n",
               &plain, effect(f, EFFECT_VAR, f->color, ir_const_splat(&f->graph, IR_TYPE_VEC3, 0));
               effect(f, EFFECT_IF, 0, op2(f, IR_GT, a, number(f, 0))); accumulate(f, v);
               effect(f, EFFECT_END, 0, 0); write_color(f););
    STATEMENTS("    vec3 color;\n    if (a > 0.0) {\n        vec3 n = sin(v);\n        color += "
               "n;\n        color += n + vec3(1.0);\n    }\n",
               &plain, effect(f, EFFECT_VAR, f->color, 0);
               effect(f, EFFECT_IF, 0, op2(f, IR_GT, a, number(f, 0)));
               use_twice(f, sine(f, "n", v)); effect(f, EFFECT_END, 0, 0););
    STATEMENTS("    if (a < 0.5)\n        discard;\n", &plain,
               effect(f, EFFECT_DISCARD, 0, op2(f, IR_LT, a, number(f, 0.5f))););
    STATEMENTS("    vec3 color = v;\n    float s_x, s_y;\n    split(v, s_x, s_y);\n    color += "
               "vec3(s_x);\n    color += vec3(s_y);\n",
               &plain, effect(f, EFFECT_VAR, f->color, v);
               name(f, "s"); ir_ref s = call(f, "split", &v, 1); f->graph.origin = 0;
               accumulate(f, vec3_of(f, result(f, s, 1, IR_TYPE_FLOAT)));
               accumulate(f, vec3_of(f, result(f, s, 2, IR_TYPE_FLOAT))););
    STATEMENTS("    vec3 color = v;\n    float s_b = 2.0;\n    float s = step_on(a, s_b);\n    "
               "color += vec3(s_b + s);\n",
               &plain, effect(f, EFFECT_VAR, f->color, v);
               name(f, "s"); ir_ref args[] = {a, number(f, 2)};
               ir_ref s = call(f, "step_on", args, 2); f->graph.origin = 0;
               ir_ref out = result(f, s, 1, IR_TYPE_FLOAT),
               returned = result(f, s, 0, IR_TYPE_FLOAT);
               accumulate(f, vec3_of(f, op2(f, IR_ADD, out, returned))););
    STATEMENTS("    vec3 color = v;\n    // NG\n    vec3 n = sin(v);\n    color += n;\n    color "
               "+= n + vec3(1.0);\n"
               "    vec3 m = sin(n);\n    color += m;\n    color += m + vec3(1.0);\n",
               (&(struct spell_options){.comments = true, .path = path_of, .user_data = f}),
               effect(f, EFFECT_VAR, f->color, v);
               ir_ref n = sine(f, "n", v); use_twice(f, n); use_twice(f, sine(f, "m", n)););
    STATEMENTS(
        "    vec3 v = u_0;\n    vec3 v_2 = sin(u_0);\n    v += v_2;\n    v += v_2 + vec3(1.0);\n",
        (&(struct spell_options){.comments = true, .path = path_of, .user_data = f}),
        f->shader.interface.rules.neutral_names = true;
        effect(f, EFFECT_VAR, f->color, v); use_twice(f, sine(f, "n", v)););
    STATEMENTS(
        "    vec3 color = v;\n    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) "
        "{\n        color += u_lightData[i].direction;\n    }\n",
        &plain, effect(f, EFFECT_VAR, f->color, v);
        effect(f, EFFECT_LIGHTS, 0, 0); accumulate(f, light_direction(f));
        effect(f, EFFECT_END, 0, 0););
}

/* The whole pixel stage, from `from` on. */
static const char *stage_from(struct fixture *f, const char *from)
{
    struct spell_mark *marks;
    uint32_t num_marks;
    finish(f, target_find("glsl"));
    const char *text = spell(f, "glsl", STAGE_PIXEL, &plain, &marks, &num_marks),
               *start = strstr(text, from);
    return start ? start : text;
}

static void test_graph_functions(void)
{
    struct fixture f;
    fixture_open(&f, NULL);
    static const ir_type_id types[] = {IR_TYPE_VEC3, IR_TYPE_FLOAT};
    uint32_t inner = ir_add_function(&f.graph, word(&f, "inner"), types, 1),
             outer = ir_add_function(&f.graph, word(&f, "outer"), types, 2);
    ir_ref p = ir_param(&f.graph, inner, 0), length = op1(&f, IR_LENGTH, p);
    name(&f, "n");
    ir_ref n = op1(&f, IR_NORMALIZE, p);
    ir_suggest_name(&f.graph, n, word(&f, "n"), IR_NAME_RESULT);
    f.graph.origin = 0;
    ir_set_results(&f.graph, inner,
                   (ir_ref[]){op2(&f, IR_CROSS, n, op2(&f, IR_MUL, n, length)), length}, 2);
    ir_ref args[] = {ir_param(&f.graph, outer, 0), ir_param(&f.graph, outer, 1)};
    name(&f, "deep");
    ir_ref deep = ir_build(&f.graph, IR_GRAPH_CALL, IR_TYPE_VEC3, inner, args, 1);
    f.graph.origin = 0;
    ir_ref scaled = op2(&f, IR_MUL, args[1], result(&f, deep, 1, IR_TYPE_FLOAT));
    ir_ref sum = op2(&f, IR_ADD, scaled, result(&f, deep, 0, IR_TYPE_VEC3));
    ir_set_results(&f.graph, outer, &sum, 1);
    ir_ref given[] = {uniform(&f, "v", IR_TYPE_VEC3), uniform(&f, "a", IR_TYPE_FLOAT)};
    effect(&f, EFFECT_VAR, f.color,
           ir_build(&f.graph, IR_GRAPH_CALL, IR_TYPE_VEC3, outer, given, 2));
    write_color(&f);
    REQUIRE_STR(
        stage_from(&f, "vec3 inner"),
        "vec3 inner(const vec3 p0, out float r1)\n{\n    float magnitude = length(p0);\n    r1 = "
        "magnitude;\n    vec3 n = normalize(p0);\n"
        "    return cross(n, magnitude * n);\n}\n\n"
        "vec3 outer(const vec3 p0, const float p1)\n{\n    float deep_result;\n    vec3 "
        "deep = inner(p0, deep_result);\n"
        "    return p1 * deep_result + deep;\n}\n\n"
        "void main()\n{\n    vec3 color = outer(v, a);\n    out1 = vec4(color, 1.0);\n}\n");
    fixture_close(&f);
}

static void test_verbatim(void)
{
    struct fixture f;
    fixture_open(&f, NULL);
    vec_push(&f.arena, &f.shader.sources.result_types, IR_TYPE_VEC3);
    struct source_fault fault;
    str_id text = word(&f, "void theirs(vec3 a, out vec3 b) { b = a; }\n");
    uint32_t source = shader_add_source(&f.shader, text, NULL, 0, &fault);
    vec_push(&f.arena, &f.shader.sources.refs, source);
    vec_push(&f.arena, &f.shader.sources.calls,
             (struct shader_verbatim){.first_source = f.shader.sources.refs.len - 1,
                                      .num_sources = 1,
                                      .function = word(&f, "theirs"),
                                      .num_results = 1});
    vec_push(&f.arena, &f.shader.sources.calls,
             (struct shader_verbatim){.expression = word(&f, "{{0}} * {{1}}")});
    uint32_t callees[2];
    for (uint32_t i = 0; i < 2; i++)
        callees[i] = ir_add_callee(
            &f.graph,
            (struct ir_callee){.kind = IR_CALLEE_VERBATIM, .index = i, .name = word(&f, "theirs")});
    ir_ref v = uniform(&f, "v", IR_TYPE_VEC3), args[] = {op2(&f, IR_ADD, v, number(&f, 1)), v};
    ir_ref product = ir_build(&f.graph, IR_VERBATIM, IR_TYPE_VEC3, callees[1], args, 2);
    name(&f, "copy");
    ir_ref copy = ir_build(&f.graph, IR_VERBATIM, IR_TYPE_VOID, callees[0], &product, 1);
    effect(&f, EFFECT_VAR, f.color, result(&f, copy, 1, IR_TYPE_VEC3));
    write_color(&f);
    REQUIRE_STR(stage_from(&f, "void theirs"),
                "void theirs(vec3 a, out vec3 b) { b = a; }\n\nvoid main()\n{\n    vec3 copy;\n    "
                "theirs(((v + vec3(1.0)) * v), copy);\n"
                "    vec3 color = copy;\n    out1 = vec4(color, 1.0);\n}\n");
    fixture_close(&f);
}

/* ---- Whole stages ---- */

static void write_file(const char *target, const char *what, const char *suffix, const char *text)
{
    if (!folder)
        return;
    char path[512];
    (void)snprintf(path, sizeof path, "%s/%s_%s.%s", folder, what, target, suffix);
    FILE *file = fopen(path, "w");
    if (file) {
        fputs(text, file);
        fclose(file);
    }
}

static void build_lit(struct fixture *f)
{
    ir_ref light = light_member(f, "color");
    ir_ref uv = shader_stream(&f->shader, word(f, "texcoord_0"), IR_TYPE_VOID);
    ir_ref flag = shader_stream(&f->shader, word(f, "geomprop_flag"), IR_TYPE_BOOL);
    name(f, "N");
    ir_ref n =
        op1(f, IR_NORMALIZE, shader_stream(&f->shader, word(f, "normalWorld"), IR_TYPE_VOID));
    ir_suggest_name(&f->graph, n, word(f, "N"), IR_NAME_RESULT);
    ir_ref texel = op2(f, IR_TEX, uniform(f, "image_file", IR_TYPE_SAMPLER), uv);
    if (!texel)
        texel = ir_build(&f->graph, IR_TEX, IR_TYPE_VEC4, 0,
                         (ir_ref[]){uniform(f, "image_file", IR_TYPE_SAMPLER), uv}, 2);
    name(f, "base");
    ir_ref image = ir_swizzle(&f->graph, texel, (uint8_t[]){0, 1, 2}, 3);
    ir_ref base = op2(f, IR_MUL, image, uniform(f, "base_color", IR_TYPE_VEC3));
    ir_suggest_name(&f->graph, base, word(f, "base"), IR_NAME_RESULT);
    f->graph.origin = 0;
    effect(f, EFFECT_VAR, f->color, op2(f, IR_MUL, base, call(f, "noise", &uv, 1)));
    effect(f, EFFECT_LIGHTS, 0, 0);
    accumulate(f,
               op2(f, IR_MUL, light, op2(f, IR_MUL, base, op2(f, IR_DOT, n, light_direction(f)))));
    effect(f, EFFECT_END, 0, 0);
    effect(f, EFFECT_IF, 0, flag);
    accumulate(f, n);
    effect(f, EFFECT_END, 0, 0);
    write_color(f);
    vec_push(&f->arena, &f->shader.reflection.closures, 0);
}

static const char *const lit_main =
    "float noise(~vec2 p)\n{\n    float s = 0.0;\n    for (int i = 0; i < 3; ++i)\n        s += "
    "weights[i] * sin(p.x * u_time);\n"
    "    return s;\n}\n\n"
    "void main()\n{\n    vec3 base = texture(image_file, @texcoord_0).xyz * base_color;\n    vec3 "
    "color = base * noise(@texcoord_0);\n"
    "    vec3 N = normalize(@normalWorld);\n"
    "    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {\n"
    "        color += u_lightData[i].color * (base * dot(N, u_lightData[i].direction));\n    }\n"
    "    if (bool(@geomprop_flag))\n        color += N;\n    out1 = vec4(color, 1.0);\n}\n";

static const struct stage_case {
    const char *target, *vertex_data;
    bool uniform_blocks;
    const char *pixel, *vertex;
} stage_cases[] = {
    {"glsl", "vd.", false,
     "#version 450\n// Gold · surfacematerial · mxgen 0.1 · glsl · complete · 1 closure · 1 "
     "texture\n\n"
     "uniform vec3 base_color = vec3(0.0);\nuniform float u_time = 0.0;\nuniform int "
     "u_numActiveLightSources = 0;\n"
     "struct LightData {\n    int type;\n    vec3 color;\n    vec3 direction;\n};\n"
     "uniform LightData u_lightData[3];\nuniform sampler2D image_file;\n"
     "in VertexData {\n    vec3 normalWorld;\n    vec2 texcoord_0;\n    flat int geomprop_flag;\n} "
     "vd;\n"
     "out vec4 out1;\n\nconst float weights[3] = float[3](1.0, 2.0, 3.5);\n\n",
     "#version 450\n// Gold · surfacematerial · mxgen 0.1 · glsl · complete · 1 closure · 1 "
     "texture\n\n"
     "uniform mat4 u_worldMatrix = mat4(1.0);\nuniform mat4 u_worldInverseTransposeMatrix = "
     "mat4(1.0);\n"
     "uniform mat4 u_viewProjectionMatrix = mat4(1.0);\n"
     "in vec3 i_position;\nin vec3 i_normal;\nin vec2 i_texcoord_0;\nin int i_geomprop_flag;\n"
     "out VertexData {\n    vec3 normalWorld;\n    vec2 texcoord_0;\n    flat int "
     "geomprop_flag;\n} vd;\n\n"
     "void main()\n{\n    vd.texcoord_0 = i_texcoord_0;\n    vd.geomprop_flag = i_geomprop_flag;\n"
     "    vd.normalWorld = normalize((u_worldInverseTransposeMatrix * vec4(i_normal, 0.0)).xyz);\n"
     ""
     "    gl_Position = u_viewProjectionMatrix * (u_worldMatrix * vec4(i_position, 1.0));\n}\n"},
    {"vulkan", "vd.", false,
     "#version 450\n// Gold · surfacematerial · mxgen 0.1 · vulkan · complete · 1 closure · 1 "
     "texture\n\n"
     "layout(set = 0, binding = 1, std140) uniform PublicUniforms {\n    vec3 base_color;\n};\n"
     "layout(set = 0, binding = 0, std140) uniform PrivateUniforms {\n    mat4 u_worldMatrix;\n    "
     "mat4 u_worldInverseTransposeMatrix;\n"
     "    mat4 u_viewProjectionMatrix;\n    float u_time;\n    int u_numActiveLightSources;\n};\n"
     "struct LightData {\n    int type;\n    vec3 color;\n    vec3 direction;\n};\n"
     "layout(set = 0, binding = 2, std140) uniform LightData_block { LightData u_lightData[3]; };\n"
     "layout(set = 0, binding = 3) uniform sampler2D image_file;\n"
     "layout(location = 0) in VertexData {\n    vec3 normalWorld;\n    vec2 texcoord_0;\n"
     "    flat int geomprop_flag;\n} vd;\n"
     "layout(location = 0) out vec4 out1;\n\nconst float weights[3] = float[3](1.0, 2.0, 3.5);\n\n",
     NULL},
    {"essl", "vd_", true,
     "#version 300 es\n// Gold · surfacematerial · mxgen 0.1 · essl · complete · 1 closure · 1 "
     "texture\n"
     "precision highp float;\nprecision highp int;\nprecision highp sampler2D;\n\n"
     "layout(std140) uniform PublicUniforms {\n    vec3 base_color;\n};\n"
     "layout(std140) uniform PrivateUniforms {\n    mat4 u_worldMatrix;\n    mat4 "
     "u_worldInverseTransposeMatrix;\n"
     "    mat4 u_viewProjectionMatrix;\n    float u_time;\n    int u_numActiveLightSources;\n};\n"
     "struct LightData {\n    int type;\n    vec3 color;\n    vec3 direction;\n};\n"
     "layout(std140) uniform LightData_block { LightData u_lightData[3]; };\n"
     "uniform sampler2D image_file;\n"
     "in vec3 vd_normalWorld;\nin vec2 vd_texcoord_0;\nflat in int vd_geomprop_flag;\n"
     "out vec4 out1;\n\nconst float weights[3] = float[3](1.0, 2.0, 3.5);\n\n",
     NULL},
};

/* The text with a target's words: '@' the prefix of vertex data, '~' that of parameters. */
static const char *fill_in(struct fixture *f, const char *text, const char *vertex_data,
                           const char *param)
{
    struct text out;
    text_init(&out, &f->arena);
    for (; *text; text++) {
        if (*text == '@' || *text == '~')
            text_str(&out, *text == '@' ? vertex_data : param);
        else
            text_char(&out, *text);
    }
    return text_cstr(&out);
}

/* Does the line that begins with `start` come from the origin of this name? */
static bool maps_line(struct fixture *f, const char *text, const struct spell_mark *marks,
                      uint32_t num_marks, const char *start, const char *origin)
{
    const char *line = text;
    while (line && strncmp(line, start, strlen(start)) != 0)
        line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL;
    for (uint32_t i = 0; i < num_marks; i++)
        if (text + marks[i].at == line)
            return strcmp(str_text(&f->strings, f->graph.origins.items[marks[i].origin].name),
                          origin)
                   == 0;
    return false;
}

static void test_stages(void)
{
    for (size_t i = 0; i < sizeof stage_cases / sizeof *stage_cases; i++) {
        const struct stage_case *c = &stage_cases[i];
        struct fixture f;
        fixture_open(&f, functions);
        f.shader.interface.rules.blocks = c->uniform_blocks;
        build_lit(&f);
        finish(&f, target_find(c->target));
        struct spell_mark *marks;
        uint32_t num_marks;
        const char *pixel = spell(&f, c->target, STAGE_PIXEL, &plain, &marks, &num_marks);
        const char *rest = strstr(pixel, "float noise(");
        REQUIRE_STR(arena_strndup(&f.arena, pixel, (size_t)(rest - pixel)), c->pixel);
        REQUIRE_STR(rest, fill_in(&f, lit_main, c->vertex_data, "const "));
        REQUIRE(maps_line(&f, pixel, marks, num_marks, "    vec3 N = ", "N"));
        REQUIRE(num_marks >= 2);
        write_file(c->target, "lit", "frag", pixel);
        const char *vertex = spell(&f, c->target, STAGE_VERTEX, &plain, &marks, &num_marks);
        if (c->vertex)
            REQUIRE_STR(vertex, c->vertex);
        write_file(c->target, "lit", "vert", vertex);
        fixture_close(&f);
    }
}

/* Structs, overloads, functions that share a name and parameter types. */
static void test_function_names(void)
{
    struct fixture f;
    fixture_open(&f, functions);
    ir_ref a = uniform(&f, "a", IR_TYPE_FLOAT),
           uv = shader_stream(&f.shader, word(&f, "texcoord_0"), IR_TYPE_VOID);
    ir_type_id pair = (ir_type_id)ir_add_struct(
        &f.graph, word(&f, "Pair"),
        (struct ir_member[]){{word(&f, "a"), IR_TYPE_FLOAT}, {word(&f, "b"), IR_TYPE_VEC3}}, 2);
    uint32_t make = function(&f, "make_pair");
    ir_ref p = ir_build(
        &f.graph, IR_CALL, pair,
        ir_add_callee(&f.graph, (struct ir_callee){.index = make, .name = word(&f, "make_pair")}),
        &a, 1);
    ir_ref t1 = call(&f, "twin", &a, 1), t2 = call(&f, "twin", &uv, 1);
    uniform(&f, "make_pair", IR_TYPE_FLOAT); /* not used, not in the way */
    ir_ref clash = uniform(&f, "noise", IR_TYPE_FLOAT);
    effect(&f, EFFECT_VAR, f.color, ir_build(&f.graph, IR_MEMBER, IR_TYPE_VEC3, 1, &p, 1));
    ir_ref difference = op2(&f, IR_SUB, t1, t2),
           member = ir_build(&f.graph, IR_MEMBER, IR_TYPE_FLOAT, 0, &p, 1);
    accumulate(&f, vec3_of(&f, op2(&f, IR_MUL, difference, member)));
    accumulate(&f, vec3_of(&f, op2(&f, IR_MUL, clash, call(&f, "noise", &uv, 1))));
    write_color(&f);
    const char *text = stage_from(&f, "void main");
    REQUIRE_STR(
        text,
        "void main()\n{\n    Pair make_pair_2 = make_pair(a);\n    vec3 color = make_pair_2.b;\n"
        "    color += vec3((twin(a) - twin(vd.texcoord_0)) * make_pair_2.a);\n"
        "    color += vec3(noise * noise_2(vd.texcoord_0));\n    out1 = vec4(color, 1.0);\n}\n");
    fixture_close(&f);
}

/* ---- Every op in every target ---- */

/* Operand types of ops whose rule does not give them. */
static const struct op_types {
    uint8_t op;
    ir_type_id result, args[4];
} special_types[] = {
    {IR_INDEX, IR_TYPE_FLOAT, {IR_TYPE_VEC3, IR_TYPE_INT}},
    {IR_CONVERT, IR_TYPE_FLOAT, {IR_TYPE_INT}},
    {IR_SELECT, IR_TYPE_VEC3, {IR_TYPE_BOOL, IR_TYPE_VEC3, IR_TYPE_VEC3}},
    {IR_STEP, IR_TYPE_VEC3, {IR_TYPE_FLOAT, IR_TYPE_VEC3}},
    {IR_SMOOTHSTEP, IR_TYPE_VEC3, {IR_TYPE_FLOAT, IR_TYPE_FLOAT, IR_TYPE_VEC3}},
    {IR_REFRACT, IR_TYPE_VEC3, {IR_TYPE_VEC3, IR_TYPE_VEC3, IR_TYPE_FLOAT}},
    {IR_MATCOMPMULT, IR_TYPE_MAT3, {IR_TYPE_MAT3, IR_TYPE_MAT3}},
    {IR_TRANSPOSE, IR_TYPE_MAT3, {IR_TYPE_MAT3}},
    {IR_INVERSE, IR_TYPE_MAT3, {IR_TYPE_MAT3}},
    {IR_DETERMINANT, IR_TYPE_FLOAT, {IR_TYPE_MAT3}},
    {IR_FLOAT_TO_INT_BITS, IR_TYPE_INT, {IR_TYPE_FLOAT}},
    {IR_FLOAT_TO_UINT_BITS, IR_TYPE_UINT, {IR_TYPE_FLOAT}},
    {IR_INT_BITS_TO_FLOAT, IR_TYPE_FLOAT, {IR_TYPE_INT}},
    {IR_UINT_BITS_TO_FLOAT, IR_TYPE_FLOAT, {IR_TYPE_UINT}},
    {IR_ANY, IR_TYPE_BOOL, {IR_TYPE_BVEC3}},
    {IR_ALL, IR_TYPE_BOOL, {IR_TYPE_BVEC2}},
    {IR_NOT_EACH, IR_TYPE_BVEC4, {IR_TYPE_BVEC4}},
    {IR_CHOOSE, IR_TYPE_VEC3, {IR_TYPE_VEC3, IR_TYPE_VEC3, IR_TYPE_BVEC3}},
    {IR_TEX, IR_TYPE_VEC4, {IR_TYPE_SAMPLER, IR_TYPE_VEC2}},
    {IR_TEX_LOD, IR_TYPE_VEC4, {IR_TYPE_SAMPLER, IR_TYPE_VEC2, IR_TYPE_FLOAT}},
    {IR_TEX_GRAD, IR_TYPE_VEC4, {IR_TYPE_SAMPLER, IR_TYPE_VEC2, IR_TYPE_VEC2, IR_TYPE_VEC2}},
    {IR_TEX_SIZE, IR_TYPE_IVEC2, {IR_TYPE_SAMPLER, IR_TYPE_INT}},
    {IR_TEX_FETCH, IR_TYPE_VEC4, {IR_TYPE_SAMPLER, IR_TYPE_IVEC2, IR_TYPE_INT}},
};

static struct op_types types_of(enum ir_op op)
{
    for (size_t i = 0; i < sizeof special_types / sizeof *special_types; i++)
        if (special_types[i].op == op)
            return special_types[i];
    const struct ir_op_info *info = ir_op_info(op);
    ir_type_id type = info->rule == IR_RULE_LOGIC     ? IR_TYPE_BOOL
                      : info->rule == IR_RULE_INTEGER ? IR_TYPE_INT
                      : info->rule == IR_RULE_COMPARE ? IR_TYPE_FLOAT
                                                      : IR_TYPE_VEC3;
    struct op_types types = {(uint8_t)op, IR_TYPE_VOID, {type, type, type, type}};
    types.result = ir_op_result(op, types.args, (unsigned)info->arity);
    return types;
}

/* Any value as a vec3, so that it can be added up. */
static ir_ref as_vec3(struct fixture *f, ir_ref value)
{
    struct ir_graph *graph = &f->graph;
    const struct ir_type_info *info = ir_type_info(ir_type_of(graph, value));
    if (info->columns > 1)
        value = ir_build(graph, IR_INDEX, IR_TYPE_VEC3, 0,
                         (ir_ref[]){value, ir_const_int(graph, 0)}, 2);
    else if (info->components > 1 && info->components != 3)
        value = ir_component(graph, value, 0);
    if (ir_type_info(ir_type_of(graph, value))->scalar != IR_TYPE_FLOAT)
        value = ir_convert(graph, IR_TYPE_FLOAT, value);
    return ir_type_of(graph, value) == IR_TYPE_VEC3 ? value : vec3_of(f, value);
}

static void walk_ops(const struct target *target)
{
    struct fixture f;
    fixture_open(&f, functions);
    f.graph.no_fold = true;
    effect(&f, EFFECT_VAR, f.color, ir_const_splat(&f.graph, IR_TYPE_VEC3, 0));
    ir_ref inputs[IR_NUM_TYPES] = {0};
    for (int op = 0; op < IR_NUM_OPS; op++) {
        enum spell_support support = spell_support(target, (enum ir_op)op);
        bool hardware = target->caps & CAP_VERTEX_STAGE;
        if (op == IR_KNOWN) /* the builder answers it */
            continue;
        REQUIRE_EQ(support, op >= IR_LEAF && hardware ? SPELL_LOWERED : SPELL_YES);
        const struct ir_op_info *info = ir_op_info((enum ir_op)op);
        if (!(info->flags & (OP_OPERATOR | OP_BUILTIN)) || info->arity < 1 || op == IR_MEMBER
            || op == IR_SWIZZLE)
            continue;
        struct op_types types = types_of((enum ir_op)op);
        ir_ref args[4];
        for (int i = 0; i < info->arity; i++) {
            if (!inputs[types.args[i]])
                inputs[types.args[i]] = uniform(&f, "u", types.args[i]);
            args[i] = inputs[types.args[i]];
        }
        if (REQUIRE(types.result != IR_TYPE_VOID))
            accumulate(&f, as_vec3(&f, ir_build(&f.graph, (enum ir_op)op, types.result, 0, args,
                                                (unsigned)info->arity)));
    }
    write_color(&f);
    struct spell_mark *marks;
    uint32_t num_marks;
    finish(&f, target);
    const char *text = spell(&f, target->name, STAGE_PIXEL, &plain, &marks, &num_marks);
    write_file(target->name, "ops", target->stage_suffix[STAGE_PIXEL], text);
    REQUIRE(strchr(text, '$') == NULL);
    fixture_close(&f);
}

static void check_reserved(const struct lang_syntax *syntax)
{
    for (uint32_t i = 1; i < syntax->num_reserved; i++)
        if (!REQUIRE(strcmp(syntax->reserved[i - 1], syntax->reserved[i]) < 0))
            printf("    %s: '%s' is not in order\n", syntax->name, syntax->reserved[i]);
}

static bool is_reserved(const char *name)
{
    return lang_syntax_is_reserved(&lang_syntax_portable, name, strlen(name));
}

/* Each word of the table is found in it. */
static void check_words(const struct lang_syntax *syntax)
{
    const struct lang_syntax *list = syntax;
    while (!list->reserved && list->base)
        list = list->base;
    for (uint32_t i = 0; i < list->num_reserved; i++)
        REQUIRE(lang_syntax_is_reserved(syntax, list->reserved[i], strlen(list->reserved[i])));
    REQUIRE(!lang_syntax_is_reserved(syntax, "roughness", 9));
}

/* The table of docs/ir.md. */
static void check_infinities(const struct target *target)
{
    static const struct {
        const char *base, *infinity, *nan;
    } spellings[] = {{"genglsl", "1e39", "(0.0 / 0.0)"},
                     {"genhlsl", "asfloat(0x7f800000u)", "asfloat(0x7fc00000u)"},
                     {"genslang", "asfloat(0x7f800000u)", "asfloat(0x7fc00000u)"},
                     {"genmsl", "INFINITY", "NAN"},
                     {"genwgsl", "wgsl_infinity()", "wgsl_nan()"},
                     {"mdl", "(1.0 / 0.0)", "(0.0 / 0.0)"},
                     {"genosl", "3.4028235e+38", "0.0"}};
    const float values[] = {INFINITY, -INFINITY, NAN};
    for (size_t i = 0; i < sizeof spellings / sizeof *spellings; i++) {
        if (!target_is_a(target, spellings[i].base))
            continue;
        struct fixture f;
        struct lang_style style;
        fixture_open(&f, "");
        lang_style_init(&style, target->syntax, &f.arena);
        for (size_t k = 0; k < sizeof values / sizeof *values; k++) {
            struct text is, expected;
            text_init(&is, &f.arena);
            text_init(&expected, &f.arena);
            text_fmt(&expected, "%s%s", k == 1 ? "(-" : "",
                     k == 2 ? spellings[i].nan : spellings[i].infinity);
            text_str(&expected, k == 1 ? ")" : "");
            lang_print_value(&style, &f.strings, IR_TYPE_FLOAT, &(union ir_word){.f = values[k]},
                             LANG_PREC_POSTFIX, &is);
            REQUIRE_STR(text_cstr(&is), text_cstr(&expected));
        }
        fixture_close(&f);
        return;
    }
    REQUIRE(false); /* no target has a spelling of infinity */
}

static void test_targets(void)
{
    REQUIRE(target_find("glsl") == target_find("genglsl"));
    REQUIRE(target_find("nonsense") == NULL);
    REQUIRE(target_is_a(target_find("essl"), "genglsl"));
    REQUIRE(!target_is_a(target_find("glsl"), "essl"));
    struct fixture f;
    fixture_open(&f, "");
    for (const struct target *const *target = targets; *target; target++) {
        walk_ops(*target);
        check_reserved((*target)->syntax);
        check_words((*target)->syntax);
        check_infinities(*target);
    }
    fixture_close(&f);
    check_reserved(&lang_syntax_portable);
    REQUIRE(is_reserved("do") && is_reserved("sampler2D"));
    REQUIRE(!is_reserved("sampler3D") && !is_reserved(""));
    REQUIRE(!is_reserved("floa") && !is_reserved("floats"));
}

int main(int argc, char **argv)
{
    folder = argc > 1 ? argv[1] : NULL;
    test_expressions();
    test_locals();
    test_statements();
    test_graph_functions();
    test_verbatim();
    test_stages();
    test_function_names();
    test_targets();
    return test_report("spell");
}
