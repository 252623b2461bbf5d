// SPDX-License-Identifier: Apache-2.0
/*
 * maker: functions that build a struct member by member, for languages whose constructors of
 * structs are missing or defective.
 */
#include "spell/spell.h"

#include <assert.h>

void spell_name_maker(struct spell *spell, ir_type_id type)
{
    assert(type >= IR_TYPE_FIRST_USER);
    spell_add_maker(spell, spell->shader->unit, type, spell->user_types[type - IR_TYPE_FIRST_USER]);
}

void spell_add_maker(struct spell *spell, const struct lang_unit *unit, ir_type_id type,
                     const char *type_name)
{
    struct text name;
    text_init(&name, spell->scratch);
    text_fmt(&name, "make_%s", type_name);
    const char *unique = names_unique(&spell->names, text_cstr(&name), name.len).text;
    vec_push(
        spell->scratch, &spell->makers,
        (struct spell_maker){.unit = unit, .type = type, .type_name = type_name, .name = unique});
}

struct spell_maker *spell_find_maker(const struct spell *spell, const char *type_name)
{
    for (uint32_t i = 0; i < spell->makers.len; i++)
        if (strcmp(spell->makers.items[i].type_name, type_name) == 0)
            return &spell->makers.items[i];
    return NULL;
}

static const char *member_name(const struct spell *spell, const struct ir_member *member)
{
    return lang_member_name(spell->style, spell->shader->strings, member->name);
}

/* "made", or a longer name that no member has. */
static const char *local_name(const struct spell *spell, const struct ir_member *members,
                              uint32_t count)
{
    struct text name;
    text_init(&name, spell->scratch);
    text_str(&name, "made");
    for (uint32_t i = 0; i < count; i++) {
        if (strcmp(member_name(spell, &members[i]), text_cstr(&name)) != 0)
            continue;
        text_char(&name, '_');
        i = UINT32_MAX; /* from the first member */
    }
    return text_cstr(&name);
}

void spell_write_maker(const struct spell *spell, const struct spell_maker *maker, struct text *out)
{
    const struct lang_unit *unit = maker->unit, *layer;
    const struct ir_user_type *user = lang_user_type(unit, maker->type, &layer);
    assert(user->array_length == 0 && user->first_member + user->num_members <= layer->members.len);
    const struct ir_member *members = layer->members.items + user->first_member;
    const char *made = local_name(spell, members, user->num_members);
    const struct lang_style *style = spell->style;
    const struct lang_names *names = unit == spell->shader->unit ? &spell->lang_names : NULL;
    const struct lang_type_text type = {lang_word(maker->type_name), 0};
    struct lang_declaration head =
        lang_open(style, PHRASE_FUNCTION, type, lang_word(maker->name), out);
    for (uint32_t i = 0; i < user->num_members; i++) {
        text_str(out, i ? ", " : "");
        lang_print_variable(style, names, unit, PHRASE_PARAM_ASSIGNED, members[i].type,
                            lang_word(member_name(spell, &members[i])), out);
    }
    lang_declare(style, &head, out);
    text_str(out, "\n{\n    ");
    (void)lang_open(style, PHRASE_LOCAL, type, lang_word(made), out);
    text_str(out, ";\n");
    for (uint32_t i = 0; i < user->num_members; i++) {
        const char *member = member_name(spell, &members[i]);
        text_fmt(out, "    %s.%s = %s;\n", made, member, member);
    }
    text_fmt(out, "    return %s;\n}\n", made);
}
