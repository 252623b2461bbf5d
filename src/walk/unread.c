// SPDX-License-Identifier: Apache-2.0
/*
 * Inputs of a surface that the nodegraph of its model does not read: they are for other programs,
 * as the occlusion and the volume of glTF are, and no shader can show them.
 */
#include "build/build_priv.h"

/* True if the document connects the input, or gives it another value than its default. */
static bool is_authored(const struct builder *b, elem_id input, const struct port *port)
{
    const struct document *doc = build_doc(b);
    str_id value = doc_attr_value(doc, input, STR_value);
    return doc_is_connected(doc, input)
           || (value
               && !doc_is_same_value(port->type, build_text(b, value),
                                     port->value ? build_text(b, port->value) : ""));
}

void build_report_unread(struct builder *b, const struct graph_node *node, elem_id graph)
{
    const struct document *doc = build_doc(b);
    const struct nodedef *def = library_nodedef(b->lib, node->nodedef);
    const struct port *ports = library_ports(b->lib, node->nodedef, NULL);
    for (elem_id e = doc_element(doc, node->element)->first_child; e;
         e = doc_element(doc, e)->next) {
        str_id name = doc_element(doc, e)->name;
        int index = doc_element(doc, e)->kind == KIND_INPUT
                        ? library_find_input(b->lib, node->nodedef, name)
                        : -1;
        if (index >= 0 && is_authored(b, e, &ports[index])
            && !library_graph_reads(b->lib, graph, name))
            diag_add(b->diags, DIAG_ID_unread_input, doc_name_place(doc, e), build_text(b, name),
                     build_text(b, def->node));
    }
}
