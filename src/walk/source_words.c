// SPDX-License-Identifier: Apache-2.0
/*
 * Arguments of source that has values of its own for the words of an enumeration (specification,
 * "Implementation Elements": enumvalues and impltype).
 */
#include "build/build_priv.h"

/* The index of a constant in the enumeration of an input; -1: it is not there. */
static int index_of(struct builder *b, const struct port *port, const struct ir_value *value)
{
    const struct document *doc = build_doc(b);
    if (value->type == IR_TYPE_STRING)
        return library_enum_index(build_text(b, doc_attr_value(doc, port->element, STR_enum)),
                                  build_text(b, value->w[0].u));
    const char *list = build_text(b, doc_attr_value(doc, port->element, STR_enumvalues));
    struct text_word text;
    for (int i = 0; (text = library_enum_value(list, port->type, (unsigned)i)).len; i++) {
        struct ir_value one;
        if (doc_parse_value(port->type, text.bytes, text.len, NULL, &one)
            && memcmp(one.w, value->w, ir_type_components(value->type) * sizeof *one.w) == 0)
            return i;
    }
    return -1;
}

/* The value of the implementation at an index; poison after a message. */
static ir_ref value_at(struct builder *b, elem_id words, doc_type type, int index)
{
    const struct document *doc = build_doc(b);
    ir_type_id ir = build_type(b, type);
    const char *list = build_text(b, doc_attr_value(doc, words, STR_enumvalues));
    struct text_word text = library_enum_value(list, type, (unsigned)index);
    struct ir_value value;
    if (text.len && ir == IR_TYPE_STRING)
        return ir_const_string(b->graph, str_intern(b->shader->strings, text.bytes, text.len));
    if (text.len && doc_parse_value(type, text.bytes, text.len, b->shader->strings, &value))
        return ir_const(b->graph, &value);
    doc_report_value(type, build_text(b, library_type_name(b->lib, type)),
                     arena_strndup(b->arena, text.len ? text.bytes : "", text.len),
                     doc_attr_place(doc, words, STR_enumvalues), b->diags);
    return ir_poison(b->graph, ir);
}

static ir_ref resolve_word(struct builder *b, const struct frame *frame, const struct port *port,
                           elem_id words, ir_ref arg)
{
    doc_type type = library_source_type(b->lib, frame->impl->element, port);
    ir_type_id ir = build_type(b, type);
    struct ir_value value;
    if (ir_get(b->graph, arg)->op == IR_POISON)
        return ir_poison(b->graph, ir);
    if (!build_initial(b, arg, &value)) {
        diag_add(b->diags, DIAG_ID_input_must_be_constant,
                 doc_place(build_doc(b), frame->node.element), build_text(b, port->name),
                 build_text(b, library_nodedef(b->lib, frame->impl->nodedef)->node));
        return ir_poison(b->graph, ir);
    }
    int index = index_of(b, port, &value);
    if (index < 0 && type == port->type)
        return arg; /* the list need not be complete */
    return value_at(b, words, type, index < 0 ? 0 : index);
}

ir_ref *build_source_arguments(struct builder *b, const struct frame *frame)
{
    const struct nodedef *def = library_nodedef(b->lib, frame->impl->nodedef);
    const struct port *ports = library_ports(b->lib, frame->impl->nodedef, NULL);
    ir_ref *args = frame->args;
    if (!doc_element(build_doc(b), frame->impl->element)->first_child)
        return args;
    for (unsigned i = 0; i < def->num_inputs; i++) {
        elem_id words = library_source_words(b->lib, frame->impl->element, &ports[i]);
        if (!words)
            continue;
        if (args == frame->args) {
            args = ARENA_ARRAY(b->arena, ir_ref, def->num_inputs);
            memcpy(args, frame->args, def->num_inputs * sizeof *args);
        }
        args[i] = resolve_word(b, frame, &ports[i], words, args[i]);
    }
    return args;
}
