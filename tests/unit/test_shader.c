// SPDX-License-Identifier: Apache-2.0
/* The shader room: layout, scheduling, streams, topology, reflection. */
#include "test.h"
#include "shader_fixture.h"

/* ---- Packing of blocks ---- */

/*
 * Offsets and sizes worked out by hand from the rules of OpenGL 4.5, 7.6.2.2, for one block that
 * holds these members in order.
 */
static const struct member_case {
    ir_type_id type;
    uint16_t array_length;
    uint32_t offset, size, array_stride, matrix_stride;
} member_cases[] = {
    {IR_TYPE_FLOAT, 0, 0, 4, 0, 0},
    {IR_TYPE_VEC3, 0, 16, 12, 0, 0},
    {IR_TYPE_FLOAT, 0, 28, 4, 0, 0}, /* fills the hole behind the vec3 */
    {IR_TYPE_VEC2, 0, 32, 8, 0, 0},
    {IR_TYPE_VEC2, 0, 40, 8, 0, 0},
    {IR_TYPE_BOOL, 0, 48, 4, 0, 0},
    {IR_TYPE_IVEC2, 0, 56, 8, 0, 0},
    {IR_TYPE_MAT3, 0, 64, 48, 0, 16},
    {IR_TYPE_INT, 0, 112, 4, 0, 0},
    {IR_TYPE_FLOAT, 3, 128, 48, 16, 0},
    {IR_TYPE_FLOAT, 0, 176, 4, 0, 0}, /* not in the padding of the array */
    {IR_TYPE_MAT4, 0, 192, 64, 0, 16},
    {IR_TYPE_MAT2, 2, 256, 64, 32, 16},
    {IR_TYPE_VEC4, 0, 320, 16, 0, 0},
    {IR_TYPE_UINT, 0, 336, 4, 0, 0},
};

/*
 * Rows for constant buffers: "Packing rules for constant variables" of Microsoft's reference,
 * and a row begins behind an array or matrix.
 */
static const struct member_case cbuffer_cases[] = {
    {IR_TYPE_FLOAT, 0, 0, 4, 0, 0},   {IR_TYPE_VEC3, 0, 4, 12, 0, 0},
    {IR_TYPE_VEC2, 0, 16, 8, 0, 0},   {IR_TYPE_BOOL, 0, 24, 4, 0, 0},
    {IR_TYPE_VEC2, 0, 32, 8, 0, 0}, /* would cross a row */
    {IR_TYPE_INT, 0, 40, 4, 0, 0},    {IR_TYPE_MAT3, 0, 48, 48, 0, 16},
    {IR_TYPE_FLOAT, 0, 96, 4, 0, 0},  {IR_TYPE_FLOAT, 3, 112, 48, 16, 0},
    {IR_TYPE_VEC3, 0, 160, 12, 0, 0}, {IR_TYPE_VEC4, 0, 176, 16, 0, 0},
    {IR_TYPE_IVEC2, 0, 192, 8, 0, 0}, {IR_TYPE_VEC3, 0, 208, 12, 0, 0},
};

static void check_packing(enum shader_packing packing, const struct member_case *cases, size_t n,
                          uint32_t size)
{
    struct fixture f;
    fixture_open(&f, NULL);
    for (size_t i = 0; i < n; i++) {
        struct shader_variable v = {.name = word(&f, "v"),
                                    .block = BLOCK_PUBLIC_UNIFORMS,
                                    .type = cases[i].type,
                                    .array_length = cases[i].array_length,
                                    .stages = 1 << STAGE_PIXEL};
        shader_add_variable(&f.shader, &v);
    }
    f.shader.interface.rules = (struct shader_layout_rules){
        .blocks = true, .packing = packing, .bindings = true, .set = 2};
    shader_layout(&f.shader);
    for (size_t i = 0; i < n; i++) {
        const struct shader_variable *v = &f.shader.interface.variables.items[i];
        REQUIRE_EQ(v->offset, cases[i].offset);
        REQUIRE_EQ(v->size, cases[i].size);
        REQUIRE_EQ(v->array_stride, cases[i].array_stride);
        REQUIRE_EQ(v->matrix_stride, cases[i].matrix_stride);
        REQUIRE_EQ(v->set, 2);
    }
    REQUIRE_EQ(f.shader.interface.buffers[BLOCK_PUBLIC_UNIFORMS].size, size);
    REQUIRE_EQ(f.shader.interface.buffers[BLOCK_PRIVATE_UNIFORMS].size, 0);
    fixture_close(&f);
}

static void test_packing(void)
{
    check_packing(PACKING_STD140, member_cases, sizeof member_cases / sizeof *member_cases, 352);
    check_packing(PACKING_CBUFFER, cbuffer_cases, sizeof cbuffer_cases / sizeof *cbuffer_cases,
                  224);
}

