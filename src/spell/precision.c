// SPDX-License-Identifier: Apache-2.0
/*
 * --precision mediump: the values that bear half floats, which have 11 bits and reach 65,504 (GLSL
 * ES 3.00 demands 10 bits, and 16,384). These are the colours of a material: inputs and textures
 * that are colours, and what arithmetic makes of them with each other and with shares, numbers from
 * 0 to 1, and functions of one colour.
 *
 * All else stays whole: positions, directions, texture coordinates and roughness, whose small
 * differences show; light, which may be brighter; and the results of other functions.
 */
#include "base/num.h"
#include "spell/spell.h"

#include <assert.h>
#include <math.h>

enum kind { NEITHER, SHARE, COLOR };

/* Half floats keep the bits of numbers in this range, and of 0. */
static bool is_moderate(float x)
{
    return x == 0.0f || (fabsf(x) >= 0x1p-10f && fabsf(x) <= 0x1p10f);
}

static enum kind kind_of_constant(const struct ir_graph *g, ir_ref ref)
{
    const union ir_word *words = ir_constant_words(g, ref);
    unsigned count = ir_type_info(ir_type_of(g, ref))->components;
    for (unsigned i = 0; i < count; i++)
        if (!is_moderate(words[i].f))
            return NEITHER;
    return SHARE;
}

static bool ends_at(const char *text, float value)
{
    float number;
    return text && num_parse_float(text, strlen(text), &number) && number == value;
}

/* True if the definition limits a number to the range from 0 to 1. */
static bool is_share(const struct spell *spell, const struct shader_variable *variable)
{
    struct shader_ui ui = {0};
    if (!spell->options->ui || variable->type != IR_TYPE_FLOAT || !variable->definition)
        return false;
    spell->options->ui(spell->options->user_data, variable, &ui);
    return ends_at(ui.uimin, 0.0f) && ends_at(ui.uimax, 1.0f);
}

static bool is_half_texture(const struct spell *spell, const struct shader_variable *variable)
{
    const char *file = variable->file ? str_text(spell->shader->strings, variable->file) : "",
               *ending = strrchr(file, '.');
    bool is_bright = ending && (strcmp(ending, ".exr") == 0 || strcmp(ending, ".hdr") == 0);
    return variable->type == IR_TYPE_SAMPLER && variable->colorspace && !is_bright;
}

static enum kind kind_of_variable(const struct spell *spell, const struct shader_variable *variable)
{
    if (variable->block == BLOCK_TEXTURES)
        return is_half_texture(spell, variable) ? COLOR : NEITHER;
    if (variable->block != BLOCK_PUBLIC_UNIFORMS)
        return NEITHER;
    if (variable->doc_type == STR_color3 || variable->doc_type == STR_color4)
        return COLOR;
    return is_share(spell, variable) ? SHARE : NEITHER;
}

/* Arithmetic is a colour if an operand is one, and none is a value that needs all bits. */
static enum kind kind_of_operands(const struct spell *spell, ir_ref ref, unsigned first)
{
    const struct ir_graph *g = spell->shader->graph;
    enum kind kind = SHARE;
    for (unsigned i = first; i < ir_get(g, ref)->num_args; i++) {
        enum kind operand = spell->kinds[ir_arg(g, ref, i)];
        if (operand == NEITHER)
            return NEITHER;
        kind = operand > kind ? operand : kind;
    }
    return kind;
}

/* A function of a colour alone makes a colour: another colour space. */
static enum kind kind_of_call(const struct spell *spell, ir_ref call)
{
    const struct ir_graph *g = spell->shader->graph;
    bool is_of_color = ir_get(g, call)->num_args == 1 && spell->kinds[ir_arg(g, call, 0)] == COLOR
                       && shader_call_outs(spell->shader, call) == 0;
    return is_of_color ? COLOR : NEITHER;
}

static enum kind kind_of(const struct spell *spell, ir_ref ref)
{
    const struct ir_graph *g = spell->shader->graph;
    const struct ir_node *node = ir_get(g, ref);
    if (!ir_type_is_float(node->type) || ir_type_is_matrix(node->type))
        return node->op == IR_TEXTURE
                   ? kind_of_variable(spell, &spell->shader->interface.variables.items[node->attr])
                   : NEITHER;
    switch (node->op) {
    case IR_CONST: return kind_of_constant(g, ref);
    case IR_UNIFORM:
        return kind_of_variable(spell, &spell->shader->interface.variables.items[node->attr]);
    case IR_TEX: return spell->kinds[ir_arg(g, ref, 0)];
    case IR_NEG:
    case IR_ADD:
    case IR_SUB:
    case IR_MUL:
    case IR_MIN:
    case IR_MAX:
    case IR_CLAMP:
    case IR_MIX:
    case IR_CONSTRUCT:
    case IR_SWIZZLE: return kind_of_operands(spell, ref, 0);
    case IR_SELECT: return kind_of_operands(spell, ref, 1);
    case IR_CALL: return kind_of_call(spell, ref);
    default: return NEITHER;
    }
}

void spell_find_kinds(struct spell *spell)
{
    const struct ir_graph *g = spell->shader->graph;
    if (!spell->options->halves)
        return;
    spell->kinds = ARENA_ARRAY(spell->scratch, uint8_t, g->nodes.len);
    for (ir_ref ref = 1; ref < g->nodes.len; ref++)
        spell->kinds[ref] = (uint8_t)kind_of(spell, ref);
    spell->whole_style = spell->style;
    spell->half_style = lang_style_of_halves(spell->style, spell->scratch);
}

struct text_word spell_half_type(struct spell *spell, ir_type_id type)
{
    struct text half;
    if (spell->half_style)
        return spell->half_style->types[type];
    text_init(&half, spell->scratch);
    text_str(&half, "mediump ");
    text_put(&half, lang_type_name(spell->style, &spell->lang_names, type));
    return (struct text_word){text_cstr(&half), half.len};
}

bool spell_is_half(const struct spell *spell, ir_ref ref)
{
    ir_type_id type = ir_type_of(spell->shader->graph, ref);
    return spell->kinds && spell->kinds[ref] == COLOR
           && (type == IR_TYPE_VEC3 || type == IR_TYPE_VEC4);
}

bool spell_has_half_text(const struct spell *spell, ir_ref ref)
{
    const struct ir_graph *g = spell->shader->graph;
    while (!spell->local_of[ref] && ir_get(g, ref)->op == IR_SWIZZLE)
        ref = ir_arg(g, ref, 0);
    uint8_t op = ir_get(g, ref)->op;
    bool is_read = op == IR_UNIFORM || op == IR_TEX || op == IR_CALL;
    return spell->half_style && spell_is_half(spell, ref) && (spell->local_of[ref] || !is_read);
}

bool spell_is_half_variable(const struct spell *spell, const struct shader_variable *variable)
{
    return spell->kinds && !spell->half_style && kind_of_variable(spell, variable) == COLOR;
}
