// SPDX-License-Identifier: Apache-2.0
/* Conversions and constructors by the table of a language. */
#include "print/print.h"

static const struct lang_pieces *form_of(const struct text *text, enum lang_precedence precedence)
{
    struct text copy = *text;
    return lang_form_of(text->arena, text_cstr(&copy), precedence);
}

/* "$0 * $T(1.0, 0.0, …)": a multiple of the identity. */
static const struct lang_pieces *diagonal(ir_type_id type, struct text *text)
{
    const struct ir_type_info *info = ir_type_info(type);
    unsigned rows = ir_type_rows(type);
    for (unsigned i = 0; i < info->components; i++) {
        text_str(text, i ? ", " : "$0 * $T(");
        text_str(text, i % (rows + 1) ? "0.0" : "1.0");
    }
    text_char(text, ')');
    return form_of(text, LANG_PREC_PRODUCT);
}

static const struct lang_pieces *of_scalar(const struct lang_syntax *syntax, ir_type_id type,
                                           struct text *text)
{
    if (ir_type_is_matrix(type))
        return syntax->exact_constructors ? diagonal(type, text) : NULL;
    if (!syntax->splat.text)
        return NULL;
    return lang_form_of(text->arena, syntax->splat.text,
                        (enum lang_precedence)syntax->splat.precedence);
}

/* The last operand may have more components than the constructor needs: "$T($0, $1.xy)". */
static const struct lang_pieces *cut_last(const struct lang_use *use, struct text *text)
{
    unsigned left = ir_type_components(use->type), last = use->num_operands - 1;
    for (unsigned i = 0; i < last; i++)
        left -= ir_type_components(use->operands[i]);
    if (ir_type_components(use->operands[last]) == left)
        return NULL;
    text_str(text, "$T(");
    for (unsigned i = 0; i < last; i++)
        text_fmt(text, "$%u, ", i);
    text_fmt(text, "$%u.%.*s)", last, (int)left, "xyzw");
    return form_of(text, LANG_PREC_POSTFIX);
}

/* "$0.xy": a vector without its last components. */
static const struct lang_pieces *cut(const struct lang_use *use, struct text *text)
{
    unsigned wanted = ir_type_components(use->type);
    if (ir_type_components(use->operands[0]) <= wanted || !ir_type_is_vector(use->type)
        || ir_type_is_matrix(use->operands[0]))
        return NULL;
    text_fmt(text, "$0.%.*s", (int)wanted, "xyzw");
    return form_of(text, LANG_PREC_POSTFIX);
}

const struct lang_pieces *lang_conversion(const struct lang_syntax *syntax,
                                          const struct lang_use *use, struct arena *arena)
{
    struct text text;
    bool converts = use->op == IR_CONVERT && !use->is_store;
    if ((!converts && use->op != IR_CONSTRUCT) || ir_type_components(use->type) <= 1)
        return NULL;
    text_init(&text, arena);
    if (use->num_operands == 1 && ir_type_components(use->operands[0]) == 1)
        return of_scalar(syntax, use->type, &text);
    if (!syntax->exact_constructors)
        return NULL;
    return converts ? cut(use, &text) : cut_last(use, &text);
}

const struct lang_pieces *lang_typed_form(const struct lang_syntax *syntax,
                                          const struct lang_names *names,
                                          const struct lang_use *use, struct arena *arena)
{
    const struct lang_pieces *own =
        names && names->form ? names->form(names->user_data, use) : NULL;
    return own ? own : lang_conversion(syntax, use, arena);
}
