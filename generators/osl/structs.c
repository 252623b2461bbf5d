// SPDX-License-Identifier: Apache-2.0
/*
 * The structs of a shader's functions. Constructors of oslc (1.15.6) lose what stands for a member
 * that is a struct itself, unless it is a constructor or call: such structs have a function that
 * puts them together member by member.
 */
#include "generators/osl/osl.h"

static const struct ir_member *members_of(const struct spell *spell, ir_type_id type,
                                          uint32_t *out_count)
{
    const struct lang_unit *layer;
    const struct ir_user_type *user = lang_user_type(spell->shader->unit, type, &layer);
    *out_count = user->num_members;
    return layer->members.items + user->first_member;
}

static bool is_struct(const struct spell *spell, ir_type_id type)
{
    if (type >= IR_TYPE_FIRST_USER)
        return !lang_user_type(spell->shader->unit, type, NULL)->array_length;
    return type == IR_TYPE_VEC2 || type == IR_TYPE_VEC4 || type == IR_TYPE_IVEC2;
}

static bool has_struct(const struct spell *spell, ir_type_id type)
{
    uint32_t count;
    const struct ir_member *members = members_of(spell, type, &count);
    bool any = false;
    for (uint32_t i = 0; i < count && !any; i++)
        any = is_struct(spell, members[i].type);
    return any;
}

void osl_name_makers(struct osl *osl)
{
    struct spell *spell = osl->spell;
    const struct lang_reach *reach = &spell->stage->reach;
    for (uint32_t i = 0; i < reach->user_types.len; i++) {
        const char *type = spell->user_types[reach->user_types.items[i] - IR_TYPE_FIRST_USER];
        if (!has_struct(spell, reach->user_types.items[i]))
            continue;
        struct text name;
        text_init(&name, spell->scratch);
        text_fmt(&name, "make_%s", type);
        const char *unique = names_unique(&spell->names, text_cstr(&name), name.len).text;
        vec_push(spell->scratch, &osl->makers, (struct osl_maker){type, unique});
    }
}

const char *osl_maker(void *user_data, const char *type)
{
    const struct osl *osl = ((struct spell *)user_data)->target_data;
    for (uint32_t i = 0; i < osl->makers.len; i++)
        if (strcmp(osl->makers.items[i].type, type) == 0)
            return osl->makers.items[i].name;
    return NULL;
}

static const char *member_name(const struct spell *spell, const struct ir_member *member)
{
    return str_text(spell->shader->strings, member->name);
}

/* "made", or what no member is called. */
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
        i = UINT32_MAX; /* from the first one */
    }
    return text_cstr(&name);
}

/* "Outer make_Outer(vector2 a, float b) { Outer made; made.a = a; … return made; }" */
static void write_maker(const struct spell *spell, ir_type_id type, const char *maker,
                        struct text *out)
{
    uint32_t count;
    const struct ir_member *members = members_of(spell, type, &count);
    const char *made = local_name(spell, members, count),
               *name = spell->user_types[type - IR_TYPE_FIRST_USER];
    text_fmt(out, "\n%s %s(", name, maker);
    for (uint32_t i = 0; i < count; i++) {
        text_str(out, i ? ", " : "");
        lang_print_variable(spell->style, &spell->lang_names, spell->shader->unit, members[i].type,
                            member_name(spell, &members[i]), out);
    }
    text_fmt(out, ")\n{\n    %s %s;\n", name, made);
    for (uint32_t i = 0; i < count; i++)
        text_fmt(out, "    %s.%s = %s;\n", made, member_name(spell, &members[i]),
                 member_name(spell, &members[i]));
    text_fmt(out, "    return %s;\n}\n", made);
}

void osl_write_structs(const struct osl *osl, const char *functions, const char *shader,
                       struct text *out)
{
    struct spell *spell = osl->spell;
    const struct lang_reach *reach = &spell->stage->reach;
    for (uint32_t i = 0; i < reach->user_types.len; i++) {
        ir_type_id type = reach->user_types.items[i];
        lang_print_struct(spell->style, &spell->lang_names, spell->shader->unit, type, out);
        const char *maker = osl_maker(spell, spell->user_types[type - IR_TYPE_FIRST_USER]);
        if (maker && (osl_mentions(functions, maker) || osl_mentions(shader, maker)))
            write_maker(spell, type, maker, out);
        text_char(out, '\n');
    }
}
