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
    else if (spell->program)
        spell_text(spell, spell_program_type(spell, type));
    else
        spell_text(spell, spell->user_types[type - IR_TYPE_FIRST_USER]);
    spell->out = before;
    return text_cstr(text);
}

/* "array_vec3_bool_4" of "array<vec3<bool>, 4>" */
static void put_in_name(const char *type, struct text *out)
{
    static const char marks[] = "<>, ";
    for (size_t len; *type; type += len) {
        len = strcspn(type, marks);
        text_mem(out, type, len);
        len += strspn(type + len, marks);
        text_str(out, type[len] ? "_" : "");
    }
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

/* Writes a phrase with the type of an element, a name and a length. */
static void put_array_type(const char *phrase, struct text_word element, const char *name,
                           uint32_t length, struct text *out)
{
    for (char mark; (mark = lang_next(&phrase, out));) {
        if (mark == 'T')
            text_put(out, element);
        else if (mark == 'N')
            text_str(out, name);
        else
            text_u32(out, length);
    }
}

const char *spell_array_type(void *user_data, struct text_word element, uint32_t length)
{
    struct spell *spell = user_data;
    struct text *name_text = spell_new_text(spell), *text = spell_new_text(spell);
    text_put(name_text, element);
    text_fmt(name_text, "_%u", (unsigned)length);
    const char *name = text_cstr(name_text);
    put_array_type(spell->target->array_type, element, name, length, text);
    text_fmt(text, "\n%s make_%s(", name, name);
    for (uint32_t i = 0; i < length; i++) {
        text_str(text, i ? ", " : "");
        text_put(text, element);
        text_fmt(text, " e%u", (unsigned)i);
    }
    text_fmt(text, ")\n{\n    %s made;\n", name);
    for (uint32_t i = 0; i < length; i++)
        text_fmt(text, "    made[%u] = e%u;\n", (unsigned)i, (unsigned)i);
    text_str(text, "    return made;\n}\n");
    spell_helper(spell, text_cstr(text));
    return name;
}

const char *spell_program_type(struct spell *spell, ir_type_id type)
{
    const struct lang_unit *unit = spell->program->unit;
    struct lang_type_text text = lang_type_text(spell->style, NULL, unit, type);
    if (text.length && spell->target->array_type)
        return spell_array_type(spell, text.name, text.length);
    struct text name;
    text_init(&name, spell->scratch);
    lang_put_type(spell->style, text, &name);
    return text_cstr(&name);
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
