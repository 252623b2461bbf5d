// SPDX-License-Identifier: Apache-2.0
/* Printing what has no control flow: forms, types, values and the declarations at file scope. */
#include "lang/print.h"

#include <math.h>

/* Precedence an operand needs, by what stands around it in the form. */
static enum lang_precedence operand_precedence(const struct lang_form *form, unsigned index, char before, char after)
{
    bool opens = before == '(' || before == '[' || before == ',' || before == '{';
    bool closes = after == ')' || after == ']' || after == ',' || after == '}';
    if (opens && closes)
        return LANG_PREC_ASSIGN;
    enum lang_precedence own = (enum lang_precedence)form->precedence;
    if (own == LANG_PREC_TERNARY)
        return index == 0 ? LANG_PREC_LOR : LANG_PREC_TERNARY;
    return LANG_PREC_POSTFIX;
}

/* The length of what stands before the next '$'. */
static size_t literal_length(const char *text)
{
    size_t len = 0;
    while (text[len] && text[len] != '$')
        len++;
    return len;
}

void lang_write_form(const struct lang_form *form, const char *type_name, lang_operand_fn *operand, void *user_data,
                     struct text *out)
{
    const char *p = form->text;
    if (form->infix) { /* most of what there is: without looking around */
        operand(user_data, 0, (enum lang_precedence)form->precedence, out);
        text_mem(out, p + 2, literal_length(p + 2));
        operand(user_data, 1, (enum lang_precedence)form->precedence + 1, out);
        return;
    }
    for (;;) {
        size_t len = literal_length(p);
        text_mem(out, p, len);
        p += len;
        if (!*p)
            break;
        char before = p == form->text ? '\0' : p[-1] == ' ' ? p[-2] : p[-1];
        unsigned index = (unsigned)(p[1] - '0');
        if (p[1] == 'T')
            text_str(out, type_name);
        else
            operand(user_data, index, operand_precedence(form, index, before, p[2]), out);
        p += 2;
    }
}

const char *print_function_name(const struct lang_names *names, const struct lang_unit *unit, uint32_t id)
{
    const char *name = names && names->function ? names->function(names->user_data, id) : NULL;
    return name ? name : str_text(unit->strings, lang_function(unit, id, NULL)->name);
}

const char *print_global_name(const struct lang_names *names, const struct lang_unit *unit, uint32_t id)
{
    const char *name = names && names->global ? names->global(names->user_data, id) : NULL;
    return name ? name : str_text(unit->strings, lang_global(unit, id, NULL)->name);
}

static const char *struct_name(const struct lang_names *names, const struct lang_unit *unit, ir_type_id type)
{
    const char *name = names && names->user_type ? names->user_type(names->user_data, type) : NULL;
    return name ? name : str_text(unit->strings, lang_user_type(unit, type, NULL)->name);
}

void print_base_type(const struct lang_syntax *syntax, const struct lang_names *names, const struct lang_unit *unit,
                            ir_type_id type, struct text *out)
{
    while (ast_is_user_type(type) && lang_user_type(unit, type, NULL)->array_length)
        type = lang_user_type(unit, type, NULL)->element;
    text_str(out, ast_is_user_type(type) ? struct_name(names, unit, type) : lang_syntax_type(syntax, type));
}

void print_lengths(const struct lang_unit *unit, ir_type_id type, struct text *out)
{
    while (ast_is_user_type(type)) {
        const struct ir_user_type *user = lang_user_type(unit, type, NULL);
        if (!user->array_length)
            return;
        text_char(out, '[');
        text_u32(out, user->array_length);
        text_char(out, ']');
        type = user->element;
    }
}

void lang_print_type(const struct lang_syntax *syntax, const struct lang_names *names, const struct lang_unit *unit,
                     ir_type_id type, struct text *out)
{
    print_base_type(syntax, names, unit, type, out);
    print_lengths(unit, type, out);
}

void lang_print_variable(const struct lang_syntax *syntax, const struct lang_names *names, const struct lang_unit *unit,
                         ir_type_id type, const char *name, struct text *out)
{
    print_base_type(syntax, names, unit, type, out);
    text_char(out, ' ');
    text_str(out, name);
    print_lengths(unit, type, out);
}

static void print_float(const struct lang_syntax *syntax, float f, struct text *out)
{
    if (isnan(f) || isinf(f)) { /* no target has literals for these */
        text_str(out, isnan(f) ? "(0.0 / 0.0)" : f > 0 ? "(1.0 / 0.0)" : "(-1.0 / 0.0)");
        return;
    }
    text_float(out, f);
    if (syntax->float_literals_need_suffix)
        text_char(out, 'f');
}

