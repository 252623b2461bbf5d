// SPDX-License-Identifier: Apache-2.0
/* Scopes: the nodes of the document, or of one use of a graph, and their results. */
#include "build/build_priv.h"

struct instance *build_new_instance(struct builder *b, struct instance *parent, elem_id graph)
{
    assert(doc_element(&b->lib->doc, graph)->kind == KIND_NODEGRAPH);
    struct instance *inner = ARENA_NEW(b->arena, struct instance);
    inner->parent = parent;
    inner->graph = graph;
    inner->depth = parent->depth + 1;
    const struct document *doc = &b->lib->doc;
    elem_id low = UINT32_MAX, high = 0;
    for (elem_id e = doc_element(doc, graph)->first_child; e; e = doc_element(doc, e)->next) {
        bool has_nodes = doc_element(doc, e)->kind == KIND_NODEGRAPH; /* of this scope */
        for (elem_id at = e; at; at = has_nodes ? doc_next_in_tree(doc, e, at) : 0) {
            low = at < low ? at : low;
            high = at > high ? at : high;
        }
    }
    inner->first = low;
    inner->num_slots = high >= low ? high - low + 1 : 0;
    inner->slots = ARENA_ARRAY(b->arena, uint32_t, inner->num_slots);
    return inner;
}

ir_ref build_result(struct builder *b, struct instance *scope, elem_id node, unsigned output,
                    doc_type type)
{
    uint32_t slot = *build_slot(scope, node);
    if (slot < SLOT_RESULTS)
        return ir_poison(b->graph, build_type(b, type));
    assert(slot - SLOT_RESULTS + output < b->results.len);
    return b->results.items[slot - SLOT_RESULTS + output];
}
