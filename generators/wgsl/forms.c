// SPDX-License-Identifier: Apache-2.0
/* The forms of WGSL that depend on types, and the functions that it lacks (helpers). */
#include "generators/wgsl/wgsl.h"

#include <string.h>

static bool is_matrix(ir_type_id type)
{
    return type < IR_TYPE_FIRST_USER && ir_type_is_matrix(type);
}

static bool is_scalar(ir_type_id type)
{
    return type < IR_TYPE_FIRST_USER && ir_type_components(type) == 1;
}

enum helper {
#define HELPER(ID, text) HELPER_##ID,
#include "generators/wgsl/helpers.def"
#undef HELPER
    NUM_HELPERS
};

static void add_helper(struct spell *spell, const struct lang_use *use, unsigned helper)
{
    static const char *const declarations[] = {
#define HELPER(ID, text) text,
#include "generators/wgsl/helpers.def"
    };
    assert(helper < NUM_HELPERS);
    spell_add_helper(spell, use, declarations[helper]);
}

/*
 * A call of a helper: "wgsl_mod_$S" with the names of types, "$0, $1" with operands, which the form
 * keeps.
 */
static const struct lang_pieces *helped(struct spell *spell, const struct lang_use *use,
                                        unsigned helper, const char *name, const char *operands)
{
    struct text *call = spell_new_text(spell);
    add_helper(spell, use, helper);
    spell_expand(spell, use, name, call);
    text_fmt(call, "(%s)", operands);
    return spell_call_form(spell, text_cstr(call));
}

void wgsl_add_numbers(struct spell *spell)
{
    const struct lang_use none = {0};
    const char *text = text_cstr(spell->out);
    if (strstr(text, WGSL_INFINITY))
        add_helper(spell, &none, HELPER_INFINITY);
    if (strstr(text, WGSL_NAN))
        add_helper(spell, &none, HELPER_NAN);
}

/* ---- Operators ---- */

/* "$0", or the matrix whose components are all this scalar */
static const char *as_matrix(struct spell *spell, const struct lang_use *use, unsigned operand)
{
    struct text *text = spell_new_text(spell);
    if (!is_scalar(use->operands[operand])) {
        text_fmt(text, "$%u", operand);
        return text_cstr(text);
    }
    add_helper(spell, use, HELPER_FILL_2 + ir_type_rows(use->type) - 2);
    spell_expand(spell, use, "wgsl_fill_$S", text);
    text_fmt(text, "($%u)", operand);
    return text_cstr(text);
}

static const struct lang_pieces *sum(struct spell *spell, const struct lang_use *use)
{
    if (!is_matrix(use->type) || (!is_scalar(use->operands[0]) && !is_scalar(use->operands[1])))
        return NULL;
    struct text *text = spell_new_text(spell);
    text_fmt(text, "%s %s %s", as_matrix(spell, use, 0), use->op == IR_ADD ? "+" : "-",
             as_matrix(spell, use, 1));
    return lang_form_of(spell->scratch, text_cstr(text), LANG_PREC_SUM);
}

static const struct lang_pieces *quotient(struct spell *spell, const struct lang_use *use)
{
    if (!is_matrix(use->type))
        return NULL;
    struct text *operands = spell_new_text(spell);
    text_fmt(operands, "%s, %s", as_matrix(spell, use, 0), as_matrix(spell, use, 1));
    return helped(spell, use, HELPER_EACH_DIV_2 + ir_type_rows(use->type) - 2, "wgsl_div_$S",
                  text_cstr(operands));
}

static const struct lang_pieces *negative(struct spell *spell, const struct lang_use *use)
{
    return is_matrix(use->type) ? lang_form_of(spell->scratch, "-1.0 * $0", LANG_PREC_PRODUCT)
                                : NULL;
}

static const struct lang_pieces *equality(struct spell *spell, const struct lang_use *use)
{
    ir_type_id type = use->operands[0];
    bool same = use->op == IR_EQ;
    if (ir_type_is_vector(type))
        return spell_call_form(spell, same ? "all($0 == $1)" : "any($0 != $1)");
    if (!is_matrix(type))
        return NULL;
    add_helper(spell, use, HELPER_EQUAL_2 + ir_type_rows(type) - 2);
    struct text *text = spell_new_text(spell);
    spell_expand(spell, use, same ? "wgsl_equal_$A" : "!wgsl_equal_$A", text);
    text_str(text, "($0, $1)");
    return lang_form_of(spell->scratch, text_cstr(text),
                        same ? LANG_PREC_POSTFIX : LANG_PREC_UNARY);
}

