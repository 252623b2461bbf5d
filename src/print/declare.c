// SPDX-License-Identifier: Apache-2.0
/* Declarations by the phrases of a language: variables, constants, structs. */
#include "print/print_priv.h"

#include <assert.h>

char lang_next(const char **phrase, struct text *out)
{
    const char *at = *phrase;
    for (; *at && *at != '$'; at++)
        text_char(out, *at);
    *phrase = *at ? at + 2 : at;
    return *at ? at[1] : '\0';
}

void lang_put_phrase(const char *phrase, struct text_word operand, struct text *out)
{
    while (lang_next(&phrase, out))
        text_put(out, operand);
}

/* ---- Types ---- */

struct lang_type_text lang_type_text(const struct lang_style *style, const struct lang_names *names,
                                     const struct lang_unit *unit, ir_type_id type)
{
    uint32_t length = 0;
    if (ast_is_user_type(type) && lang_user_type(unit, type, NULL)->array_length) {
        length = lang_user_type(unit, type, NULL)->array_length;
        type = lang_user_type(unit, type, NULL)->element;
    }
    struct text_word name = ast_is_user_type(type) ? lang_word(print_struct_name(names, unit, type))
                                                   : lang_type_name(style, names, type);
    return (struct lang_type_text){name, length};
}

static void put_length(uint32_t length, struct text *out)
{
    text_char(out, '[');
    text_u32(out, length);
    text_char(out, ']');
}

void lang_put_type(const struct lang_style *style, struct lang_type_text type, struct text *out)
{
    const char *array = type.length ? style->phrases[PHRASE_ARRAY] : NULL;
    if (!array) {
        text_put(out, type.name);
        if (type.length)
            put_length(type.length, out);
        return;
    }
    for (char mark; (mark = lang_next(&array, out));) {
        if (mark == 'T')
            text_put(out, type.name);
        else
            text_u32(out, type.length);
    }
}

void lang_print_type(const struct lang_style *style, const struct lang_names *names,
                     const struct lang_unit *unit, ir_type_id type, struct text *out)
{
    lang_put_type(style, lang_type_text(style, names, unit, type), out);
}

/* ---- Variables ---- */

void lang_declare(const struct lang_style *style, struct lang_declaration *d, struct text *out)
{
    bool length_follows = d->type.length && !style->phrases[PHRASE_ARRAY];
    for (char mark; (mark = lang_next(&d->rest, out)) && mark != 'V' && mark != 'P';) {
        if (mark == 'N') {
            text_put(out, d->name);
            if (length_follows)
                put_length(d->type.length, out);
        } else if (length_follows) {
            text_put(out, d->type.name);
        } else {
            lang_put_type(style, d->type, out);
        }
    }
}

void lang_print_variable(const struct lang_style *style, const struct lang_names *names,
                         const struct lang_unit *unit, enum lang_phrase phrase, ir_type_id type,
                         struct text_word name, struct text *out)
{
    (void)lang_open(style, phrase, lang_type_text(style, names, unit, type), name, out);
}

void lang_put_sampler(const struct lang_style *style, struct text_word texture, struct text *out)
{
    const char *type = style->syntax->sampler_type;
    if (!type)
        return;
    struct text name;
    text_init(&name, out->arena);
    text_put(&name, texture);
    text_str(&name, LANG_SAMPLER_SUFFIX);
    text_str(out, ", ");
    (void)lang_open(style, PHRASE_PLAIN, (struct lang_type_text){lang_word(type), 0},
                    (struct text_word){text_cstr(&name), name.len}, out);
}

void lang_print_constant(const struct lang_style *style, const struct lang_names *names,
                         const struct lang_unit *unit, uint32_t global_id, struct text *out)
{
    const struct lang_unit *layer;
    const struct lang_global *global = lang_global(unit, global_id, &layer);
    assert(global->words + global->num_words <= layer->words.len);
    bool is_local = style->syntax->arrays_are_local && ast_is_user_type(global->type);
    struct lang_declaration constant =
        lang_open(style, is_local ? PHRASE_LOCAL : PHRASE_CONSTANT,
                  lang_type_text(style, names, unit, global->type),
                  lang_word(print_global_name(names, unit, global_id)), out);
    text_str(out, is_local ? " = " : "");
    print_words(style, unit, global->type, layer->words.items + global->words, out);
    lang_declare(style, &constant, out);
    text_str(out, is_local ? ";\n" : "\n");
}

/* ---- Structs ---- */

static bool is_builtin(const char *name)
{
    for (int op = 0; op < IR_NUM_OPS; op++)
        if (ir_op_info((enum ir_op)op)->flags & OP_BUILTIN
            && strcmp(ir_op_info((enum ir_op)op)->text, name) == 0)
            return true;
    return false;
}

const char *lang_member_name(const struct lang_style *style, const struct strpool *strings,
                             str_id name)
{
    const char *text = str_text(strings, name);
    if (!lang_syntax_is_reserved(style->syntax, text, str_len(strings, name)) || is_builtin(text))
        return text;
    struct text longer;
    text_init(&longer, style->arena);
    text_fmt(&longer, "%s%s_", lang_syntax_beginning(style->syntax, text), text);
    return text_cstr(&longer);
}

void lang_print_struct(const struct lang_style *style, const struct lang_names *names,
                       const struct lang_unit *unit, ir_type_id type, struct text *out)
{
    const struct lang_unit *layer;
    const struct ir_user_type *user = lang_user_type(unit, type, &layer);
    assert(user->first_member + user->num_members <= layer->members.len);
    text_str(out, "struct ");
    text_str(out, print_struct_name(names, unit, type));
    text_str(out, " {\n");
    for (uint32_t i = 0; i < user->num_members; i++) {
        const struct ir_member *member = &layer->members.items[user->first_member + i];
        text_str(out, "    ");
        lang_print_variable(style, names, unit, PHRASE_MEMBER, member->type,
                            lang_word(lang_member_name(style, unit->strings, member->name)), out);
        text_char(out, '\n');
    }
    text_str(out, style->phrases[PHRASE_STRUCT_END]);
    text_char(out, '\n');
}