/* Long members come first and matrices last, so that glslang, dxc and fxc agree (layout.c). */
static void test_cbuffer_lights(void)
{
    struct fixture f;
    fixture_open(&f, NULL);
    static const struct {
        const char *name;
        ir_type_id type;
        uint32_t offset;
    } members[] = {{"frame", IR_TYPE_MAT3, 48},
                   {"color", IR_TYPE_VEC3, 0},
                   {"intensity", IR_TYPE_FLOAT, 40},
                   {"direction", IR_TYPE_VEC3, 16},
                   {"angles", IR_TYPE_VEC2, 32}};
    for (size_t i = 0; i < sizeof members / sizeof *members; i++) {
        uint32_t v = shader_light_member(&f.shader, word(&f, members[i].name), members[i].type);
        f.shader.interface.variables.items[v].stages = 1 << STAGE_PIXEL;
    }
    f.shader.interface.rules =
        (struct shader_layout_rules){.blocks = true, .packing = PACKING_CBUFFER};
    shader_layout(&f.shader);
    for (size_t i = 0; i < sizeof members / sizeof *members; i++) {
        uint32_t v = shader_find_variable(&f.shader, BLOCK_LIGHT_DATA, word(&f, members[i].name));
        REQUIRE_EQ(f.shader.interface.variables.items[v].offset, members[i].offset);
    }
    REQUIRE_EQ(f.shader.interface.buffers[BLOCK_LIGHT_DATA].stride, 96);
    fixture_close(&f);
}

/*
 * int, vec3, vec3, float, vec3, float: MaterialX's members of the directional and the point light.
 */
static void test_light_layout(void)
{
    struct fixture f;
    fixture_open(&f, NULL);
    static const struct {
        const char *name;
        ir_type_id type;
        uint32_t offset;
    } members[] = {{"direction", IR_TYPE_VEC3, 16},   {"color", IR_TYPE_VEC3, 32},
                   {"intensity", IR_TYPE_FLOAT, 44},  {"position", IR_TYPE_VEC3, 48},
                   {"decay_rate", IR_TYPE_FLOAT, 60}, {"outer_angle", IR_TYPE_FLOAT, 64}};
    for (size_t i = 0; i < sizeof members / sizeof *members; i++)
        vec_push(&f.arena, &f.shader.interface.light_members,
                 shader_light_member(&f.shader, word(&f, members[i].name), members[i].type));
    REQUIRE_EQ(shader_light_member(&f.shader, word(&f, "color"), IR_TYPE_VEC3),
               f.shader.interface.light_members.items[1]);
    REQUIRE(shader_light_member(&f.shader, word(&f, "color"), IR_TYPE_FLOAT)
            != f.shader.interface.light_members.items[1]);
    effect(&f, EFFECT_LIGHTS, 0, 0);
    effect(&f, EFFECT_END, 0, 0);
    shader_finish(&f.shader, &(struct shader_layout_rules){.blocks = true});
    uint32_t type = shader_find_variable(&f.shader, BLOCK_LIGHT_DATA, word(&f, "type"));
    REQUIRE_EQ(f.shader.interface.variables.items[type].offset, 0);
    for (size_t i = 0; i < sizeof members / sizeof *members; i++)
        REQUIRE_EQ(
            f.shader.interface.variables.items[f.shader.interface.light_members.items[i]].offset,
            members[i].offset);
    REQUIRE_EQ(f.shader.interface.buffers[BLOCK_LIGHT_DATA].stride, 80);
    REQUIRE_EQ(f.shader.interface.buffers[BLOCK_LIGHT_DATA].size, 240);
    fixture_close(&f);
}

/* ---- Schedule ---- */

/* Statements in short: "var a lights{ b acc } out", where a and b are the names of LETs. */
static const char *describe(struct fixture *f, const struct effect_list *statements)
{
    static const char *const kinds[] = {
        "var",      "acc",  "assign", "out", "position", "if{",     "lights{", "turn",
        "samples{", "next", "}else{", "}",   "comment",  "discard", "let",     "result"};
    struct text out;
    text_init(&out, &f->arena);
    for (uint32_t i = 0; i < statements->len; i++) {
        const struct effect *e = &statements->items[i];
        if (i)
            text_char(&out, ' ');
        uint32_t origin = e->kind == EFFECT_LET ? ir_get(&f->graph, e->value)->origin : 0;
        text_str(&out, origin ? str_text(&f->strings, f->graph.origins.items[origin].name)
                              : kinds[e->kind]);
    }
    return text_cstr(&out);
}

static const char *scheduled(struct fixture *f)
{
    shader_finish(&f->shader, &(struct shader_layout_rules){.blocks = true});
    return describe(f, &f->shader.stages[STAGE_PIXEL].statements);
}

