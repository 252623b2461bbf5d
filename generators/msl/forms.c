// SPDX-License-Identifier: Apache-2.0
/* The forms of MSL that depend on types, and the functions that it lacks (helpers). */
#include "generators/msl/msl.h"

#include <string.h>

static unsigned columns_of(ir_type_id type)
{
    return ir_type_info(type)->columns;
}

enum helper {
#define HELPER(ID, text) HELPER_##ID,
#include "generators/msl/helpers.def"
#undef HELPER
};

static void add_helper(struct spell *spell, const struct lang_use *use, unsigned helper)
{
    static const char *const declarations[] = {
#define HELPER(ID, text) text,
#include "generators/msl/helpers.def"
    };
    spell_add_helper(spell, use, declarations[helper]);
}

/* ---- Operators of matrices, column by column ---- */

/* "float3x3 divided(float3x3 a, float b)\n{ … made[i] = a[i] / b; … }" */
static const struct lang_pieces *by_column(struct spell *spell, const struct lang_use *use,
                                           const char *name, const char *sign)
{
    struct text *text = spell_new_text(spell), *call = spell_new_text(spell);
    text_fmt(text,
             "$T %s($0 a, $1 b)\n{\n    $T made;\n    for (int i = 0; i < %u; ++i)\n"
             "        made[i] = a%s %s b%s;\n    return made;\n}\n",
             name, columns_of(use->type), ir_type_is_matrix(use->operands[0]) ? "[i]" : "", sign,
             ir_type_is_matrix(use->operands[1]) ? "[i]" : "");
    spell_add_helper(spell, use, text_cstr(text));
    text_fmt(call, "%s($0, $1)", name);
    return spell_call_form(spell, text_cstr(call));
}

static const struct lang_pieces *arithmetic(struct spell *spell, const struct lang_use *use)
{
    ir_type_id a = use->operands[0], b = use->operands[1];
    if (!ir_type_is_matrix(use->type))
        return NULL;
    switch (use->op) {
    case IR_DIV: return by_column(spell, use, "divided", "/");
    case IR_MATCOMPMULT: return by_column(spell, use, "multiplied", "*");
    case IR_ADD: return a == b ? NULL : by_column(spell, use, "added", "+");
    default: return a == b ? NULL : by_column(spell, use, "subtracted", "-");
    }
}

static const struct lang_pieces *negative(struct spell *spell, const struct lang_use *use)
{
    return ir_type_is_matrix(use->type)
               ? lang_form_of(spell->scratch, "$0 * -1.0", LANG_PREC_PRODUCT)
               : NULL;
}

static const struct lang_pieces *equality(struct spell *spell, const struct lang_use *use)
{
    ir_type_id type = use->operands[0];
    bool same = use->op == IR_EQ;
    if (ir_type_is_vector(type))
        return spell_call_form(spell, same ? "all($0 == $1)" : "any($0 != $1)");
    if (!ir_type_is_matrix(type))
        return NULL;
    add_helper(spell, use, HELPER_EQUAL_2 + columns_of(type) - 2);
    return same ? spell_call_form(spell, "equal($0, $1)")
                : lang_form_of(spell->scratch, "!equal($0, $1)", LANG_PREC_UNARY);
}

static const struct lang_pieces *choice(struct spell *spell, const struct lang_use *use)
{
    if (use->type < IR_TYPE_FIRST_USER && !ir_type_is_matrix(use->type))
        return NULL;
    add_helper(spell, use, HELPER_CHOOSE);
    return spell_call_form(spell, "choose($0, $1, $2)");
}

/* ---- Conversions; the syntax has those of vectors of numbers ---- */

static const struct lang_pieces *resize(struct spell *spell, const struct lang_use *use)
{
    unsigned from = columns_of(use->operands[0]), to = columns_of(use->type);
    static const uint8_t helpers[5][5] = {
        [2] = {[3] = HELPER_GROW_2_3, [4] = HELPER_GROW_2_4},
        [3] = {[2] = HELPER_CUT_2, [4] = HELPER_GROW_3_4},
        [4] = {[2] = HELPER_CUT_2, [3] = HELPER_CUT_3},
    };
    if (from == to)
        return NULL;
    struct text *call = spell_new_text(spell);
    add_helper(spell, use, helpers[from][to]);
    text_fmt(call, "%s_%u($0)", from < to ? "grow" : "cut", to);
    return spell_call_form(spell, text_cstr(call));
}

