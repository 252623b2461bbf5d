// SPDX-License-Identifier: Apache-2.0
/* Values of struct types. They are compiled in, because hosts have no uniforms for them. */
#include "build/build_priv.h"
#include "lower/lower.h"

ir_type_id build_type(const struct builder *b, doc_type type)
{
    return lang_graph_type(b->shader->unit, b->graph, library_type_ir(b->lib, type));
}

static ir_ref build_members(struct builder *b, doc_type type, struct text_word text,
                            bool is_default);

/* A value of a type; 0: the text is none. Without text, a default is that of its own members. */
static ir_ref build_value(struct builder *b, doc_type type, struct text_word text, bool is_default)
{
    struct ir_value value;
    ir_type_id ir = library_type_ir(b->lib, type);
    if (type >= DOC_TYPE_FIRST_USER)
        return build_members(b, type, text, is_default && !text.len);
    if (ir == IR_TYPE_STRING)
        return ir_const_string(b->graph, str_intern(b->shader->strings, text.bytes, text.len));
    const char *z = arena_strndup(b->arena, text.bytes, text.len);
    return doc_parse_value(type, z, text.len, b->shader->strings, &value)
               ? ir_const(b->graph, &value)
               : 0;
}

/* The default has the values of the members in the <typedef>, and no text. */
static ir_ref build_members(struct builder *b, doc_type type, struct text_word text,
                            bool is_default)
{
    struct member_values values;
    VEC(ir_ref) members = {0};
    if (!library_split_struct(b->lib, type, text, is_default, b->arena, &values))
        return 0;
    for (uint32_t i = 0; i < values.len; i++) {
        ir_ref member = build_value(b, values.items[i].type, values.items[i].text, is_default);
        if (!member)
            return 0;
        vec_push(b->arena, &members, member);
    }
    return ir_build(b->graph, IR_CONSTRUCT, build_type(b, type), 0, members.items, members.len);
}

ir_ref build_struct(struct builder *b, const struct port *port, str_id text, elem_id element)
{
    const char *z = build_text(b, text);
    struct text_word all = {z, strlen(z)};
    ir_ref value = build_members(b, port->type, all, all.len == 0);
    if (value)
        return value;
    library_report_struct(b->lib, port->type, z, doc_attr_place(build_doc(b), element, STR_value),
                          b->diags);
    return ir_poison(b->graph, build_type(b, port->type));
}
