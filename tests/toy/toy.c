// SPDX-License-Identifier: Apache-2.0
/*
 * A target for tests, in a language of its own, which differs from GLSL wherever the tables let a
 * language differ: the type stands behind the name, results return through pointers, functions have
 * no overloads, blocks no booleans, and a texture and its sampler a binding each. There is nothing
 * at file scope: a program stands around all.
 */
#include "spell/spell.h"

/* clang-format off */
static const char *const reserved[] = {"array", "block", "const", "flag", "fn", "i32", "let", "loop", "program", "ptr", "sampler", "shared", "struct", "texture", "u32", "var"};

static const char *const type_names[IR_NUM_TYPES] = {
    [IR_TYPE_BOOL] = "flag", [IR_TYPE_INT] = "i32", [IR_TYPE_UINT] = "u32", [IR_TYPE_FLOAT] = "f32",
    [IR_TYPE_VEC2] = "f32x2", [IR_TYPE_VEC3] = "f32x3", [IR_TYPE_VEC4] = "f32x4",
    [IR_TYPE_MAT2] = "f32x2x2", [IR_TYPE_MAT3] = "f32x3x3", [IR_TYPE_MAT4] = "f32x4x4",
    [IR_TYPE_SAMPLER] = "texture",
};

static const char *const phrases[NUM_PHRASES] = {
    [PHRASE_PLAIN] = "$N: $T", [PHRASE_VALUE] = "val $N: $T",
    [PHRASE_LOCAL] = "var $N: $T", [PHRASE_LOCAL_CONSTANT] = "let $N: $T",
    [PHRASE_CONSTANT] = "const $N: $T := $V;", [PHRASE_VARIABLE] = "shared $N: $T",
    [PHRASE_MEMBER] = "$N: $T,", [PHRASE_STRUCT_END] = "}",
    [PHRASE_PARAM_IN] = "in $N: $T", [PHRASE_PARAM_ASSIGNED] = "copy $N: $T",
    [PHRASE_PARAM_OUT] = "$N: ptr<$T>", [PHRASE_PARAM_INOUT] = "$N: ptr<$T, both>",
    [PHRASE_FUNCTION] = "fn $N($P) -> $T", [PHRASE_PROCEDURE] = "fn $N($P)",
    [PHRASE_ARRAY] = "array<$T, $L>",
    [PHRASE_REFERENCE] = "&$0", [PHRASE_REFERENCED] = "(*$0)",
    [PHRASE_FOR] = "loop ($0 | $1 | $2)", [PHRASE_WHILE] = "loop while ($0)",
    [PHRASE_DO] = "loop {", [PHRASE_DO_END] = "    until !($0); }",
    [PHRASE_INCREMENT] = "$0++", [PHRASE_DECREMENT] = "$0--",
    [PHRASE_DISCARD] = "kill",
};

static const struct lang_form forms[IR_NUM_OPS] = {
    [IR_CONVERT] = {"convert<$T>($0)", LANG_PREC_POSTFIX, false},
    [IR_TEX] = {"sample($0, $0" LANG_SAMPLER_SUFFIX ", $1)", LANG_PREC_POSTFIX, false},
    [IR_TEX_LOD] = {"sample_at($0, $0" LANG_SAMPLER_SUFFIX ", $1, $2)", LANG_PREC_POSTFIX, false},
};
/* clang-format on */

const struct lang_syntax toy_syntax = {
    .name = "toy",
    .base = &lang_syntax_portable,
    .type_names = type_names,
    .phrases = phrases,
    .forms = forms,
    .reserved = reserved,
    .num_reserved = sizeof reserved / sizeof *reserved,
    .copies_params = true,
    .one_per_declaration = true,
    .always_braces = true,
    .no_directives = true,
    .exact_constructors = true,
    .splat = {"splat<$T>($0)", LANG_PREC_POSTFIX, false},
    .block_bool = "u32",
    .block_bool_value = {"$0 != 0u", LANG_PREC_EQUAL, false},
    .sampler_type = "sampler",
    .infinity = "infinity",
    .nan = "nan",
};

/* "@0 block PrivateUniforms {" and its members. */
static void write_block(struct spell *spell, enum shader_block block)
{
    if (!spell_uses_block(spell, block))
        return;
    text_fmt(spell->out, "@%u block %s {\n",
             (unsigned)spell->shader->interface.buffers[block].binding,
             shader_block_name(spell->shader, block));
    SPELL_EACH_OF_BLOCK(i, spell, block)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        spell_declare(spell, PHRASE_MEMBER, variable,
                      spell_name_of(spell->shader->strings, variable->name));
        spell_text(spell, "\n");
    }
    spell_text(spell, "}\n");
}

/* A texture and its sampler, an input or an output of the stage: "@3 shared x: texture;". */
static void write_each(struct spell *spell, enum shader_block block)
{
    SPELL_EACH_OF_BLOCK(i, spell, block)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        struct spell_name name = spell->variables[spell->shader->interface.used.items[i]];
        bool is_texture = block == BLOCK_TEXTURES;
        if (!spell_uses(spell, variable))
            continue;
        text_fmt(spell->out, "@%u ",
                 (unsigned)(is_texture ? variable->binding : variable->location));
        spell_declare(spell, PHRASE_VARIABLE, variable, name);
        if (is_texture)
            text_fmt(spell->out, ";\n@%u shared %s" LANG_SAMPLER_SUFFIX ": sampler",
                     (unsigned)variable->sampler_binding, name.text);
        spell_text(spell, ";\n");
    }
}

static void declare(struct spell *spell)
{
    bool is_vertex = spell->stage_id == STAGE_VERTEX;
    spell_text(spell, "// ");
    spell_title(spell);
    spell_text(spell, "\nprogram {\n\n");
    spell_structs(spell);
    spell_uniform_blocks(spell, write_block);
    write_block(spell, BLOCK_LIGHT_DATA);
    if (spell->stage->has_lights)
        spell_text(spell, "shared u_lightData: array<LightData>;\n");
    write_each(spell, BLOCK_TEXTURES);
    write_each(spell, is_vertex ? BLOCK_APP_DATA : BLOCK_OUTPUTS);
    write_each(spell, BLOCK_VERTEX_DATA);
    spell_text(spell, is_vertex ? "shared position: f32x4;\n" : "");
}

static void open_main(struct spell *spell)
{
    spell_text(spell, "fn main()\n{\n");
}

static void close_main(struct spell *spell)
{
    spell_text(spell, "}\n\n}\n");
}

static const struct target_frame frame = {declare, open_main, close_main, NULL};

const struct target target_toy = {
    .name = "toy",
    .materialx_name = "gentoy",
    .brief = "a language of the tests",
    .caps = CAP_VERTEX_STAGE | CAP_HOST_FILES | CAP_UNIFORM_BLOCKS | CAP_BINDINGS
            | CAP_SAMPLER_BINDINGS | CAP_BITWISE | CAP_IMPLICIT_LOD | CAP_TEXTURE_ARRAYS
            | CAP_SAMPLERS,
    .syntax = &toy_syntax,
    .frame = &frame,
    .position = "position",
    .stage_suffix = {"vertex.toy", "pixel.toy"},
};
