// SPDX-License-Identifier: Apache-2.0
/* Prepares a syntax for printing: looks up the rows of its bases and parses its forms once. */
#include "print/print.h"

#include <assert.h>

void lang_style_init(struct lang_style *style, const struct lang_syntax *syntax,
                     struct arena *arena)
{
    *style = (struct lang_style){
        .syntax = syntax, .arena = arena, .from_images = syntax->in_images, .exports = ""};
    style->float_suffix = syntax->float_suffix ? syntax->float_suffix : "";
    for (ir_type_id type = 0; type < IR_NUM_TYPES; type++) {
        const char *name = lang_syntax_type(syntax, type);
        style->types[type] = (struct text_word){name, strlen(name)};
    }
    for (int phrase = 0; phrase < NUM_PHRASES; phrase++)
        style->phrases[phrase] = lang_syntax_phrase(syntax, (enum lang_phrase)phrase);
}

struct lang_style *lang_style_of_halves(const struct lang_style *style, struct arena *arena)
{
    const struct lang_syntax *syntax = style->syntax;
    while (syntax && !syntax->half_types)
        syntax = syntax->base;
    if (!syntax)
        return NULL;
    struct lang_style *halves = ARENA_NEW(arena, struct lang_style);
    *halves = *style;
    halves->float_suffix = syntax->half_suffix ? syntax->half_suffix : style->float_suffix;
    for (ir_type_id type = 0; type < IR_NUM_TYPES; type++)
        if (syntax->half_types[type])
            halves->types[type] =
                (struct text_word){syntax->half_types[type], strlen(syntax->half_types[type])};
    return halves;
}

/*
 * The precedence that operands of an infix operator need, where that is more than in C, by its own:
 * operators of different kinds stand between parentheses. WGSL requires it, and readers of other
 * languages, and their compilers, stumble without.
 */
static const uint8_t operand_levels[LANG_PREC_PRIMARY + 1] = {
    [LANG_PREC_LOR] = LANG_PREC_EQUAL,   [LANG_PREC_OR] = LANG_PREC_UNARY,
    [LANG_PREC_XOR] = LANG_PREC_UNARY,   [LANG_PREC_AND] = LANG_PREC_UNARY,
    [LANG_PREC_EQUAL] = LANG_PREC_SUM,   [LANG_PREC_COMPARE] = LANG_PREC_SUM,
    [LANG_PREC_SHIFT] = LANG_PREC_UNARY,
};

/*
 * True if an operand with the op of the form itself needs no parentheses: the first, "a | b | c",
 * and the others where the order of evaluation does not matter.
 */
static bool joins_operand(enum ir_op op, unsigned index)
{
    bool is_word = op == IR_AND || op == IR_OR || op == IR_XOR;
    return index == 0 ? is_word || op == IR_LOR : is_word || op == IR_LOR || op == IR_LAND;
}

/* The precedence that an operand needs, by the characters around it in the form. */
static enum lang_precedence operand_precedence(const struct lang_form *form, unsigned index,
                                               char before, char after)
{
    enum lang_precedence own = (enum lang_precedence)form->precedence;
    if (form->infix && operand_levels[own])
        return (enum lang_precedence)operand_levels[own];
    if (form->infix)
        return index == 0 ? own : own + 1;
    bool opens = before == '(' || before == '[' || before == ',' || before == '{';
    bool closes = after == ')' || after == ']' || after == ',' || after == '}';
    if (opens && closes)
        return LANG_PREC_ASSIGN;
    if (own == LANG_PREC_TERNARY)
        return index == 0 ? LANG_PREC_LOR : LANG_PREC_TERNARY;
    return LANG_PREC_POSTFIX;
}

/*
 * Compilers of some languages would build the vector at run time. Products have their own operation
 * for a scalar.
 */
static bool spreads_constants(const struct lang_syntax *syntax, enum ir_op op)
{
    uint8_t rule = ir_op_info(op)->rule;
    bool fits = rule == IR_RULE_SPLAT || (rule == IR_RULE_ARITH && op != IR_MUL);
    return fits && syntax->wide_constants && op != IR_REFRACT;
}

/* split->text is NULL if there is no form */
static void split_form(const struct lang_form *form, enum ir_op op, struct lang_pieces *split)
{
    split->text = form ? form->text : NULL;
    split->op = (uint16_t)op;
    split->num = 0;
    split->spreads = false;
    if (!split->text)
        return;
    split->precedence = form->precedence;
    split->infix = form->infix;
    const char *from = form->text, *p = from;
    for (; *p; p++) {
        if (*p != '$')
            continue;
        assert(split->num < LANG_MAX_PIECES);
        char before = p == form->text ? '\0' : p[-1] == ' ' ? p[-2] : p[-1];
        unsigned index = (unsigned)(p[1] - '0');
        assert(p[1] == 'T' || index < LANG_MAX_PIECES);
        split->pieces[split->num++] = (struct lang_piece){
            .before = {from, (size_t)(p - from)},
            .index = p[1] == 'T' ? LANG_PIECE_TYPE : (uint8_t)index,
            .least = p[1] == 'T' ? 0 : (uint8_t)operand_precedence(form, index, before, p[2]),
            .joins = form->infix && joins_operand(op, index),
        };
        from = p + 2;
        p++;
    }
    split->rest = (struct text_word){from, (size_t)(p - from)};
}

const struct lang_pieces *lang_form_of(struct arena *arena, const char *text,
                                       enum lang_precedence precedence)
{
    struct lang_pieces *form = ARENA_NEW(arena, struct lang_pieces);
    split_form(&(struct lang_form){text, (uint8_t)precedence, false}, IR_NUM_OPS, form);
    return form;
}

const struct lang_pieces *lang_style_split(struct lang_style *style, enum ir_op op)
{
    assert(!style->forms[op]);
    struct lang_pieces *split = style->forms[op] = arena_alloc(style->arena, sizeof *split);
    split_form(lang_syntax_form(style->syntax, op), op, split);
    split->spreads = split->text && spreads_constants(style->syntax, op);
    return split;
}
