// SPDX-License-Identifier: Apache-2.0
/*
 * names: suggests names for nodes. A document node names its result; a library function names its
 * local variables, its parameters and its value.
 */
#include "ir/ir.h"

#include <assert.h>

static void suggest(struct ir_graph *graph, ir_ref ref, str_id name, unsigned rank)
{
    const struct ir_node *node = ir_get(graph, ref);
    struct ir_label *label = &graph->labels.items[ref];
    assert(graph->labels.len == graph->nodes.len);
    if (node->op == IR_CONST || rank < label->rank)
        return;
    /* the name of the nodegraph wins over the name of the node inside */
    bool is_inside =
        node->origin && graph->origin && graph->origins.items[node->origin].parent == graph->origin;
    if (rank > label->rank || (rank == IR_NAME_RESULT && is_inside)) {
        label->name = name;
        label->rank = (uint8_t)rank;
    }
}

/* A shader usually writes a vector of one scalar as this scalar, so both get the name. */
static ir_ref splatted(const struct ir_graph *graph, ir_ref ref)
{
    const struct ir_node *node = ir_get(graph, ref);
    return node->op == IR_CONSTRUCT && node->num_args == 1 ? ir_arg(graph, ref, 0) : 0;
}

void ir_suggest_name(struct ir_graph *graph, ir_ref ref, str_id name, unsigned rank)
{
    assert(rank <= IR_NAME_RESULT);
    for (; ref && name; ref = splatted(graph, ref))
        suggest(graph, ref, name, rank);
}