/* An expression that is worth a local. */
static ir_ref dear(struct fixture *f, const char *text)
{
    name(f, text);
    ir_ref value = vec3_of(f, op1(f, IR_SIN, op1(f, IR_SQRT, uniform(f, text, IR_TYPE_FLOAT))));
    name(f, "");
    return value;
}

#define SCHEDULE_TEST(title, expected, ...) \
    static void title(void) \
    { \
        struct fixture fixture, *f = &fixture; \
        fixture_open(f, "float derivative(float x) { float y = 0.0; for (int i = 0; i < 3; ++i) " \
                        "y += dFdx(x); return y; }\n" \
                        "float two(float x, out float y) { y = x; for (int i = 0; i < 3; ++i) y " \
                        "*= x; return y + 1.0; }\n"); \
        __VA_ARGS__ \
        REQUIRE_STR(scheduled(f), expected); \
        fixture_close(f); \
    }

SCHEDULE_TEST(used_once, "acc", accumulate(f, dear(f, "a"));)
SCHEDULE_TEST(used_twice, "a acc acc", ir_ref a = dear(f, "a"); accumulate(f, a);
              accumulate(f, op2(f, IR_ADD, a, dear(f, "b")));)
SCHEDULE_TEST(cheap_twice, "acc acc", ir_ref a = op1(f, IR_NEG, uniform(f, "u", IR_TYPE_VEC3));
              accumulate(f, a); accumulate(f, op2(f, IR_ADD, a, dear(f, "b")));)
SCHEDULE_TEST(sinks_into_if, "if{ a acc acc }", ir_ref a = dear(f, "a");
              effect(f, EFFECT_IF, 0, uniform(f, "c", IR_TYPE_BOOL)); accumulate(f, a);
              accumulate(f, op2(f, IR_MUL, a, dear(f, "b"))); effect(f, EFFECT_END, 0, 0);)
SCHEDULE_TEST(
    before_first_if, "if{ acc } a if{ acc } if{ acc }", ir_ref a = dear(f, "a");
    ir_ref c = uniform(f, "c", IR_TYPE_BOOL); effect(f, EFFECT_IF, 0, c);
    accumulate(f, dear(f, "b")); effect(f, EFFECT_END, 0, 0); for (int i = 0; i < 2; i++) {
        effect(f, EFFECT_IF, 0, c);
        accumulate(f, a);
        effect(f, EFFECT_END, 0, 0);
    })
SCHEDULE_TEST(out_of_lights, "a lights{ acc }", ir_ref a = dear(f, "a");
              effect(f, EFFECT_LIGHTS, 0, 0); accumulate(f, op2(f, IR_MUL, a, light_direction(f)));
              effect(f, EFFECT_END, 0, 0);)
SCHEDULE_TEST(out_of_lights_into_if, "if{ a lights{ acc } }", ir_ref a = dear(f, "a");
              effect(f, EFFECT_IF, 0, uniform(f, "c", IR_TYPE_BOOL));
              effect(f, EFFECT_LIGHTS, 0, 0); accumulate(f, op2(f, IR_MUL, a, light_direction(f)));
              effect(f, EFFECT_END, 0, 0); effect(f, EFFECT_END, 0, 0);)
SCHEDULE_TEST(stays_in_lights, "lights{ a acc acc }", name(f, "a");
              ir_ref a = op1(f, IR_NORMALIZE, light_direction(f)); name(f, "");
              effect(f, EFFECT_LIGHTS, 0, 0); accumulate(f, a); accumulate(f, op2(f, IR_MUL, a, a));
              effect(f, EFFECT_END, 0, 0);)
SCHEDULE_TEST(
    two_light_loops, "lights{ acc } lights{ acc }",
    ir_ref a = op1(f, IR_NORMALIZE, light_direction(f));
    for (int i = 0; i < 2; i++) {
        effect(f, EFFECT_LIGHTS, 0, 0);
        accumulate(f, a);
        effect(f, EFFECT_END, 0, 0);
    })
SCHEDULE_TEST(uniform_read_often, "a acc acc acc acc acc", name(f, "a");
              ir_ref a = uniform(f, "u", IR_TYPE_VEC3); name(f, ""); for (int i = 1; i <= 5; i++)
                  accumulate(f, op2(f, IR_ADD, a, dear(f, (char[]){(char)('a' + i), 0})));)
SCHEDULE_TEST(uniform_read_sometimes, "acc acc acc acc", ir_ref a = uniform(f, "u", IR_TYPE_VEC3);
              for (int i = 1; i <= 4; i++)
                  accumulate(f, op2(f, IR_ADD, a, dear(f, (char[]){(char)('a' + i), 0})));)
