// SPDX-License-Identifier: Apache-2.0
/*
 * The structs of a shader's functions. oslc (1.15.6) drops a constructor's argument for a struct
 * member unless the argument is a constructor or call. So such structs have a function that assigns
 * each member.
 */
#include "generators/osl/osl.h"

#include <assert.h>

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

static const char *type_name(const struct spell *spell, ir_type_id type)
{
    return spell->user_types[type - IR_TYPE_FIRST_USER];
}

void osl_name_makers(struct osl *osl)
{
    struct spell *spell = osl->spell;
    const struct lang_reach *reach = &spell->stage->reach;
    for (uint32_t i = 0; i < reach->user_types.len; i++) {
        ir_type_id type = reach->user_types.items[i];
        if (!has_struct(spell, type))
            continue;
        struct text name;
        text_init(&name, spell->scratch);
        text_fmt(&name, "make_%s", type_name(spell, type));
        const char *unique = names_unique(&spell->names, text_cstr(&name), name.len).text;
        vec_push(spell->scratch, &osl->makers, (struct osl_maker){.type = type, .name = unique});
    }
}

const char *osl_maker(void *user_data, const char *type)
{
    const struct spell *spell = user_data;
    struct osl *osl = spell->target_data;
    for (uint32_t i = 0; i < osl->makers.len; i++) {
        struct osl_maker *maker = &osl->makers.items[i];
        if (strcmp(type_name(spell, maker->type), type) != 0)
            continue;
        maker->is_called = true;
        return maker->name;
    }
    return NULL;
}

static const char *member_name(const struct spell *spell, const struct ir_member *member)
{
    return str_text(spell->shader->strings, member->name);
}

/* "made", or another name that no member has. */
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
        i = UINT32_MAX; /* restarts the search */
    }
    return text_cstr(&name);
}

/* "Outer make_Outer(vector2 a, float b) { Outer made; made.a = a; … return made; }" */
static void write_maker(const struct spell *spell, ir_type_id type, const char *maker,
                        struct text *out)
{
    uint32_t count;
    const struct ir_member *members = members_of(spell, type, &count);
    const char *made = local_name(spell, members, count), *name = type_name(spell, type);
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

void osl_write_structs(struct osl *osl, struct text *out)
{
    struct spell *spell = osl->spell;
    const struct lang_reach *reach = &spell->stage->reach;
    uint32_t next = 0; /* makers follow the order of their types */
    for (uint32_t i = 0; i < reach->user_types.len; i++) {
        ir_type_id type = reach->user_types.items[i];
        lang_print_struct(spell->style, &spell->lang_names, spell->shader->unit, type, out);
        if (next < osl->makers.len && osl->makers.items[next].type == type) {
            const struct osl_maker *maker = &osl->makers.items[next++];
            if (maker->is_called)
                write_maker(spell, type, maker->name, out);
        }
        text_char(out, '\n');
    }
    assert(next == osl->makers.len);
}
