// SPDX-License-Identifier: Apache-2.0
/* Copies of values for a loop over lights or samples. */
#include "closure/closure_priv.h"

ir_ref closure_over_copies(struct closure_rewriting *r, ir_ref ref, ir_ref last)
{
    const struct ir_node node = *ir_get(r->graph, ref);
    ir_ref *args = ARENA_ARRAY(r->shader->arena, ir_ref, node.num_args + 1u);
    bool changed = last != 0;
    uint32_t n = 0;
    for (; n < node.num_args; n++) {
        ir_ref arg = ir_arg(r->graph, ref, n);
        args[n] = r->became[arg] ? r->became[arg] : arg;
        changed |= args[n] != arg;
    }
    if (last)
        args[n++] = last;
    return changed ? ir_build(r->graph, (enum ir_op)node.op, node.type, node.attr, args, n) : ref;
}

/* Nodes of a loop are younger than most others, so the pass down ends long before node 1. */
ir_ref closure_mark_loop(struct shader *shader, ir_ref root, uint8_t **out_needed)
{
    const struct ir_graph *g = shader->graph;
    uint8_t *needed = ARENA_ARRAY(shader->arena, uint8_t, root + 1);
    ir_ref ref = root + 1;
    uint32_t num_open = needed[root] = (ir_get(g, root)->flags & IR_NODE_LOOP) != 0;
    while (num_open > 0) {
        if (!needed[--ref])
            continue;
        num_open--;
        for (uint32_t i = 0; i < ir_get(g, ref)->num_args; i++) {
            ir_ref arg = ir_arg(g, ref, i);
            if (!(ir_get(g, arg)->flags & IR_NODE_LOOP) || needed[arg])
                continue;
            needed[arg] = 1;
            num_open++;
        }
    }
    *out_needed = needed;
    return ref;
}

static ir_ref root_of(const struct closure_rewriting *r, ir_ref root)
{
    return r->became[root] ? r->became[root] : root;
}

ir_ref closure_in_loop(struct shader *shader, ir_ref root, uint32_t loop)
{
    if (!loop || !root)
        return root;
    uint8_t *needed;
    ir_ref first = closure_mark_loop(shader, root, &needed);
    struct closure_rewriting r = {shader, shader->graph,
                                  ARENA_ARRAY(shader->arena, ir_ref, root + 1)};
    ir_ref number = ir_const_int(r.graph, (int32_t)loop);
    for (ir_ref ref = first; ref <= root; ref++) {
        if (!needed[ref])
            continue;
        const struct ir_node *node = ir_get(r.graph, ref);
        bool is_source = (node->op == IR_CONTEXT || node->op == IR_SAMPLE) && !node->num_args;
        ir_push_origin_of(r.graph, ref);
        r.became[ref] = closure_over_copies(&r, ref, is_source ? number : 0);
        ir_pop_origin(r.graph);
    }
    return root_of(&r, root);
}

ir_ref closure_chosen(struct shader *shader, ir_ref root, ir_ref choice, bool is_true)
{
    uint8_t *needed;
    ir_ref first = closure_mark_loop(shader, root, &needed);
    struct closure_rewriting r = {shader, shader->graph,
                                  ARENA_ARRAY(shader->arena, ir_ref, root + 1)};
    for (ir_ref ref = first; ref <= root; ref++) {
        if (!needed[ref])
            continue;
        ir_push_origin_of(r.graph, ref);
        bool is_choice = ir_get(r.graph, ref)->op == IR_SELECT && ir_arg(r.graph, ref, 0) == choice;
        r.became[ref] = is_choice ? root_of(&r, ir_arg(r.graph, ref, is_true ? 1 : 2))
                                  : closure_over_copies(&r, ref, 0);
        ir_pop_origin(r.graph);
    }
    return root_of(&r, root);
}
