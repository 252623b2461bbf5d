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

void build_trace(void *user_data, struct diag_list *list)
{
    const struct builder *b = user_data;
    const struct document *doc = &b->lib->doc;
    const struct instance *scope = current_scope(b);
    for (unsigned told = 0; scope && scope->node && scope->graph && told < MAX_TOLD;
         told++, scope = scope->parent)
        diag_add(list, DIAG_ID_used_by, doc_place(doc, scope->node),
                 build_text(b, doc_element(doc, scope->graph)->name),
                 build_text(b, doc_element(doc, scope->node)->name));
}
