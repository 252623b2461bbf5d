// SPDX-License-Identifier: Apache-2.0
/* Prints names and values. */
#include "print/print_priv.h"

#include <assert.h>
#include <math.h>

const char *print_function_name(const struct lang_names *names, const struct lang_unit *unit,
                                uint32_t id)
{
    const char *name = names && names->function ? names->function(names->user_data, id) : NULL;
    return name ? name : str_text(unit->strings, lang_function(unit, id, NULL)->name);
}

const char *print_global_name(const struct lang_names *names, const struct lang_unit *unit,
                              uint32_t id)
{
    const char *name = names && names->global ? names->global(names->user_data, id) : NULL;
    return name ? name : str_text(unit->strings, lang_global(unit, id, NULL)->name);
}

const char *print_struct_name(const struct lang_names *names, const struct lang_unit *unit,
                              ir_type_id type)
{
    const char *name = names && names->user_type ? names->user_type(names->user_data, type) : NULL;
    return name ? name : str_text(unit->strings, lang_user_type(unit, type, NULL)->name);
}

const char *print_maker(const struct lang_names *names, const struct lang_unit *unit,
                        ir_type_id type)
{
    return names && names->maker
               ? names->maker(names->user_data, print_struct_name(names, unit, type))
               : NULL;
}

const char *print_array_name(const struct lang_names *names, struct lang_type_text type)
{
    return type.length && names && names->array
               ? names->array(names->user_data, type.name, type.length)
               : NULL;
}

enum { SHORT_FLOAT = 7 }; /* characters of a number that has no shorter form */

/*
 * A folded number may differ from a short one in the last bit: 1.0 - 0.8 gives 0.19999999. The
 * printer writes the short one if it has at most six digits and is not a whole number. A number may
 * differ from a whole number in one bit on purpose (0.99999994).
 */
static float shortened(float f)
{
    double scale = 1.0;
    for (int digits = 5 - (int)floor(log10(fabs((double)f))); digits > 0; digits--)
        scale *= 10.0;
    double rounded = round((double)f * scale) / scale;
    float near = (float)rounded;
    bool is_neighbour = near == nextafterf(f, near) && near != truncf(near);
    return is_neighbour && isfinite(near) ? near : f;
}

static void print_float(const struct lang_style *style, float f, struct text *out)
{
    if (!isfinite(f)) { /* docs/ir.md, "Infinities and NaN" */
        text_str(out, isinf(f) && signbit(f) ? "-" : "");
        text_str(out, isnan(f) ? style->syntax->nan : style->syntax->infinity);
        return;
    }
    size_t begin = out->len;
    text_float(out, f);
    if (out->len - begin > SHORT_FLOAT) {
        out->len = begin;
        text_float(out, shortened(f));
    }
    text_str(out, style->float_suffix);
}

static void print_scalar(const struct lang_style *style, ir_type_id type, union ir_word word,
                         struct text *out)
{
    if (style->syntax->plain_scalars && (type == IR_TYPE_BOOL || type == IR_TYPE_UINT))
        type = IR_TYPE_INT;
    switch (type) {
    case IR_TYPE_BOOL: text_str(out, word.u ? "true" : "false"); break;
    case IR_TYPE_INT:
        if (word.i == INT32_MIN) /* the digits alone are out of range */
            text_str(out, "(-2147483647 - 1)");
        else
            text_i32(out, word.i);
        break;
    case IR_TYPE_UINT:
        text_u32(out, word.u);
        text_char(out, 'u');
        break;
    default: print_float(style, word.f, out);
    }
}

/*
 * The number of scalars in a constructor of the value: 1 for a splat or a multiple of the identity.
 */
static unsigned count_needed(const struct ir_type_info *info, const union ir_word *w)
{
    unsigned rows = info->components / info->columns;
    assert(rows * info->columns == info->components);
    for (unsigned i = 1; i < info->components; i++) {
        bool on_diagonal = info->columns == 1 || i / rows == i % rows;
        if (w[i].u != (on_diagonal ? w[0].u : 0u))
            return info->components;
    }
    return 1;
}

/* A literal with a sign binds less tightly than one without. */
static bool has_sign(ir_type_id type, union ir_word word)
{
    return type == IR_TYPE_FLOAT ? signbit(word.f) && !isnan(word.f)
                                 : type == IR_TYPE_INT && word.i < 0 && word.i != INT32_MIN;
}

void lang_print_value(const struct lang_style *style, const struct strpool *strings,
                      ir_type_id type, const union ir_word *words, enum lang_precedence least,
                      struct text *out)
{
    const struct ir_type_info *info = ir_type_info(type);
    if (type == IR_TYPE_STRING) {
        text_json_string(out, str_text(strings, words->u), str_len(strings, words->u));
        return;
    }
    if (style->syntax->write_value && style->syntax->write_value(style, type, words, out))
        return;
    bool parentheses = least > LANG_PREC_UNARY && has_sign(type, *words);
    unsigned count = 1;
    if (info->components > 1) {
        bool lists = style->syntax->lists_components
                     || (style->syntax->exact_constructors && info->columns > 1);
        count = lists ? info->components : count_needed(info, words);
        text_put(out, style->types[type]);
        parentheses = true;
    }
    if (parentheses)
        text_char(out, '(');
    for (unsigned i = 0; i < count; i++) {
        if (i)
            text_mem(out, ", ", 2);
        print_scalar(style, info->scalar, words[i], out);
    }
    if (parentheses)
        text_char(out, ')');
}

const union ir_word *print_words(const struct lang_style *style, const struct lang_unit *unit,
                                 ir_type_id type, const union ir_word *words, struct text *out)
{
    if (!ast_is_user_type(type)) {
        lang_print_value(style, unit->strings, type, words, LANG_PREC_COMMA, out);
        return words + ir_type_info(type)->components;
    }
    const struct ir_user_type *user = lang_user_type(unit, type, NULL);
    assert(user->array_length > 0);
    print_open_array(style, NULL, unit, type, out);
    for (uint32_t i = 0; i < user->array_length; i++) {
        if (i)
            text_mem(out, ", ", 2);
        words = print_words(style, unit, user->element, words, out);
    }
    text_char(out, style->syntax->array_braces ? '}' : ')');
    return words;
}

void print_open_array(const struct lang_style *style, const struct lang_names *names,
                      const struct lang_unit *unit, ir_type_id type, struct text *out)
{
    if (!style->syntax->array_braces || style->phrases[PHRASE_ARRAY])
        lang_print_type(style, names, unit, type, out);
    text_char(out, style->syntax->array_braces ? '{' : '(');
}
