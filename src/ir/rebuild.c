// SPDX-License-Identifier: Apache-2.0
/*
 * rebuild: a pass that changes some nodes of a graph. It makes a new graph, node by node, and drops
 * the nodes that are not needed. Nodes keep their order, so an unchanged node keeps the
 * order of its operands.
 */
#include "ir/ir_priv.h"

struct rebuild {
    struct ir_graph *graph;
    struct ir_graph old;
    const struct ir_pass *pass;
    struct arena *arena;
    ir_ref *copies;   /* new node per old node */
    VEC(ir_ref) args; /* operands of the current node */
};

/* Types, callees, origins and functions keep their indices; functions lose their results. */
static void keep_tables(struct ir_graph *graph, const struct ir_graph *old)
{
    graph->origins = old->origins;
    graph->callees = old->callees;
    graph->callee_table = old->callee_table;
    graph->param_types = old->param_types;
    graph->user_types = old->user_types;
    graph->members = old->members;
    for (uint32_t i = 0; i < old->functions.len; i++) {
        vec_push(graph->arena, &graph->functions, old->functions.items[i]);
        graph->functions.items[i].num_results = 0;
    }
}

/*
 * The body of a function is older than its first call, so the copy of the body exists before the
 * call.
 */
static void complete_function(struct rebuild *r, uint32_t index)
{
    const struct ir_function *function = &r->old.functions.items[index];
    if (r->graph->functions.items[index].num_results)
        return;
    ir_ref *results = ARENA_ARRAY(r->arena, ir_ref, function->num_results);
    for (uint32_t i = 0; i < function->num_results; i++) {
        results[i] = r->copies[r->old.function_results.items[function->first_result + i]];
        assert(results[i]);
    }
    ir_set_results(r->graph, index, results, function->num_results);
}

static ir_ref copy_node(struct rebuild *r, ir_ref ref)
{
    const struct ir_node *node = ir_get(&r->old, ref);
    if (node->op == IR_CONST)
        return ir_const_words(r->graph, node->type, ir_constant_words(&r->old, ref));
    if (node->op == IR_GRAPH_CALL)
        complete_function(r, node->attr);
    const ir_ref *from = ir_args(&r->old, ref);
    r->args.len = 0;
    vec_reserve(r->arena, &r->args, node->num_args);
    for (uint32_t i = 0; i < node->num_args; i++) {
        assert(from[i] < ref && !from[i] == !r->copies[from[i]]);
        r->args.items[i] = r->copies[from[i]];
    }
    ir_ref other = r->pass->build(r->pass->user_data, r->graph, ref, node, r->args.items);
    return other ? other
                 : ir_intern(r->graph, (enum ir_op)node->op, node->type, node->attr, r->args.items,
                             node->num_args);
}

/*
 * A copy of one node gets its label. If a copy stands for several nodes, each suggests its
 * label.
 */
static void label_copy(struct rebuild *r, ir_ref ref)
{
    const struct ir_label *old = ir_label(&r->old, ref);
    struct ir_label *label = &r->graph->labels.items[r->copies[ref]];
    assert(r->copies[ref] && r->copies[ref] < r->graph->labels.len);
    if (!label->rank)
        *label = (struct ir_label){old->name, old->rank, label->is_shared};
    else if (old->name)
        ir_suggest_name(r->graph, r->copies[ref], old->name, old->rank);
    label->is_shared |= old->is_shared;
}

const ir_ref *ir_rebuild(struct ir_graph *graph, const uint8_t *needed, const struct ir_pass *pass,
                         struct arena *arena)
{
    struct rebuild r = {.graph = graph, .old = *graph, .pass = pass, .arena = arena};
    assert(graph->outer_origins.len == 0);
    r.copies = ARENA_ARRAY(arena, ir_ref, graph->nodes.len);
    ir_graph_init(graph, r.old.arena, r.old.strings);
    keep_tables(graph, &r.old);
    for (ir_ref ref = 1; ref < r.old.nodes.len; ref++) {
        if (!needed[ref])
            continue;
        graph->origin = ir_get(&r.old, ref)->origin;
        r.copies[ref] = copy_node(&r, ref);
        graph->origin = 0;
        label_copy(&r, ref);
        assert(ir_type_of(graph, r.copies[ref]) == ir_type_of(&r.old, ref));
    }
    assert(graph->outer_origins.len == 0 && graph->nodes.len <= r.old.nodes.len);
    graph->no_fold = r.old.no_fold;
    graph->exact = r.old.exact;
    graph->max_nodes = r.old.max_nodes;
    graph->has_no_neighbours = r.old.has_no_neighbours;
    graph->overflow = r.old.overflow;
    return r.copies;
}