SCHEDULE_TEST(two_kinds_of_loops, "a lights{ acc } samples{ b acc acc }", ir_ref a = dear(f, "a");
              ir_ref i = ir_op1(&f->graph, IR_SIN,
                                ir_convert(&f->graph, IR_TYPE_FLOAT,
                                           ir_build(&f->graph, IR_SAMPLE, IR_TYPE_INT, 0, NULL,
                                                    0)));
              name(f, "b"); ir_ref b = op2(f, IR_MUL, a, i); name(f, "");
              effect(f, EFFECT_LIGHTS, 0, 0); accumulate(f, op2(f, IR_MUL, a, light_direction(f)));
              effect(f, EFFECT_END, 0, 0); effect(f, EFFECT_SAMPLES, 0, 0); accumulate(f, b);
              accumulate(f, op1(f, IR_SQRT, b)); effect(f, EFFECT_END, 0, 0);)
SCHEDULE_TEST(condition_in_lights, "lights{ if{ acc } }",
              ir_ref c = op2(f, IR_GT, uniform(f, "w", IR_TYPE_FLOAT), number(f, 0));
              effect(f, EFFECT_LIGHTS, 0, 0); effect(f, EFFECT_IF, 0, c);
              accumulate(f, light_direction(f)); effect(f, EFFECT_END, 0, 0);
              effect(f, EFFECT_END, 0, 0);)
SCHEDULE_TEST(both_sides_of_a_choice, "a if{ acc }else{ b acc acc }", ir_ref a = dear(f, "a");
              ir_ref b = dear(f, "b"); effect(f, EFFECT_IF, 0, uniform(f, "c", IR_TYPE_BOOL));
              accumulate(f, a); effect(f, EFFECT_ELSE, 0, 0); accumulate(f, op2(f, IR_MUL, a, b));
              accumulate(f, op1(f, IR_SQRT, b)); effect(f, EFFECT_END, 0, 0);)
SCHEDULE_TEST(derivative_out_of_if, "a if{ acc }", ir_ref b = dear(f, "b"); name(f, "a");
              ir_ref a = op1(f, IR_DFDX, b); name(f, "");
              effect(f, EFFECT_IF, 0, uniform(f, "c", IR_TYPE_BOOL));
              accumulate(f, op1(f, IR_SIN, a)); effect(f, EFFECT_END, 0, 0);)
SCHEDULE_TEST(derivative_call_out_of_if, "a if{ acc }", ir_ref u = uniform(f, "u", IR_TYPE_FLOAT);
              name(f, "a"); ir_ref a = call(f, "derivative", &u, 1); name(f, "");
              effect(f, EFFECT_IF, 0, uniform(f, "c", IR_TYPE_BOOL)); accumulate(f, vec3_of(f, a));
              effect(f, EFFECT_END, 0, 0);)
SCHEDULE_TEST(derivative_before_discard, "a discard acc", name(f, "a");
              ir_ref u = uniform(f, "u", IR_TYPE_VEC3);
              ir_ref a = op1(f, IR_DFDX, op1(f, IR_SIN, u)); name(f, "");
              effect(f, EFFECT_DISCARD, 0, uniform(f, "c", IR_TYPE_BOOL)); accumulate(f, a);)
SCHEDULE_TEST(derivative_out_of_arm, "a acc", ir_ref u = uniform(f, "u", IR_TYPE_VEC3);
              name(f, "a"); ir_ref a = op1(f, IR_DFDX, op1(f, IR_SIN, u)); name(f, "");
              accumulate(f, ir_op3(&f->graph, IR_SELECT, uniform(f, "c", IR_TYPE_BOOL),
                                   op1(f, IR_SIN, a), u));)
SCHEDULE_TEST(local_in_its_effect, "var acc a acc",
              effect(f, EFFECT_VAR, f->color, vec3_of(f, number(f, 0)));
              accumulate(f, dear(f, "b")); name(f, "a"); ir_ref a = op1(f, IR_SIN, read_color(f));
              name(f, ""); accumulate(f, op2(f, IR_MUL, a, a));)
SCHEDULE_TEST(local_in_two_effects, "var acc acc",
              effect(f, EFFECT_VAR, f->color, vec3_of(f, number(f, 0)));
              ir_ref a = op1(f, IR_SIN, read_color(f)); accumulate(f, a);
              accumulate(f, op2(f, IR_ADD, a, dear(f, "b")));)
