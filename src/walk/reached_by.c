// SPDX-License-Identifier: Apache-2.0
/*
 * For a fault inside a definition: the nodes of the document through which the builder reached it.
 */
#include "build/build_priv.h"

enum { MAX_TOLD = 8 };

/* The scope of the current node. */
static const struct instance *current_scope(const struct builder *b)
{
    if (b->frames.len == 0)
        return b->document;
    const struct frame *frame = &vec_last(&b->frames);
    assert(!frame->inner || frame->inner->parent == frame->scope);
    return frame->inner ? frame->inner : frame->scope;
}

/* True if a place lies in a nodegraph of a library image, which has no text to show. */
static bool is_in_image(const struct document *doc, elem_id graph, const char *file)
{
    const char *of_graph = doc_layer(doc, graph)->arena ? NULL : doc_place(doc, graph).file;
    return file && of_graph && strcmp(file, of_graph) == 0;
}

/*
 * Puts a fault inside a definition of a library image at the node that uses the definition. Returns
 * that node's scope: the way from there is left to tell.
 */
static const struct instance *leave_image(const struct document *doc, const struct instance *scope,
                                          struct diag_list *list)
{
    while (scope && scope->node && scope->graph
           && is_in_image(doc, scope->graph, list->items.items[list->last].place.file)) {
        diag_move(list, doc_place(doc, scope->node));
        scope = scope->parent;
    }
    return scope;
}

void build_trace(void *user_data, struct diag_list *list)
{
    const struct builder *b = user_data;
    const struct document *doc = &b->lib->doc;
    const struct instance *scope = leave_image(doc, current_scope(b), list);
    for (unsigned told = 0; scope && scope->node && scope->graph && told < MAX_TOLD;
         told++, scope = scope->parent)
        diag_add(list, DIAG_ID_used_by, doc_place(doc, scope->node),
                 build_text(b, doc_element(doc, scope->graph)->name),
                 build_text(b, doc_element(doc, scope->node)->name));
}
