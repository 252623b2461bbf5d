// SPDX-License-Identifier: Apache-2.0
#include "slabs/hidden_slabs.h"

#include "slabs/slab_nodes.h"
#include "slabs/spots.h"

struct hiding {
    const struct ir_graph *graph;
    const struct slab_nodes *nodes;
    slab_is_opaque_fn *is_opaque;
    void *user_data;
    bool *hides; /* per node */
};

static bool operand_hides(const struct hiding *h, ir_ref ref, uint32_t operand)
{
    return h->hides[slab_node_at(h->nodes, ir_arg(h->graph, ref, operand))];
}

/* Parts beside each other hide where each of them does; of a layer one is enough. */
static bool node_hides(const struct hiding *h, ir_ref ref)
{
    const struct ir_graph *g = h->graph;
    const struct ir_node *node = ir_get(g, ref);
    if (node->type != IR_TYPE_BSDF)
        return false;
    switch (node->op) {
    case IR_SLAB:
        return ir_const_is(g, ir_arg(g, ref, SLAB_coverage), 1.0f)
               && h->is_opaque(h->user_data, ref);
    case IR_CLOSURE_MIX:
        return (slabs_is_absent(g, ref, 0) || operand_hides(h, ref, 0))
               && (slabs_is_absent(g, ref, 1) || operand_hides(h, ref, 1));
    case IR_CLOSURE_ADD: return operand_hides(h, ref, 0) && operand_hides(h, ref, 1);
    case IR_CLOSURE_SCALE: return operand_hides(h, ref, 0);
    default:
        return slabs_is_layer(g, ref) && (operand_hides(h, ref, 0) || operand_hides(h, ref, 1));
    }
}

/* Operands come before their operators. */
static void find_hiding(struct hiding *h, struct arena *scratch)
{
    h->hides = ARENA_ARRAY(scratch, bool, h->nodes->items.len);
    for (uint32_t i = 1; i < h->nodes->items.len; i++)
        h->hides[i] = node_hides(h, h->nodes->items.items[i]);
}

bool slabs_hides(const struct ir_graph *g, ir_ref matter, slab_is_opaque_fn *is_opaque,
                 void *user_data, struct arena *scratch)
{
    struct slab_nodes nodes;
    struct hiding h = {.graph = g, .nodes = &nodes, .is_opaque = is_opaque, .user_data = user_data};
    slabs_find_nodes(g, matter, scratch, &nodes);
    find_hiding(&h, scratch);
    return h.hides[nodes.items.len - 1];
}

static bool is_always_opaque(void *user_data, ir_ref slab)
{
    const struct ir_graph *g = user_data;
    return ir_const_is(g, ir_arg(g, slab, SLAB_mean_free_path), 0.0f);
}

static bool has_hidden_base(const struct hiding *h, ir_ref ref)
{
    const struct ir_graph *g = h->graph;
    return slabs_is_layer(g, ref) && operand_hides(h, ref, 0) && ir_arg(g, ref, 1)
           && ir_type_of(g, ir_arg(g, ref, 1)) == IR_TYPE_BSDF;
}

/* The top that hides a base has no medium that would need the thickness of the layer. */
ir_ref slabs_visible(struct ir_graph *g, ir_ref root, struct arena *scratch)
{
    struct slab_nodes nodes;
    struct hiding h = {.graph = g, .nodes = &nodes, .is_opaque = is_always_opaque, .user_data = g};
    slabs_find_nodes(g, root, scratch, &nodes);
    find_hiding(&h, scratch);
    ir_ref *by = ARENA_ARRAY(scratch, ir_ref, nodes.items.len);
    bool any = false;
    for (uint32_t i = 1; i < nodes.items.len; i++)
        if (has_hidden_base(&h, nodes.items.items[i])) {
            by[i] = ir_arg(g, nodes.items.items[i], 0);
            any = true;
        }
    return any ? slabs_replace(g, &nodes, by, scratch) : root;
}