SCHEDULE_TEST(variable_of_the_light_loop, "lights{ var assign a acc acc }",
              uint32_t L = shader_add_local(&f->shader, word(f, "L"), IR_TYPE_VEC3);
              f->shader.effects.locals.items[L].is_settled = true;
              ir_ref light = ir_build(&f->graph, IR_CONTEXT, IR_TYPE_INT, IR_LIGHT_INDEX, NULL, 0);
              name(f, "a");
              ir_ref a = op1(f, IR_NORMALIZE,
                             ir_build(&f->graph, IR_LOCAL, IR_TYPE_VEC3, L, &light, 1));
              name(f, ""); effect(f, EFFECT_LIGHTS, 0, 0); effect(f, EFFECT_VAR, L, 0);
              effect(f, EFFECT_ASSIGN, L, light_direction(f)); accumulate(f, a);
              accumulate(f, op2(f, IR_MUL, a, a)); effect(f, EFFECT_END, 0, 0);)
SCHEDULE_TEST(several_results, "a acc acc", ir_ref u = uniform(f, "u", IR_TYPE_FLOAT); name(f, "a");
              ir_ref c = call(f, "two", &u, 1); name(f, "");
              accumulate(f, vec3_of(f, result(f, c, 0, IR_TYPE_FLOAT)));
              accumulate(f, vec3_of(f, result(f, c, 1, IR_TYPE_FLOAT)));)
SCHEDULE_TEST(part_of_a_local, "a acc", name(f, "a");
              ir_ref a = op1(f, IR_NORMALIZE, uniform(f, "u", IR_TYPE_VEC3)); name(f, "");
              ir_ref x = ir_component(&f->graph, a, 0), y = ir_component(&f->graph, a, 1);
              accumulate(f, vec3_of(f, op2(f, IR_POW, x, y)));)

static void test_schedule(void)
{
    used_once();
    used_twice();
    cheap_twice();
    sinks_into_if();
    both_sides_of_a_choice();
    before_first_if();
    out_of_lights();
    out_of_lights_into_if();
    stays_in_lights();
    two_light_loops();
    uniform_read_often();
    uniform_read_sometimes();
    two_kinds_of_loops();
    condition_in_lights();
    derivative_out_of_if();
    derivative_call_out_of_if();
    derivative_before_discard();
    derivative_out_of_arm();
    local_in_its_effect();
    local_in_two_effects();
    variable_of_the_light_loop();
    several_results();
    part_of_a_local();
}

/*
 * Every LET stands before what reads it, in a region that is still open there. Checked over a
 * random graph.
 */
static bool is_visible(const struct effect_list *list, uint32_t reader, ir_ref value)
{
    int depth = 0;
    for (uint32_t i = reader; i-- > 0;) {
        const struct effect *e = &list->items[i];
        if (e->kind == EFFECT_END)
            depth++;
        else if (e->kind == EFFECT_IF || e->kind == EFFECT_LIGHTS)
            depth -= depth > 0;
        else if (e->kind == EFFECT_LET && e->value == value && depth == 0)
            return true;
    }
    return false;
}

static uint32_t next_random(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 16;
}

static void check_reads(struct fixture *f, const struct effect_list *list, const uint8_t *is_let,
                        uint32_t at, ir_ref ref)
{
    for (uint32_t a = 0; a < ir_get(&f->graph, ref)->num_args; a++) {
        ir_ref operand = ir_arg(&f->graph, ref, a);
        if (!is_let[operand])
            check_reads(f, list, is_let, at, operand);
        else if (!is_visible(list, at, operand))
            REQUIRE(false && "a local is read where it is not visible");
    }
}

static void test_random_schedules(void)
{
    for (uint32_t seed = 1; seed <= 50; seed++) {
        struct fixture f;
        fixture_open(&f, NULL);
        uint32_t state = seed, open = 0;
        ir_ref pool[64] = {uniform(&f, "u", IR_TYPE_VEC3), uniform(&f, "v", IR_TYPE_VEC3),
                           light_direction(&f)};
        for (uint32_t n = 3; n < 64; n++) {
            static const enum ir_op ops[] = {IR_ADD, IR_MUL, IR_MIN, IR_CROSS};
            ir_ref a = pool[next_random(&state) % n], b = pool[next_random(&state) % n];
            pool[n] = next_random(&state) % 5 == 0
                          ? op1(&f, next_random(&state) % 2 ? IR_SIN : IR_DFDX, a)
                          : op2(&f, ops[next_random(&state) % 4], a, b);
        }
        effect(&f, EFFECT_LIGHTS, 0, 0);
        for (int n = 0; n < 24; n++) {
            uint32_t choice = next_random(&state) % 4;
            if (choice == 0 && open < 5) {
                effect(&f, EFFECT_IF, 0, uniform(&f, "c", IR_TYPE_BOOL));
                open++;
            } else if (choice == 1 && open) {
                effect(&f, EFFECT_END, 0, 0);
                open--;
            } else {
                accumulate(&f, pool[next_random(&state) % 64]);
            }
        }
        for (; open + 1; open--)
            effect(&f, EFFECT_END, 0, 0);
        scheduled(&f);
        const struct effect_list *list = &f.shader.stages[STAGE_PIXEL].statements;
        uint8_t *is_let = ARENA_ARRAY(&f.arena, uint8_t, f.graph.nodes.len);
        for (uint32_t i = 0; i < list->len; i++)
            if (list->items[i].kind == EFFECT_LET)
                is_let[list->items[i].value] = 1;
        for (uint32_t i = 0; i < list->len; i++) {
            ir_ref value = list->items[i].value;
            if (value && list->items[i].kind != EFFECT_LET && is_let[value])
                REQUIRE(is_visible(list, i, value));
            else if (value)
                check_reads(&f, list, is_let, i, value);
        }
        fixture_close(&f);
    }
}

