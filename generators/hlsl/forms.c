// SPDX-License-Identifier: Apache-2.0
/* The forms of HLSL that depend on types, and the functions that it lacks (helpers). */
#include "generators/hlsl/hlsl.h"

static const char *const hlsl_helpers[NUM_HLSL_HELPERS] = {
#define HELPER(ID, text) text,
#include "generators/hlsl/helpers.def"
#undef HELPER
};

/* A dialect has texts of its own for some. */
static void add_helper(struct spell *spell, const struct lang_use *use, unsigned helper)
{
    const char *const *own = spell->target->helpers;
    spell_add_helper(spell, use, own && own[helper] ? own[helper] : hlsl_helpers[helper]);
}

/* ---- Operators ---- */

/* Matrices are transposed: hlsl.h. */
static const struct lang_pieces *product(struct spell *spell, const struct lang_use *use)
{
    ir_type_id a = use->operands[0], b = use->operands[1];
    bool is_linear = (ir_type_is_matrix(a) && ir_type_components(b) > 1)
                     || (ir_type_components(a) > 1 && ir_type_is_matrix(b));
    return is_linear ? spell_call_form(spell, "mul($1, $0)") : NULL;
}

static const struct lang_pieces *equality(struct spell *spell, const struct lang_use *use)
{
    ir_type_id type = use->operands[0];
    bool same = use->op == IR_EQ;
    if (ir_type_is_vector(type))
        return spell_call_form(spell, same ? "all($0 == $1)" : "any($0 != $1)");
    if (!ir_type_is_matrix(type))
        return NULL;
    add_helper(spell, use, HELPER_EQUAL_2 + ir_type_rows(type) - 2);
    return same ? spell_call_form(spell, "equal($0, $1)")
                : lang_form_of(spell->scratch, "!equal($0, $1)", LANG_PREC_UNARY);
}

static const struct lang_pieces *choice(struct spell *spell, const struct lang_use *use)
{
    if (use->type < IR_TYPE_FIRST_USER)
        return NULL;
    add_helper(spell, use, HELPER_CHOOSE);
    return spell_call_form(spell, "choose($0, $1, $2)");
}

/* ---- Conversions of matrices; the syntax has those of vectors ---- */

static const struct lang_pieces *grow(struct spell *spell, const struct lang_use *use)
{
    bool is_small = ir_type_rows(use->operands[0]) == 2, is_3 = ir_type_rows(use->type) == 3;
    add_helper(spell, use, is_3 ? HELPER_GROW_2_3 : is_small ? HELPER_GROW_2_4 : HELPER_GROW_3_4);
    return spell_call_form(spell, is_3 ? "grow_3($0)" : "grow_4($0)");
}

static const struct lang_pieces *convert(struct spell *spell, const struct lang_use *use)
{
    ir_type_id from = use->operands[0], to = use->type;
    if (!ir_type_is_matrix(from) || !ir_type_is_matrix(to))
        return NULL;
    return ir_type_rows(from) < ir_type_rows(to)
               ? grow(spell, use)
               : lang_form_of(spell->scratch, "($T)$0", LANG_PREC_UNARY);
}

/* ---- Hooks ---- */

typedef const struct lang_pieces *form_writer(struct spell *spell, const struct lang_use *use);

static form_writer *const writers[IR_NUM_OPS] = {
    [IR_MUL] = product,   [IR_EQ] = equality,     [IR_NE] = equality,
    [IR_SELECT] = choice, [IR_CONVERT] = convert,
};

/*
 * Built-in functions that are helpers. Versions of a helper follow each other: by the number of
 * rows from 2 on, or first for a texture, then for an array of textures.
 */
static const struct {
    uint8_t helper; /* enum helper: the first version */
    bool is_by_rows;
    const char *call;
} helped[IR_NUM_OPS] = {
    [IR_ASINH] = {HELPER_ASINH, false, "asinh($0)"},
    [IR_ACOSH] = {HELPER_ACOSH, false, "acosh($0)"},
    [IR_ATANH] = {HELPER_ATANH, false, "atanh($0)"},
    [IR_MOD] = {HELPER_MOD, false, "mod($0, $1)"},
    [IR_INVERSE] = {HELPER_INVERSE_2, true, "inverse($0)"},
    [IR_CHOOSE] = {HELPER_CHOOSE_2, true, "choose($0, $1, $2)"},
    [IR_TEX_SIZE] = {HELPER_SIZE, false, "texture_size($0, $1)"},
};

static const struct lang_pieces *call_helper(struct spell *spell, const struct lang_use *use)
{
    bool is_array = use->num_operands > 0 && use->operands[0] == IR_TYPE_SAMPLER_ARRAY;
    unsigned version = helped[use->op].is_by_rows ? ir_type_rows(use->type) - 2 : is_array;
    add_helper(spell, use, helped[use->op].helper + version);
    return spell_call_form(spell, helped[use->op].call);
}

const struct lang_pieces *hlsl_form(void *user_data, const struct lang_use *use)
{
    if (use->is_store)
        return NULL;
    if (helped[use->op].call)
        return call_helper(user_data, use);
    return writers[use->op] ? writers[use->op](user_data, use) : NULL;
}
