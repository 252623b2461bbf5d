// SPDX-License-Identifier: Apache-2.0
/*
 * replace: one node in the place of another, in everything that a root reaches. If an IR function
 * reads the node, a copy of the function gets it as one more parameter, and its callers pass it on:
 *
 *     f(x) = x · N,  f(2)    with M for N:    f'(x, n) = x · n,  f'(2, M)
 *
 * A body stands before its calls, so functions in the order of their last result come after the
 * functions that they call.
 */
#include "ir/ir.h"

#include <assert.h>
#include <stdlib.h>

enum { MAX_FUNCTIONS = 1 << 16 };

struct replacement {
    struct ir_graph *graph;
    struct arena *arena;
    ir_ref from, to;
    uint32_t num_nodes; /* number of nodes before the replacement */
    uint8_t *reads;     /* per node: it depends on `from` */
    uint32_t *copied;   /* per function: its copy + 1 */
    uint32_t num_functions;
};

static const struct ir_function *function_at(const struct replacement *r, uint32_t index)
{
    return &r->graph->functions.items[index];
}

static bool function_reads(const struct replacement *r, uint32_t index)
{
    const struct ir_function *function = function_at(r, index);
    bool any = false;
    for (uint32_t i = 0; i < function->num_results; i++)
        any |= r->reads[r->graph->function_results.items[function->first_result + i]];
    return any;
}

/* Bodies and operands are older than their users, so one pass in array order is enough. */
static void find_readers(struct replacement *r)
{
    for (ir_ref ref = 1; ref < r->num_nodes; ref++) {
        const struct ir_node *node = ir_get(r->graph, ref);
        const ir_ref *args = ir_args(r->graph, ref);
        bool any = ref == r->from || (node->op == IR_GRAPH_CALL && function_reads(r, node->attr));
        for (uint32_t i = 0; i < node->num_args && !any; i++)
            any = r->reads[args[i]];
        r->reads[ref] = any;
    }
}

/*
 * Copies a node with new operands. `to` is the node that replaces `from` in this graph or
 * function.
 */
static ir_ref copy_node(struct replacement *r, ir_ref ref, const ir_ref *copies, ir_ref to)
{
    const struct ir_node node = *ir_get(r->graph, ref);
    assert(ref < r->num_nodes && ref != r->from);
    ir_ref *args = ARENA_ARRAY(r->arena, ir_ref, node.num_args + 1u);
    for (uint32_t i = 0; i < node.num_args; i++)
        args[i] = copies[ir_arg(r->graph, ref, i)];
    uint32_t attr = node.attr, num_args = node.num_args;
    if (node.op == IR_GRAPH_CALL && r->copied[attr]) {
        assert(r->copied[attr] - 1 >= r->num_functions);
        attr = r->copied[attr] - 1;
        args[num_args++] = to;
    }
    return ir_copy_as(r->graph, ref, node.type, attr, args, num_args);
}

/* The nodes that the roots depend on, without the bodies of functions. */
static uint8_t *mark_operands(const struct replacement *r, const ir_ref *roots, uint32_t num_roots)
{
    uint8_t *marked = ARENA_ARRAY(r->arena, uint8_t, r->num_nodes);
    for (uint32_t i = 0; i < num_roots; i++)
        marked[roots[i]] = 1;
    for (ir_ref ref = r->num_nodes; --ref > 0;)
        for (uint32_t i = 0; marked[ref] && i < ir_get(r->graph, ref)->num_args; i++)
            marked[ir_arg(r->graph, ref, i)] = 1;
    return marked;
}

/*
 * Copies the nodes that the roots reach, with `to` for `from`. Parameters of `function` become
 * parameters of `copy`. Returns the new node per old node.
 */