/*
 * A chain of a million nodes becomes a list of short statements, without recursion; a diamond of
 * depth 1000 is not unfolded.
 */
static void test_long_chains(void)
{
    struct fixture f;
    fixture_open(&f, NULL);
    ir_ref x = uniform(&f, "u", IR_TYPE_FLOAT), v = uniform(&f, "v", IR_TYPE_FLOAT);
    for (int i = 0; i < 1000000; i++)
        x = op2(&f, i % 2 ? IR_POW : IR_SUB, x, v);
    accumulate(&f, vec3_of(&f, x));
    scheduled(&f);
    uint32_t chain = f.shader.stages[STAGE_PIXEL].statements.len;
    REQUIRE(chain > 10000 && chain < 500000);
    fixture_close(&f);

    fixture_open(&f, NULL);
    x = uniform(&f, "u", IR_TYPE_FLOAT);
    for (int i = 0; i < 1000; i++)
        x = op2(&f, IR_POW, x, op1(&f, IR_SIN, x));
    accumulate(&f, vec3_of(&f, x));
    scheduled(&f);
    REQUIRE(f.shader.stages[STAGE_PIXEL].statements.len <= 1001);
    fixture_close(&f);
}

/* ---- Interface ---- */

static const char *variable_name(struct fixture *f, uint32_t index)
{
    return str_text(&f->strings, f->shader.interface.variables.items[index].name);
}

static void test_names(void)
{
    static const struct {
        const char *wanted, *got;
    } cases[] = {
        {"SR_gold_base", "SR_gold_base"},
        {"SR_gold_base", "SR_gold_base_2"},
        {"a b", "a_b"},
        {"2x", "x2x"},
        {"a__b", "a_b_2"},
        {"gl_Position", "xgl_Position"},
        {"vec3", "vec3_"},
        {"vec3", "vec3_2"},
        {"main", "main_2"},
        {"", "x"},
        {"caf\xc3\xa9", "caf_"},
        {"caf_", "caf_2"},
        {"_", "_"},
    };
    struct fixture f;
    fixture_open(&f, NULL);
    struct lang_style style;
    lang_style_init(&style, target_find("glsl")->syntax, &f.arena);
    f.shader.style = &style;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct shader_variable v = {.name = word(&f, cases[i].wanted),
                                    .block = BLOCK_PUBLIC_UNIFORMS,
                                    .type = IR_TYPE_FLOAT};
        REQUIRE_STR(variable_name(&f, shader_add_variable(&f.shader, &v)), cases[i].got);
    }
    fixture_close(&f);
}

/* Streams by name, and the private variables that they bring, in the order of the layout. */
static const struct stream_case {
    const char *stream;
    ir_type_id wanted;
    const char *interface;
} stream_cases[] = {
    {"positionWorld", IR_TYPE_VOID,
     "u_worldMatrix u_viewProjectionMatrix i_position positionWorld out1"},
    {"normalWorld", IR_TYPE_VEC3,
     "u_worldMatrix u_worldInverseTransposeMatrix u_viewProjectionMatrix i_position i_normal "
     "normalWorld out1"},
    {"tangentObject", IR_TYPE_VEC3,
     "u_worldMatrix u_viewProjectionMatrix i_position i_tangent tangentObject out1"},
    {"bitangentWorld", IR_TYPE_VEC3,
     "u_worldMatrix u_worldInverseTransposeMatrix u_viewProjectionMatrix i_position i_normal "
     "i_tangent bitangentWorld out1"},
    {"bitangentObject", IR_TYPE_VEC3,
     "u_worldMatrix u_viewProjectionMatrix i_position i_normal i_tangent bitangentObject out1"},
    {"texcoord_1", IR_TYPE_VEC3,
     "u_worldMatrix u_viewProjectionMatrix i_position i_texcoord_1 texcoord_1 out1"},
    {"color_0", IR_TYPE_FLOAT,
     "u_worldMatrix u_viewProjectionMatrix i_position i_color_0 color_0 out1"},
    {"geomprop_st", IR_TYPE_VEC2,
     "u_worldMatrix u_viewProjectionMatrix i_position i_geomprop_st geomprop_st out1"},
    {"geomprop_flag", IR_TYPE_BOOL,
     "u_worldMatrix u_viewProjectionMatrix i_position i_geomprop_flag geomprop_flag out1"},
};