/* The count of a shift is unsigned, and one of a vector for each component. */
static const struct lang_pieces *shift(struct spell *spell, const struct lang_use *use)
{
    unsigned n = ir_type_components(use->type);
    if (n == 1 && use->operands[1] == IR_TYPE_UINT)
        return NULL;
    struct text *text = spell_new_text(spell);
    text_fmt(text, "$0 %s ", use->op == IR_SHL ? "<<" : ">>");
    if (n == 1)
        text_str(text, "u32($1)");
    else
        text_fmt(text, "vec%uu($1)", n);
    return lang_form_of(spell->scratch, text_cstr(text), LANG_PREC_SHIFT);
}

/* Operators of bits take no scalar beside vectors: "$0 & $T($1)". */
static const struct lang_pieces *bits(struct spell *spell, const struct lang_use *use)
{
    struct text *text = spell_new_text(spell);
    if (is_scalar(use->operands[0]) == is_scalar(use->operands[1]))
        return NULL;
    text_fmt(text, is_scalar(use->operands[0]) ? "$T($0) %c $1" : "$0 %c $T($1)",
             use->op == IR_AND  ? '&'
             : use->op == IR_OR ? '|'
                                : '^');
    return lang_form_of(spell->scratch, text_cstr(text),
                        use->op == IR_AND  ? LANG_PREC_AND
                        : use->op == IR_OR ? LANG_PREC_OR
                                           : LANG_PREC_XOR);
}

/* The values of a choice of booleans are comparisons, which would be a template: a<b, c>. */
static const struct lang_pieces *choice(struct spell *spell, const struct lang_use *use)
{
    if (use->type == IR_TYPE_BOOL)
        return spell_call_form(spell, "select(($2), ($1), $0)");
    if (use->type < IR_TYPE_FIRST_USER && !is_matrix(use->type))
        return NULL;
    return helped(spell, use, HELPER_CHOOSE, "wgsl_choose_$S", "$0, $1, $2");
}

static const struct lang_pieces *convert(struct spell *spell, const struct lang_use *use)
{
    ir_type_id from = use->operands[0], to = use->type;
    if (!is_matrix(from) || !is_matrix(to) || from == to)
        return NULL;
    static const uint8_t helpers[5][5] = {
        [2] = {[3] = HELPER_TO_2, [4] = HELPER_TO_2},
        [3] = {[2] = HELPER_TO_3_FROM_2, [4] = HELPER_TO_3_FROM_4},
        [4] = {[2] = HELPER_TO_4_FROM_2, [3] = HELPER_TO_4_FROM_3},
    };
    return helped(spell, use, helpers[ir_type_rows(to)][ir_type_rows(from)], "wgsl_$S_of_$A", "$0");
}

/* ---- Functions ---- */

/* Built-in functions take no scalar beside vectors: "max($0, $T($1))". */
static const struct lang_pieces *spread(struct spell *spell, const struct lang_use *use,
                                        const char *function)
{
    struct text *text = spell_new_text(spell);
    text_fmt(text, "%s(", function);
    for (unsigned i = 0; i < use->num_operands; i++) {
        bool is_wide = ir_type_components(use->operands[i]) == ir_type_components(use->type);
        text_fmt(text, is_wide ? "%s$%u" : "%s$T($%u)", i ? ", " : "", i);
    }
    text_char(text, ')');
    return spell_call_form(spell, text_cstr(text));
}

static const struct lang_pieces *spread_own(struct spell *spell, const struct lang_use *use)
{
    return is_scalar(use->type) ? NULL : spread(spell, use, ir_op_info(use->op)->text);
}

static const struct lang_pieces *modulo(struct spell *spell, const struct lang_use *use)
{
    struct text *name = spell_new_text(spell);
    add_helper(spell, use, HELPER_MOD);
    spell_expand(spell, use, "wgsl_mod_$S", name);
    return spread(spell, use, text_cstr(name));
}

static const struct lang_pieces *classify(struct spell *spell, const struct lang_use *use)
{
    bool is_nan = use->op == IR_ISNAN;
    unsigned first = is_nan ? HELPER_ISNAN_1 : HELPER_ISINF_1;
    return helped(spell, use, first + ir_type_rows(use->operands[0]) - 1,
                  is_nan ? "wgsl_isnan_$A" : "wgsl_isinf_$A", "$0");
}

static const struct lang_pieces *each_product(struct spell *spell, const struct lang_use *use)
{
    return helped(spell, use, HELPER_EACH_MUL_2 + ir_type_rows(use->type) - 2, "wgsl_mul_$S",
                  "$0, $1");
}

static const struct lang_pieces *inverse(struct spell *spell, const struct lang_use *use)
{
    return helped(spell, use, HELPER_INVERSE_2 + ir_type_rows(use->type) - 2, "wgsl_inverse_$S",
                  "$0");
}