static ir_ref *copy_over(struct replacement *r, const ir_ref *roots, uint32_t num_roots,
                         uint32_t function, uint32_t copy, ir_ref to)
{
    const uint8_t *needed = mark_operands(r, roots, num_roots);
    ir_ref *copies = ARENA_ARRAY(r->arena, ir_ref, r->num_nodes);
    for (ir_ref ref = 1; ref < r->num_nodes; ref++) {
        copies[ref] = ref;
        if (!needed[ref])
            continue;
        const struct ir_node *node = ir_get(r->graph, ref);
        bool changed = r->reads[ref];
        for (uint32_t i = 0; i < node->num_args && !changed; i++)
            changed = copies[ir_arg(r->graph, ref, i)] != ir_arg(r->graph, ref, i);
        if (ref == r->from)
            copies[ref] = to;
        else if (node->op == IR_PARAM && copy && node->attr >> 16 == function)
            copies[ref] = ir_param(r->graph, copy - 1, node->attr & 0xffff);
        else if (changed)
            copies[ref] = copy_node(r, ref, copies, to);
    }
    return copies;
}

static void copy_function(struct replacement *r, uint32_t index)
{
    struct ir_graph *g = r->graph;
    const struct ir_function function = *function_at(r, index);
    ir_type_id *types = ARENA_ARRAY(r->arena, ir_type_id, function.num_params + 1);
    memcpy(types, g->param_types.items + function.first_param_type,
           function.num_params * sizeof *types);
    types[function.num_params] = ir_type_of(g, r->from);
    uint32_t copy = ir_add_function(g, function.name, types, function.num_params + 1);
    ir_ref *results = ARENA_ARRAY(r->arena, ir_ref, function.num_results);
    memcpy(results, g->function_results.items + function.first_result,
           function.num_results * sizeof *results);
    const ir_ref *copies = copy_over(r, results, function.num_results, index, copy + 1,
                                     ir_param(g, copy, function.num_params));
    for (uint32_t i = 0; i < function.num_results; i++)
        results[i] = copies[results[i]];
    ir_set_results(g, copy, results, function.num_results);
    assert(!r->copied[index] && copy >= r->num_functions);
    r->copied[index] = copy + 1;
}

struct ordered {
    uint32_t function;
    ir_ref last;
};

static int compare(const void *a, const void *b)
{
    ir_ref x = ((const struct ordered *)a)->last, y = ((const struct ordered *)b)->last;
    return (x > y) - (x < y);
}

static void copy_functions(struct replacement *r, const uint8_t *needed)
{
    struct ordered *readers = ARENA_ARRAY(r->arena, struct ordered, r->num_functions);
    uint32_t n = 0;
    for (uint32_t i = 0; i < r->num_functions; i++) {
        const struct ir_function *function = function_at(r, i);
        const ir_ref *results = r->graph->function_results.items + function->first_result;
        if (!function->num_results || !needed[results[0]] || !function_reads(r, i))
            continue;
        readers[n] = (struct ordered){i, 0};
        for (uint32_t k = 0; k < function->num_results; k++)
            readers[n].last = results[k] > readers[n].last ? results[k] : readers[n].last;
        n++;
    }
    /* a PARAM cannot number more functions: their bodies stay unchanged */
    if (r->num_functions + n > MAX_FUNCTIONS)
        return;
    if (n)
        qsort(readers, n, sizeof *readers, compare);
    for (uint32_t i = 0; i < n; i++)
        copy_function(r, readers[i].function);
}

ir_ref ir_replace(struct ir_graph *graph, ir_ref root, ir_ref from, ir_ref to, struct arena *arena)
{
    struct replacement r = {.graph = graph,
                            .arena = arena,
                            .from = from,
                            .to = to,
                            .num_nodes = graph->nodes.len,
                            .num_functions = graph->functions.len};
    assert(root < r.num_nodes && from < r.num_nodes && to < r.num_nodes);
    assert(ir_type_of(graph, from) == ir_type_of(graph, to));
    r.reads = ARENA_ARRAY(arena, uint8_t, r.num_nodes);
    r.copied = ARENA_ARRAY(arena, uint32_t, r.num_functions);
    find_readers(&r);
    if (!r.reads[root])
        return root;
    copy_functions(&r, ir_mark(graph, &root, 1, arena));
    return copy_over(&r, &root, 1, 0, 0, to)[root];
}
