// SPDX-License-Identifier: Apache-2.0
/*
 * mark: the nodes that the roots need. Operands are older than their users, so one walk from the
 * newest node to the oldest is enough.
 */
#include "ir/ir.h"

#include <assert.h>

static void mark_results(const struct ir_graph *graph, const struct ir_function *function,
                         uint8_t *marked)
{
    for (uint32_t i = 0; i < function->num_results; i++)
        marked[graph->function_results.items[function->first_result + i]] = 1;
}

uint8_t *ir_mark(const struct ir_graph *graph, const ir_ref *roots, uint32_t num_roots,
                 struct arena *arena)
{
    uint8_t *marked = ARENA_ARRAY(arena, uint8_t, graph->nodes.len);
    for (uint32_t i = 0; i < num_roots; i++) {
        assert(roots[i] < graph->nodes.len);
        marked[roots[i]] = 1;
    }
    for (ir_ref ref = graph->nodes.len; --ref > 0;) {
        if (!marked[ref])
            continue;
        const struct ir_node *node = ir_get(graph, ref);
        const ir_ref *args = ir_args(graph, ref);
        for (uint32_t i = 0; i < node->num_args; i++)
            marked[args[i]] = 1;
        if (node->op == IR_GRAPH_CALL) /* the body is older than the call */
            mark_results(graph, &graph->functions.items[node->attr], marked);
    }
    marked[0] = 0; /* absent operands */
    return marked;
}

static bool is_poison(const struct ir_graph *graph, ir_ref ref)
{
    return ref && ir_get(graph, ref)->op == IR_POISON;
}

static ir_ref first_poison(const struct ir_graph *graph, const ir_ref *refs, uint32_t num_refs)
{
    for (uint32_t i = 0; i < num_refs; i++)
        if (is_poison(graph, refs[i]))
            return refs[i];
    return 0;
}

/* The arms of a SELECT do not count. */
static ir_ref used_poison(const struct ir_graph *graph, ir_ref ref)
{
    const struct ir_node *node = ir_get(graph, ref);
    ir_ref found =
        first_poison(graph, ir_args(graph, ref), node->op == IR_SELECT ? 1 : node->num_args);
    if (found || node->op != IR_GRAPH_CALL)
        return found;
    const struct ir_function *function = &graph->functions.items[node->attr];
    return first_poison(graph, graph->function_results.items + function->first_result,
                        function->num_results);
}

ir_ref ir_find_poison(const struct ir_graph *graph, const ir_ref *roots, uint32_t num_roots,
                      struct arena *arena)
{
    ir_ref ref = 1; /* nodes before the first poison use none */
    while (ref < graph->nodes.len && !is_poison(graph, ref))
        ref++;
    if (ref == graph->nodes.len)
        return 0;
    const uint8_t *marked = ir_mark(graph, roots, num_roots, arena);
    ir_ref found = first_poison(graph, roots, num_roots);
    for (; ref < graph->nodes.len && !found; ref++)
        if (marked[ref])
            found = used_poison(graph, ref);
    return found;
}