/* Lengths and products of single numbers. */
static const struct lang_pieces *of_scalars(struct spell *spell, const struct lang_use *use)
{
    if (!is_scalar(use->operands[0]))
        return NULL;
    return use->op == IR_DOT         ? lang_form_of(spell->scratch, "$0 * $1", LANG_PREC_PRODUCT)
           : use->op == IR_NORMALIZE ? spell_call_form(spell, "sign($0)")
                                     : NULL;
}

/* ---- Constant expressions that have no value ---- */

/*
 * Such an expression is an error in WGSL, and elsewhere any number. The operand "@" stands in a
 * call of a function of the module, which makes no constant expression.
 */
static const struct {
    const char *text;
    uint8_t hidden, decide; /* the operand, and a bit for each operand that decides */
    uint8_t level;
} without_value[IR_NUM_OPS] = {
    [IR_ASIN] = {"asin(@)", 0, 1, LANG_PREC_POSTFIX},
    [IR_ACOS] = {"acos(@)", 0, 1, LANG_PREC_POSTFIX},
    [IR_ACOSH] = {"acosh(@)", 0, 1, LANG_PREC_POSTFIX},
    [IR_ATANH] = {"atanh(@)", 0, 1, LANG_PREC_POSTFIX},
    [IR_LOG] = {"log(@)", 0, 1, LANG_PREC_POSTFIX},
    [IR_LOG2] = {"log2(@)", 0, 1, LANG_PREC_POSTFIX},
    [IR_SQRT] = {"sqrt(@)", 0, 1, LANG_PREC_POSTFIX},
    [IR_RSQRT] = {"inverseSqrt(@)", 0, 1, LANG_PREC_POSTFIX},
    [IR_NORMALIZE] = {"normalize(@)", 0, 1, LANG_PREC_POSTFIX},
    [IR_ATAN2] = {"atan2(@, $1)", 0, 3, LANG_PREC_POSTFIX},
    [IR_POW] = {"pow(@, $T($1))", 0, 3, LANG_PREC_POSTFIX},
    [IR_SMOOTHSTEP] = {"smoothstep(@, $T($1), $T($2))", 0, 3, LANG_PREC_POSTFIX},
    [IR_CLAMP] = {"min(max($T($0), @), $T($2))", 1, 6, LANG_PREC_POSTFIX},
    [IR_DIV] = {"$0 / @", 1, 2, LANG_PREC_PRODUCT},
    [IR_REM] = {"$0 % @", 1, 2, LANG_PREC_PRODUCT},
};

/* The value of an operand: its constant, or 1, which stands for what does not decide. */
static struct ir_value value_of(const struct lang_use *use, unsigned operand)
{
    ir_type_id type = use->operands[operand];
    struct ir_value value = {.type = type};
    for (unsigned i = 0; i < ir_type_components(type); i++) {
        value.w[i].i = 1;
        if (ir_type_info(type)->scalar == IR_TYPE_FLOAT)
            value.w[i].f = 1.0f;
        if (use->constants[operand])
            value.w[i] = use->constants[operand][i];
    }
    return value;
}

static bool is_reversed(const struct ir_value *low, const struct ir_value *high)
{
    unsigned n = ir_type_components(low->type), m = ir_type_components(high->type);
    for (unsigned i = 0; i < n || i < m; i++) {
        union ir_word a = low->w[n > 1 ? i : 0], b = high->w[m > 1 ? i : 0];
        if (ir_type_info(low->type)->scalar == IR_TYPE_FLOAT ? a.f > b.f : a.i > b.i)
            return true;
    }
    return false;
}

static bool has_value(const struct lang_use *use)
{
    struct ir_value values[3], result;
    if (use->op == IR_NORMALIZE && is_scalar(use->type))
        return true;
    for (unsigned i = 0; i < use->num_operands; i++) {
        if (without_value[use->op].decide >> i & 1 && !use->constants[i])
            return true;
        values[i] = value_of(use, i);
    }
    return use->op == IR_CLAMP
               ? !is_reversed(&values[1], &values[2])
               : ir_eval_op(use->op, use->type, use->attr, values, use->num_operands, &result);
}

static const struct lang_pieces *hide(struct spell *spell, const struct lang_use *use)
{
    if (use->op >= IR_NUM_OPS || !without_value[use->op].text || !use->constants || has_value(use))
        return NULL;
    const char *text = without_value[use->op].text, *at = strchr(text, '@'),
               *type = spell_use_type(spell, use, use->type);
    struct text *form = spell_new_text(spell), *helper = spell_new_text(spell);
    text_fmt(helper, "fn wgsl_value_%s(x: %s) -> %s\n{\n    return x;\n}\n", type, type, type);
    spell_helper(spell, text_cstr(helper));
    text_mem(form, text, (size_t)(at - text));
    text_fmt(form, "wgsl_value_%s($T($%u))%s", type, without_value[use->op].hidden, at + 1);
    return lang_form_of(spell->scratch, text_cstr(form), without_value[use->op].level);
}

/* ---- Arrays of textures ---- */