static void print_scalar(const struct lang_syntax *syntax, ir_type_id type, union ir_word word, struct text *out)
{
    switch (type) {
    case IR_TYPE_BOOL:
        text_str(out, word.u ? "true" : "false");
        break;
    case IR_TYPE_INT:
        if (word.i == INT32_MIN) /* its digits alone are out of range */
            text_str(out, "(-2147483647 - 1)");
        else
            text_i32(out, word.i);
        break;
    case IR_TYPE_UINT:
        text_u32(out, word.u);
        text_char(out, 'u');
        break;
    default:
        print_float(syntax, word.f, out);
    }
}

/* How many scalars a constructor needs to build the value: 1 for a splat or a multiple of the identity. */
static unsigned count_needed(const struct ir_type_info *info, const union ir_word *w)
{
    unsigned rows = info->components / info->columns;
    for (unsigned i = 1; i < info->components; i++) {
        bool on_diagonal = info->columns == 1 || i / rows == i % rows;
        if (w[i].u != (on_diagonal ? w[0].u : 0u))
            return info->components;
    }
    return 1;
}

void lang_print_value(const struct lang_syntax *syntax, const struct strpool *strings, const struct ir_value *value,
                      struct text *out)
{
    const struct ir_type_info *info = ir_type_info(value->type);
    if (value->type == IR_TYPE_STRING) {
        text_json_string(out, str_text(strings, value->w[0].u), str_len(strings, value->w[0].u));
        return;
    }
    if (info->components == 1) {
        print_scalar(syntax, value->type, value->w[0], out);
        return;
    }
    text_str(out, lang_syntax_type(syntax, value->type));
    text_char(out, '(');
    unsigned count = count_needed(info, value->w);
    for (unsigned i = 0; i < count; i++) {
        if (i)
            text_mem(out, ", ", 2);
        print_scalar(syntax, info->scalar, value->w[i], out);
    }
    text_char(out, ')');
}

enum lang_precedence lang_value_precedence(const struct ir_value *value)
{
    bool negative = (value->type == IR_TYPE_FLOAT && signbit(value->w[0].f) && isfinite(value->w[0].f))
                    || (value->type == IR_TYPE_INT && value->w[0].i < 0 && value->w[0].i != INT32_MIN);
    return negative ? LANG_PREC_UNARY : LANG_PREC_PRIMARY;
}

/* A value of any type but structs from consecutive words; returns the word behind it. */
static const union ir_word *print_words(const struct lang_syntax *syntax, const struct lang_unit *unit, ir_type_id type,
                                        const union ir_word *words, struct text *out)
{
    if (!ast_is_user_type(type)) {
        struct ir_value value = ast_value(type, words);
        lang_print_value(syntax, unit->strings, &value, out);
        return words + ir_type_info(type)->components;
    }
    const struct ir_user_type *user = lang_user_type(unit, type, NULL);
    print_open_array(syntax, NULL, unit, type, out);
    for (uint32_t i = 0; i < user->array_length; i++) {
        if (i)
            text_mem(out, ", ", 2);
        words = print_words(syntax, unit, user->element, words, out);
    }
    text_char(out, syntax->array_braces ? '}' : ')');
    return words;
}

void print_open_array(const struct lang_syntax *syntax, const struct lang_names *names, const struct lang_unit *unit,
                      ir_type_id type, struct text *out)
{
    if (!syntax->array_braces)
        lang_print_type(syntax, names, unit, type, out);
    text_char(out, syntax->array_braces ? '{' : '(');
}

void lang_print_constant(const struct lang_syntax *syntax, const struct lang_names *names, const struct lang_unit *unit,
                         uint32_t global_id, struct text *out)
{
    const struct lang_unit *layer;
    const struct lang_global *global = lang_global(unit, global_id, &layer);
    text_str(out, "const ");
    lang_print_variable(syntax, names, unit, global->type, print_global_name(names, unit, global_id), out);
    text_str(out, " = ");
    print_words(syntax, unit, global->type, layer->words.items + global->words, out);
    text_str(out, ";\n");
}

void lang_print_struct(const struct lang_syntax *syntax, const struct lang_names *names, const struct lang_unit *unit,
                       ir_type_id type, struct text *out)
{
    const struct lang_unit *layer;
    const struct ir_user_type *user = lang_user_type(unit, type, &layer);
    text_str(out, "struct ");
    text_str(out, struct_name(names, unit, type));
    text_str(out, " {\n");
    for (uint32_t i = 0; i < user->num_members; i++) {
        const struct ir_member *member = &layer->members.items[user->first_member + i];
        text_str(out, "    ");
        lang_print_variable(syntax, names, unit, member->type, str_text(unit->strings, member->name), out);
        text_str(out, ";\n");
    }
    text_str(out, "};\n");
}
