// SPDX-License-Identifier: Apache-2.0
/*
 * Values of struct types, "{0.5;{1, 2};true}": one value per member (specification, "Custom Data
 * Types"). They are compiled in, because hosts have no uniforms for them.
 */
#include "build/build_priv.h"
#include "lower/lower.h"

ir_type_id build_type(const struct builder *b, doc_type type)
{
    return lang_graph_type(b->shader->unit, b->graph, library_type_ir(b->lib, type));
}

static struct text_word trimmed(struct text_word word)
{
    while (word.len && strchr(" \t\r\n", word.bytes[0]))
        word = (struct text_word){word.bytes + 1, word.len - 1};
    while (word.len && strchr(" \t\r\n", word.bytes[word.len - 1]))
        word.len--;
    return word;
}

/* The text of the first member in `*rest`, without blanks around it; moves past its ';'. */
static struct text_word next_member(struct text_word *rest)
{
    size_t len = 0, depth = 0;
    for (; len < rest->len && (depth || rest->bytes[len] != ';'); len++) {
        depth += rest->bytes[len] == '{';
        depth -= depth > 0 && rest->bytes[len] == '}';
    }
    struct text_word member = {rest->bytes, len};
    size_t past = len < rest->len ? len + 1 : len;
    *rest = (struct text_word){rest->bytes + past, rest->len - past};
    return trimmed(member);
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
    const struct document *doc = &b->lib->doc;
    elem_id typedef_ = library_typedef(b->lib, type);
    VEC(ir_ref) members = {0};
    if (!is_default && (text.bytes[0] != '{' || text.bytes[text.len - 1] != '}' || text.len < 2))
        return 0;
    struct text_word rest = is_default ? text : (struct text_word){text.bytes + 1, text.len - 2};
    for (elem_id e = doc_element(doc, typedef_)->first_child; e; e = doc_element(doc, e)->next) {
        doc_type of_member = library_type(b->lib, doc_attr_value(doc, e, STR_type));
        if (doc_element(doc, e)->kind != KIND_MEMBER || !of_member)
            continue;
        const char *own = build_text(b, doc_attr_value(doc, e, STR_value));
        struct text_word value =
            is_default ? (struct text_word){own, strlen(own)} : next_member(&rest);
        ir_ref member = build_value(b, of_member, value, is_default);
        if (!member)
            return 0;
        vec_push(b->arena, &members, member);
    }
    bool is_whole = rest.len == 0 && members.len > 0;
    return is_whole ? ir_build(b->graph, IR_CONSTRUCT, build_type(b, type), 0, members.items,
                               members.len)
                    : 0;
}

ir_ref build_struct(struct builder *b, const struct port *port, str_id text, elem_id element)
{
    const char *z = build_text(b, text);
    struct text_word all = trimmed((struct text_word){z, strlen(z)});
    ir_ref value = build_members(b, port->type, all, all.len == 0);
    if (value)
        return value;
    diag_add(b->diags, DIAG_ID_bad_value, doc_attr_place(build_doc(b), element, STR_value), z,
             build_text(b, library_type_name(b->lib, port->type)),
             ": a value of a struct has one value per member, as in '{0.5;true}'");
    return ir_poison(b->graph, build_type(b, port->type));
}