static const struct lang_pieces *convert(struct spell *spell, const struct lang_use *use)
{
    ir_type_id from = use->operands[0], to = use->type;
    if (ir_type_is_matrix(from) && ir_type_is_matrix(to))
        return resize(spell, use);
    bool is_choice = ir_type_is_vector(from) && ir_type_info(from)->scalar == IR_TYPE_BOOL
                     && ir_type_components(from) == ir_type_components(to) && from != to;
    return is_choice ? spell_call_form(spell, "select($T(0), $T(1), $0)") : NULL;
}

/* ---- Functions that MSL has for other types only ---- */

static const struct lang_pieces *of_number(struct spell *spell, const struct lang_use *use)
{
    if (use->operands[0] != IR_TYPE_FLOAT)
        return NULL;
    switch (use->op) {
    case IR_LENGTH: return spell_call_form(spell, "abs($0)");
    case IR_DISTANCE: return spell_call_form(spell, "abs($0 - $1)");
    case IR_NORMALIZE: return spell_call_form(spell, "sign($0)");
    default: return lang_form_of(spell->scratch, "$0 * $1", LANG_PREC_PRODUCT); /* DOT */
    }
}

static const struct lang_pieces *sign_of(struct spell *spell, const struct lang_use *use)
{
    return ir_type_info(use->type)->scalar == IR_TYPE_INT
               ? spell_call_form(spell, "clamp($0, $T(-1), $T(1))")
               : NULL;
}

/* ---- Textures ---- */

static const struct lang_pieces *sample(struct spell *spell, const struct lang_use *use)
{
    if (use->operands[0] != IR_TYPE_SAMPLER_ARRAY)
        return NULL;
    bool is_alone = spell->style->syntax->without_neighbours;
    switch (use->op) {
    case IR_TEX_LOD:
        add_helper(spell, use, HELPER_LAYER_LOD);
        return spell_call_form(spell, "sample_layer_lod($0, $1, $2)");
    case IR_TEX_GRAD:
        add_helper(spell, use, HELPER_LAYER_GRAD);
        return spell_call_form(spell, "sample_layer_grad($0, $1, $2, $3)");
    case IR_TEX_FETCH:
        return spell_call_form(spell, "$0.tex.read(uint2($1.xy), uint($1.z), uint($2))");
    default:
        add_helper(spell, use, is_alone ? HELPER_LAYER_ALONE : HELPER_LAYER);
        return spell_call_form(spell, "sample_layer($0, $1)");
    }
}

/* ---- Hooks ---- */

static const struct lang_pieces *help(struct spell *spell, const struct lang_use *use)
{
    switch (use->op) {
    case IR_MOD: add_helper(spell, use, HELPER_MOD); return spell_call_form(spell, "mod($0, $1)");
    case IR_INVERSE:
        add_helper(spell, use, HELPER_INVERSE_2 + columns_of(use->type) - 2);
        return spell_call_form(spell, "inverse($0)");
    default: /* TEX_SIZE */
        add_helper(spell, use, HELPER_SIZE);
        return spell_call_form(spell, "texture_size($0, $1)");
    }
}

typedef const struct lang_pieces *form_writer(struct spell *spell, const struct lang_use *use);

static form_writer *const writers[IR_NUM_OPS] = {
    [IR_ADD] = arithmetic,         [IR_SUB] = arithmetic,   [IR_DIV] = arithmetic,
    [IR_NEG] = negative,           [IR_EQ] = equality,      [IR_NE] = equality,
    [IR_CONVERT] = convert,        [IR_LENGTH] = of_number, [IR_DISTANCE] = of_number,
    [IR_NORMALIZE] = of_number,    [IR_DOT] = of_number,    [IR_SIGN] = sign_of,
    [IR_MATCOMPMULT] = arithmetic, [IR_TEX] = sample,       [IR_TEX_LOD] = sample,
    [IR_TEX_GRAD] = sample,        [IR_TEX_FETCH] = sample, [IR_MOD] = help,
    [IR_SELECT] = choice,          [IR_INVERSE] = help,     [IR_TEX_SIZE] = help,
};

const struct lang_pieces *msl_form(void *user_data, const struct lang_use *use)
{
    if (use->is_store || !writers[use->op])
        return NULL;
    return writers[use->op](user_data, use);
}
