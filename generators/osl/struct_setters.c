// SPDX-License-Identifier: Apache-2.0
/*
 * The structs of a shader's functions. oslc (1.15.6) drops a constructor's argument for a struct
 * member unless the argument is a constructor or call. So such structs have a function that assigns
 * each member.
 */
#include "generators/osl/osl.h"

bool osl_is_library_struct(const struct spell *spell, ir_type_id type)
{
    return type >= IR_TYPE_FIRST_USER
           && !lang_user_type(spell->shader->unit, type, NULL)->array_length;
}

static bool is_struct(const struct spell *spell, ir_type_id type)
{
    return osl_is_struct(type) || osl_is_library_struct(spell, type);
}

void osl_add_copier(struct osl *osl, ir_type_id type, const char *text)
{
    for (uint32_t i = 0; i < osl->copiers.len; i++)
        if (osl->copiers.items[i].type == type)
            return;
    vec_push(osl->spell->scratch, &osl->copiers, (struct osl_copier){type, text});
}

static bool has_struct(const struct spell *spell, ir_type_id type)
{
    const struct lang_unit *layer;
    const struct ir_user_type *user = lang_user_type(spell->shader->unit, type, &layer);
    bool any = false;
    for (uint32_t i = 0; i < user->num_members && !any; i++)
        any = is_struct(spell, layer->members.items[user->first_member + i].type);
    return any;
}

void osl_name_makers(struct osl *osl)
{
    const struct lang_reach *reach = &osl->spell->stage->reach;
    for (uint32_t i = 0; i < reach->user_types.len; i++)
        if (has_struct(osl->spell, reach->user_types.items[i]))
            spell_name_maker(osl->spell, reach->user_types.items[i]);
}

const char *osl_maker(void *user_data, const char *type)
{
    struct spell_maker *maker = spell_find_maker(user_data, type);
    if (maker)
        maker->is_called = true;
    return maker ? maker->name : NULL;
}

void osl_write_structs(struct osl *osl, struct text *out)
{
    struct spell *spell = osl->spell;
    const struct lang_reach *reach = &spell->stage->reach;
    for (uint32_t i = 0; i < reach->user_types.len; i++) {
        ir_type_id type = reach->user_types.items[i];
        lang_print_struct(spell->style, &spell->lang_names, spell->shader->unit, type, out);
        const struct spell_maker *maker =
            spell_find_maker(spell, spell->user_types[type - IR_TYPE_FIRST_USER]);
        if (maker && maker->is_called) {
            text_char(out, '\n');
            spell_write_maker(spell, maker, out);
        }
        for (uint32_t k = 0; k < osl->copiers.len; k++)
            if (osl->copiers.items[k].type == type)
                text_fmt(out, "\n%s", osl->copiers.items[k].text);
        text_char(out, '\n');
    }
}