static void test_streams(void)
{
    for (size_t i = 0; i < sizeof stream_cases / sizeof *stream_cases; i++) {
        struct fixture f;
        fixture_open(&f, NULL);
        ir_type_id wanted = stream_cases[i].wanted;
        shader_stream(&f.shader, word(&f, "color_7"), IR_TYPE_VOID); /* asked for, and not used */
        ir_ref value = shader_stream(&f.shader, word(&f, stream_cases[i].stream), wanted);
        REQUIRE_EQ(ir_type_of(&f.graph, value), wanted == IR_TYPE_VOID ? IR_TYPE_VEC3 : wanted);
        REQUIRE_EQ(value, shader_stream(&f.shader, word(&f, stream_cases[i].stream), wanted));
        effect(&f, EFFECT_OUTPUT, add_output(&f), value);
        shader_finish(&f.shader, &(struct shader_layout_rules){0});
        struct text got;
        text_init(&got, &f.arena);
        for (uint32_t v = 0; v < f.shader.interface.used.len; v++) {
            text_str(&got, v ? " " : "");
            text_str(&got, variable_name(&f, f.shader.interface.used.items[v]));
        }
        REQUIRE_STR(text_cstr(&got), stream_cases[i].interface);
        fixture_close(&f);
    }
    struct fixture f;
    fixture_open(&f, NULL);
    REQUIRE_EQ(shader_stream(&f.shader, word(&f, "nonsense"), IR_TYPE_VEC3), 0);
    REQUIRE_EQ(shader_stream(&f.shader, word(&f, "texcoord_"), IR_TYPE_VEC2), 0);
    REQUIRE_EQ(shader_stream(&f.shader, word(&f, "geomprop_x"), IR_TYPE_VOID), 0);
    fixture_close(&f);
}

static void test_private_uniforms(void)
{
    struct fixture f;
    fixture_open(&f, NULL);
    uint32_t env = shader_private_uniform(&f.shader, word(&f, "u_envMatrix"), IR_TYPE_MAT4, 0);
    static const float half_turn[16] = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1};
    for (int i = 0; i < 16; i++)
        REQUIRE(f.shader.interface.variables.items[env].value.w[i].f == half_turn[i]);
    REQUIRE_EQ(shader_private_uniform(&f.shader, word(&f, "u_envMatrix"), IR_TYPE_MAT4, 0), env);
    uint32_t samples =
        shader_private_uniform(&f.shader, word(&f, "u_envRadianceSamples"), IR_TYPE_INT, 0);
    REQUIRE_EQ(f.shader.interface.variables.items[samples].value.w[0].i, 16);
    uint32_t map = shader_private_uniform(&f.shader, word(&f, "u_envRadiance"), IR_TYPE_SAMPLER, 0);
    REQUIRE_EQ(f.shader.interface.variables.items[map].block, BLOCK_TEXTURES);
    REQUIRE_STR(str_text(&f.strings, f.shader.interface.variables.items[map].semantic),
                "envRadiance");
    uint32_t own = shader_private_uniform(&f.shader, word(&f, "u_geomprop_x"), IR_TYPE_VEC2, 0);
    REQUIRE_EQ(f.shader.interface.variables.items[own].type, IR_TYPE_VEC2);
    fixture_close(&f);
}

/* ---- Topology ---- */

static uint64_t topology(const char *uniform_name, const char *garbage, float constant,
                         enum ir_op op)
{
    struct fixture f;
    fixture_open(&f,
                 "float g(float x) { float y = x; for (int i = 0; i < 4; ++i) y *= x; return y; }");
    if (garbage)
        op1(&f, IR_SIN, uniform(&f, garbage, IR_TYPE_FLOAT));
    ir_ref u = uniform(&f, uniform_name, IR_TYPE_FLOAT);
    accumulate(&f, vec3_of(&f, op2(&f, op, call(&f, "g", &u, 1), number(&f, constant))));
    write_color(&f);
    scheduled(&f);
    uint64_t hash = shader_topology(&f.shader, &f.arena);
    fixture_close(&f);
    return hash;
}

/* The parts of a shader that compares a string with `mode`; `garbage` is a string that was known
 * before. */
