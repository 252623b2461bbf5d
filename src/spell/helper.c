// SPDX-License-Identifier: Apache-2.0
/*
 * Helpers: functions that a language lacks, and the forms that call them. Both are made while a
 * stage is written and live as long.
 */
#include "spell/spell.h"

struct text *spell_new_text(struct spell *spell)
{
    struct text *text = ARENA_NEW(spell->scratch, struct text);
    text_init(text, spell->scratch);
    return text;
}

const struct lang_pieces *spell_call_form(struct spell *spell, const char *text)
{
    return lang_form_of(spell->scratch, text, LANG_PREC_POSTFIX);
}

const char *spell_use_type(struct spell *spell, const struct lang_use *use, ir_type_id type)
{
    struct text *text = spell_new_text(spell), *before = spell->out;
    spell->out = text;
    if (type < IR_TYPE_FIRST_USER || use->node)
        spell_type(spell, type);
    else
        spell_text(spell, spell->user_types[type - IR_TYPE_FIRST_USER]);
    spell->out = before;
    return text_cstr(text);
}

/* "vec3_bool" of "vec3<bool>" */
static void put_in_name(const char *type, struct text *out)
{
    for (; *type && *type != '>'; type++)
        text_char(out, *type == '<' ? '_' : *type);
}

void spell_expand(struct spell *spell, const struct lang_use *use, const char *from,
                  struct text *out)
{
    for (; *from; from++) {
        if (*from != '$') {
            text_char(out, *from);
            continue;
        }
        char mark = *++from;
        bool is_of_result = mark == 'T' || mark == 'S', is_name = mark == 'S' || mark == 'A';
        unsigned operand = is_of_result || is_name ? 0 : (unsigned)(mark - '0');
        const char *type =
            spell_use_type(spell, use, is_of_result ? use->type : use->operands[operand]);
        if (is_name)
            put_in_name(type, out);
        else
            text_str(out, type);
    }
}

void spell_helper(struct spell *spell, const char *text)
{
    for (uint32_t i = 0; i < spell->helpers.len; i++)
        if (strcmp(spell->helpers.items[i], text) == 0)
            return;
    vec_push(spell->scratch, &spell->helpers, text);
}

void spell_add_helper(struct spell *spell, const struct lang_use *use, const char *declaration)
{
    struct text *text = spell_new_text(spell);
    spell_expand(spell, use, declaration, text);
    spell_helper(spell, text_cstr(text));
}

const char *spell_helper_maker(void *user_data, const char *type)
{
    struct spell *spell = user_data;
    const struct spell_maker *maker = spell_find_maker(spell, type);
    struct text *text = spell_new_text(spell);
    spell_write_maker(spell, maker, text);
    spell_helper(spell, text_cstr(text));
    return maker->name;
}