static const struct lang_pieces *layers(struct spell *spell, const struct lang_use *use)
{
    static const struct {
        uint8_t helper;
        const char *name, *operands;
    } calls[IR_NUM_OPS] = {
        [IR_TEX] = {HELPER_LAYER_TEX, "wgsl_sample_layer", "$0, $0" LANG_SAMPLER_SUFFIX ", $1"},
        [IR_TEX_LOD] = {HELPER_LAYER_TEX_LOD, "wgsl_sample_layer_level",
                        "$0, $0" LANG_SAMPLER_SUFFIX ", $1, $2"},
        [IR_TEX_GRAD] = {HELPER_LAYER_TEX_GRAD, "wgsl_sample_layer_grad",
                         "$0, $0" LANG_SAMPLER_SUFFIX ", $1, $2, $3"},
        [IR_TEX_FETCH] = {HELPER_LAYER_FETCH, "wgsl_load_layer", "$0, $1, $2"},
    };
    if (use->operands[0] != IR_TYPE_SAMPLER_ARRAY)
        return NULL;
    if (use->op == IR_TEX && spell->style->syntax->without_neighbours)
        return helped(spell, use, HELPER_LAYER_TEX_LOD, "wgsl_sample_layer_level",
                      "$0, $0" LANG_SAMPLER_SUFFIX ", $1, 0.0");
    return helped(spell, use, calls[use->op].helper, calls[use->op].name, calls[use->op].operands);
}

/* ---- Assignments ---- */

/*
 * Only single components can be assigned. A helper makes the whole with the new parts:
 * "wgsl_with_xz_vec3f(v, parts)".
 */
static const struct lang_pieces *store(struct spell *spell, const struct lang_use *use)
{
    unsigned n = use->attr >> 8, rows = ir_type_rows(use->type);
    if (use->op != IR_SWIZZLE || n == 1)
        return NULL;
    const char *whole = spell_use_type(spell, use, use->type);
    struct text *name = spell_new_text(spell), *text = spell_new_text(spell),
                *call = spell_new_text(spell);
    text_str(name, "wgsl_with_");
    for (unsigned i = 0; i < n; i++)
        text_char(name, "xyzw"[use->attr >> 2 * i & 3]);
    text_fmt(name, "_%s", whole);
    text_fmt(text, "fn %s(v: %s, parts: %s) -> %s\n{\n    return %s(", text_cstr(name), whole,
             spell_use_type(spell, use, use->operands[1]), whole, whole);
    for (unsigned row = 0; row < rows; row++) {
        unsigned part = n;
        for (unsigned i = 0; i < n; i++)
            part = (use->attr >> 2 * i & 3) == row ? i : part;
        text_fmt(text, "%s%s.%c", row ? ", " : "", part < n ? "parts" : "v",
                 "xyzw"[part < n ? part : row]);
    }
    text_str(text, ");\n}\n");
    spell_helper(spell, text_cstr(text));
    text_fmt(call, "%s($0, $1)", text_cstr(name));
    return spell_call_form(spell, text_cstr(call));
}

/* ---- Hooks ---- */

typedef const struct lang_pieces *form_writer(struct spell *spell, const struct lang_use *use);

static form_writer *const writers[IR_NUM_OPS] = {
    [IR_ADD] = sum,
    [IR_SUB] = sum,
    [IR_DIV] = quotient,
    [IR_NEG] = negative,
    [IR_EQ] = equality,
    [IR_NE] = equality,
    [IR_SHL] = shift,
    [IR_SHR] = shift,
    [IR_AND] = bits,
    [IR_OR] = bits,
    [IR_XOR] = bits,
    [IR_SELECT] = choice,
    [IR_CONVERT] = convert,
    [IR_MIN] = spread_own,
    [IR_MAX] = spread_own,
    [IR_CLAMP] = spread_own,
    [IR_STEP] = spread_own,
    [IR_SMOOTHSTEP] = spread_own,
    [IR_POW] = spread_own,
    [IR_MOD] = modulo,
    [IR_ISNAN] = classify,
    [IR_ISINF] = classify,
    [IR_MATCOMPMULT] = each_product,
    [IR_INVERSE] = inverse,
    [IR_DOT] = of_scalars,
    [IR_NORMALIZE] = of_scalars,
    [IR_TEX] = layers,
    [IR_TEX_LOD] = layers,
    [IR_TEX_GRAD] = layers,
    [IR_TEX_FETCH] = layers,
};

const struct lang_pieces *wgsl_form(void *user_data, const struct lang_use *use)
{
    if (use->is_store)
        return store(user_data, use);
    const struct lang_pieces *hidden = hide(user_data, use);
    if (hidden)
        return hidden;
    return use->op < IR_NUM_OPS && writers[use->op] ? writers[use->op](user_data, use) : NULL;
}
