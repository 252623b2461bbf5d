// SPDX-License-Identifier: Apache-2.0
/*
 * Roles: each word of the option `role` has a row of traits, and a role that exists here alone,
 * made of one row and one frame, gives a shader that follows from its traits.
 */
#include "spell/spell.h"

#include "shader_fixture.h"
#include "test.h"

/* ---- A role of a host that bakes values: a function without neighbours, in the host's file ----
 */

static void declare(struct spell *spell)
{
    spell->frame->declare_for_function(spell);
}

static void open_bake(struct spell *spell)
{
    SPELL(spell, "void ", spell->shader->role->entry, "(inout Texel result)\n{\n");
}

static const struct target_frame bake_frame = {.declare = declare, .open = open_bake};
static const struct role bake = {.name = "bake",
                                 .stages = STAGES_NONE,
                                 .lights = LIGHTS_ELSEWHERE,
                                 .derivatives = DERIVATIVES_NONE,
                                 .is_in_host_file = true,
                                 .frame = &bake_frame,
                                 .entry = "bake"};

/* The pixel stage of a value and of how it changes on the screen, in a role. */
static const char *shade(struct fixture *f, const struct role *role)
{
    const struct spell_options options = {.generator = "mxgen 0.1", .interface = "complete"};
    const struct target *target = target_find("glsl");
    struct shader_layout_rules rules = {.blocks = false};
    struct spell_mark *marks;
    struct text out;
    uint32_t num_marks;
    f->shader.role = role;
    ir_ref height = uniform(f, "height", IR_TYPE_FLOAT),
           uv = shader_stream(&f->shader, word(f, "texcoord_0"), IR_TYPE_VEC2);
    ir_ref change = op1(f, IR_DFDX, ir_component(&f->graph, uv, 0));
    ir_ref value = op2(f, IR_ADD, height, change);
    effect(f, EFFECT_OUTPUT, add_output(f), ir_construct(&f->graph, IR_TYPE_VEC4, &value, 1));
    f->shader.style = ARENA_NEW(&f->arena, struct lang_style);
    lang_style_init(f->shader.style, target->syntax, &f->arena);
    shader_finish(&f->shader, &rules);
    text_init(&out, &f->arena);
    spell_shader_stage(target, &options, &f->shader, STAGE_PIXEL, &f->arena, &out, &marks,
                       &num_marks);
    return text_cstr(&out);
}

static void test_own_role(void)
{
    struct fixture fixture, *f = &fixture;
    fixture_open(f, NULL);
    const char *text = shade(f, &bake);
    bool is_whole = strstr(text, "void bake(inout Texel result)\n{\n")
                    && strstr(text, "uniform float height = 0.0;\n")
                    && strstr(text, "result.out1 = ");
    if (!REQUIRE(is_whole && !strstr(text, "main") && !strstr(text, "#version")
                 && !strstr(text, "dFdx")))
        printf("%s\n", text);
    fixture_close(f);
    fixture_open(f, NULL);
    text = shade(f, role_find("raster"));
    if (!REQUIRE(strstr(text, "void main()\n{\n") && strstr(text, "#version")
                 && strstr(text, "dFdx(") && !strstr(text, "result.")))
        printf("%s\n", text);
    fixture_close(f);
}

/* ---- The table ---- */

/* Every word of the option names a role, and the roles of the option come first, in its order. */
static void test_words(const char *word)
{
    for (int i = 0; *word; i++) {
        size_t len = strcspn(word, "|");
        REQUIRE(i < NUM_ROLES && strlen(roles[i].name) == len
                && memcmp(roles[i].name, word, len) == 0);
        word += len + (word[len] == '|');
    }
}

static void test_table(void)
{
    for (int i = 0; i < NUM_ROLES; i++) {
        REQUIRE(role_find(roles[i].name) == &roles[i]);
        REQUIRE(roles[i].entry && *roles[i].entry);
        REQUIRE((roles[i].frame != NULL) == roles[i].is_in_host_file);
        REQUIRE(!roles[i].lacks[TASK_ANY]);
    }
    REQUIRE(!role_find("pipeline"));
}

int main(void)
{
    test_own_role();
    test_table();
    static const struct {
        const char *key, *words;
    } options[] = {
#define OPTION(id, key, type, caps, task, values, initial, doc) {key, values},
#include "api/options.def"
#undef OPTION
    };
    for (size_t i = 0; i < sizeof options / sizeof *options; i++)
        if (strcmp(options[i].key, "role") == 0)
            test_words(options[i].words);
    return test_report("role");
}