static uint64_t topology_of_string(const char *garbage, const char *mode)
{
    struct fixture f;
    fixture_open(&f, NULL);
    if (garbage)
        word(&f, garbage);
    ir_ref constant = ir_const_string(&f.graph, word(&f, mode));
    ir_ref equal = ir_build(&f.graph, IR_EQ, IR_TYPE_BOOL, 0,
                            (ir_ref[]){uniform(&f, "mode", IR_TYPE_STRING), constant}, 2);
    accumulate(&f, vec3_of(&f, ir_convert(&f.graph, IR_TYPE_FLOAT, equal)));
    write_color(&f);
    scheduled(&f);
    uint64_t hash = shader_topology(&f.shader, &f.arena);
    fixture_close(&f);
    return hash;
}

static void test_topology(void)
{
    uint64_t string = topology_of_string(NULL, "round and round");
    REQUIRE(string == topology_of_string("something else", "round and round"));
    REQUIRE(string != topology_of_string(NULL, "back and forth"));
    uint64_t hash = topology("base", NULL, 2, IR_MUL);
    REQUIRE(hash == topology("base", NULL, 2, IR_MUL));
    REQUIRE(hash == topology("other_name", NULL, 2, IR_MUL));
    REQUIRE(hash == topology("base", "unused", 2, IR_MUL));
    REQUIRE(hash != topology("base", NULL, 3, IR_MUL));
    REQUIRE(hash != topology("base", NULL, 2, IR_POW));
}

/* ---- Reflection ---- */

static void describe_ui(void *user_data, const struct shader_variable *variable,
                        struct shader_ui *out)
{
    (void)user_data;
    if (variable->path)
        *out = (struct shader_ui){
            .uiname = "Base", .uifolder = "Main", .uimin = "0", .uisoftmax = "1", .advanced = true};
}

static void describe_compiled(void *user_data, uint32_t index, struct shader_compiled_text *out)
{
    (void)user_data;
    if (index == 0)
        *out = (struct shader_compiled_text){.path = "SR/\"x\"",
                                             .type = "float",
                                             .value = "1",
                                             .authored = true,
                                             .ui.uisoftmax = "2"};
}

static void test_json(void)
{
    struct fixture f;
    fixture_open(&f, NULL);
    ir_ref base = uniform(&f, "base", IR_TYPE_FLOAT);
    f.shader.interface.variables.items[0].doc_type = word(&f, "float");
    f.shader.interface.variables.items[0].value.w[0].f = 0.5f;
    vec_push(&f.arena, &f.shader.reflection.compiled, (struct shader_compiled_input){0});
    effect(&f, EFFECT_OUTPUT, add_output(&f), ir_construct(&f.graph, IR_TYPE_VEC4, &base, 1));
    shader_finish(&f.shader, &(struct shader_layout_rules){.blocks = true, .bindings = true});
    struct text out;
    text_init(&out, &f.arena);
    shader_reflect_json(&f.shader,
                        &(struct shader_reflect_options){
                            .target = "vulkan", .ui = describe_ui, .compiled = describe_compiled},
                        &out);
    const char *json = text_cstr(&out);
    static const char *const parts[] = {
        "{\n  \"name\": \"Gold\",\n  \"element\": \"surfacematerial\",\n  \"target\": "
        "\"vulkan\",\n  \"topology\": \"",
        "      \"name\": \"PublicUniforms\",\n      \"set\": 0,\n      \"binding\": 1,\n      "
        "\"size\": 16,\n      \"variables\": [\n"
        "        {\n          \"name\": \"base\",\n          \"type\": \"float\",\n          "
        "\"stages\": [\"pixel\"],\n"
        "          \"path\": \"base\",\n          \"documentType\": \"float\",\n          "
        "\"default\": 0.5,\n          \"offset\": 0,\n"
        "          \"size\": 4,\n          \"ui\": {\n            \"name\": \"Base\",\n            "
        "\"folder\": \"Main\",\n"
        "            \"min\": \"0\",\n            \"softMax\": \"1\",\n            \"advanced\": "
        "true\n          }\n        }\n      ]\n    }",
        "\"name\": \"u_viewProjectionMatrix\"",
        "\"semantic\": \"position:object\"",
        "\"location\": 0",
        "\"matrixStride\": 16",
        "\"path\": \"SR/\\\"x\\\"\",\n      \"documentType\": \"float\",\n      \"value\": "
        "\"1\",\n      \"authored\": true,\n      \"ui\": {\n        \"softMax\": \"2\"",
    };
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        if (!REQUIRE(strstr(json, parts[i]) != NULL))
            printf("missing: %s\nin: %s\n", parts[i], json);
    fixture_close(&f);
}

int main(void)
{
    test_packing();
    test_cbuffer_lights();
    test_light_layout();
    test_schedule();
    test_random_schedules();
    test_long_chains();
    test_names();
    test_streams();
    test_private_uniforms();
    test_topology();
    test_json();
    return test_report("shader");
}
