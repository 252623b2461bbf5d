// SPDX-License-Identifier: Apache-2.0
/* The forms of HLSL that depend on types, and the functions that it lacks (helpers). */
#include "generators/hlsl/hlsl.h"

/* The number of rows of a vector or matrix. */
static unsigned rows_of(ir_type_id type)
{
    return ir_type_info(type)->components / ir_type_info(type)->columns;
}

/* ---- Forms and helpers made here live as long as the stage is written ---- */

static struct text *new_text(struct spell *spell)
{
    struct text *text = ARENA_NEW(spell->scratch, struct text);
    text_init(text, spell->scratch);
    return text;
}

static const struct lang_pieces *call_of(struct spell *spell, const char *text)
{
    return lang_form_of(spell->scratch, text, LANG_PREC_POSTFIX);
}

/* The struct of a type: a tree has types of the unit, the graph has types of its own. */
static void put_type(struct spell *spell, const struct lang_use *use, ir_type_id type,
                     struct text *out)
{
    struct text *before = spell->out;
    spell->out = out;
    if (type < IR_TYPE_FIRST_USER || use->node)
        spell_type(spell, type);
    else
        spell_text(spell, spell->user_types[type - IR_TYPE_FIRST_USER]);
    spell->out = before;
}

static const char *const hlsl_helpers[NUM_HLSL_HELPERS] = {
#define HELPER(ID, text) text,
#include "generators/hlsl/helpers.def"
#undef HELPER
};

static void add_helper(struct spell *spell, const struct lang_use *use, const char *const *own,
                       unsigned helper)
{
    struct text *text = new_text(spell);
    for (const char *p = own[helper] ? own[helper] : hlsl_helpers[helper]; *p; p++) {
        if (*p != '$')
            text_char(text, *p);
        else if (*++p == 'T')
            put_type(spell, use, use->type, text);
        else
            put_type(spell, use, use->operands[*p - '0'], text);
    }
    spell_helper(spell, text_cstr(text));
}

/* ---- Operators ---- */

/* Matrices are transposed: hlsl.h. */
static const struct lang_pieces *product(struct spell *spell, const struct lang_use *use,
                                         const char *const *own)
{
    (void)own;
    ir_type_id a = use->operands[0], b = use->operands[1];
    bool is_linear = (ir_type_is_matrix(a) && ir_type_components(b) > 1)
                     || (ir_type_components(a) > 1 && ir_type_is_matrix(b));
    return is_linear ? call_of(spell, "mul($1, $0)") : NULL;
}

static const struct lang_pieces *equality(struct spell *spell, const struct lang_use *use,
                                          const char *const *own)
{
    ir_type_id type = use->operands[0];
    bool same = use->op == IR_EQ;
    if (ir_type_is_vector(type))
        return call_of(spell, same ? "all($0 == $1)" : "any($0 != $1)");
    if (!ir_type_is_matrix(type))
        return NULL;
    add_helper(spell, use, own, HELPER_EQUAL_2 + rows_of(type) - 2);
    return same ? call_of(spell, "equal($0, $1)")
                : lang_form_of(spell->scratch, "!equal($0, $1)", LANG_PREC_UNARY);
}

static const struct lang_pieces *choice(struct spell *spell, const struct lang_use *use,
                                        const char *const *own)
{
    if (use->type < IR_TYPE_FIRST_USER)
        return NULL;
    add_helper(spell, use, own, HELPER_CHOOSE);
    return call_of(spell, "choose($0, $1, $2)");
}

/* ---- Conversions of matrices; the syntax has those of vectors ---- */

static const struct lang_pieces *grow(struct spell *spell, const struct lang_use *use,
                                      const char *const *own)
{
    bool is_small = rows_of(use->operands[0]) == 2, is_3 = rows_of(use->type) == 3;
    add_helper(spell, use, own,
               is_3       ? HELPER_GROW_2_3
               : is_small ? HELPER_GROW_2_4
                          : HELPER_GROW_3_4);
    return call_of(spell, is_3 ? "grow_3($0)" : "grow_4($0)");
}

static const struct lang_pieces *convert(struct spell *spell, const struct lang_use *use,
                                         const char *const *own)
{
    ir_type_id from = use->operands[0], to = use->type;
    if (!ir_type_is_matrix(from) || !ir_type_is_matrix(to))
        return NULL;
    return rows_of(from) < rows_of(to) ? grow(spell, use, own)
                                       : lang_form_of(spell->scratch, "($T)$0", LANG_PREC_UNARY);
}

/* ---- Hooks ---- */

typedef const struct lang_pieces *form_writer(struct spell *spell, const struct lang_use *use,
                                              const char *const *own);

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

static const struct lang_pieces *call_helper(struct spell *spell, const struct lang_use *use,
                                             const char *const *own)
{
    bool is_array = use->num_operands > 0 && use->operands[0] == IR_TYPE_SAMPLER_ARRAY;
    unsigned version = helped[use->op].is_by_rows ? rows_of(use->type) - 2 : is_array;
    add_helper(spell, use, own, helped[use->op].helper + version);
    return call_of(spell, helped[use->op].call);
}

const struct lang_pieces *hlsl_form_of(struct spell *spell, const struct lang_use *use,
                                       const char *const *own)
{
    if (use->is_store)
        return NULL;
    if (helped[use->op].call)
        return call_helper(spell, use, own);
    return writers[use->op] ? writers[use->op](spell, use, own) : NULL;
}

const struct lang_pieces *hlsl_form(void *user_data, const struct lang_use *use)
{
    return hlsl_form_of(user_data, use, hlsl_helpers);
}

const char *hlsl_maker(void *user_data, const char *type)
{
    struct spell *spell = user_data;
    const struct spell_maker *maker = spell_find_maker(spell, type);
    struct text *text = new_text(spell);
    spell_write_maker(spell, maker, text);
    spell_helper(spell, text_cstr(text));
    return maker->name;
}
