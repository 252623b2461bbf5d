// SPDX-License-Identifier: Apache-2.0
/* Checks of a whole document against its library. */
#include "api/generation.h"

/* Definition and connections of a node, the connection of an output; doc_validate has looked at the rest. */
static void check_element(struct generation *g, elem_id element, struct resolve_out *resolved)
{
    const struct library *layer = &g->document->layer;
    struct diag_list *diags = &g->result->object.diagnostics.list;
    const struct element *e = doc_element(&layer->doc, element);
    if (e->kind == KIND_NODE) {
        resolved->bindings.len = 0;
        library_resolve_node(layer, element, resolved, diags);
    } else if (e->kind == KIND_OUTPUT && doc_element(&layer->doc, e->parent)->kind != KIND_NODE) {
        library_resolve_connection(layer, element, library_type(layer, doc_attr_value(&layer->doc, element, STR_type)), diags);
    }
}

static bool is_in_graph(const struct document *doc, elem_id element)
{
    elem_id parent = doc_element(doc, element)->parent;
    return parent == doc->root || (parent && doc_element(doc, parent)->kind == KIND_NODEGRAPH);
}

static void validate(struct generation *g)
{
    const struct library *layer = &g->document->layer;
    const struct document *doc = &layer->doc;
    struct diag_list *diags = &g->result->object.diagnostics.list;
    struct resolve_out resolved = {.arena = &g->scratch};
    doc_validate(doc, diags);
    for (elem_id e = doc->root; e; e = doc_next_in_tree(doc, doc->root, e))
        if (is_in_graph(doc, e))
            check_element(g, e, &resolved);
    for (uint32_t i = 0; layer->deferred && i < layer->deferred->items.len; i++)
        diag_repeat(diags, &layer->deferred->items.items[i]);
}

mxg_status mxg_document_validate(mxg_context *context, const mxg_document *document, mxg_result **out_result)
{
    return generation_run(context, document, NULL, validate, NULL, out_result);
}
