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
        args[n] = r->became[ir_arg(r->graph, ref, n)];
        changed |= args[n] != ir_arg(r->graph, ref, n);
    }
    if (last)
        args[n++] = last;
    return changed ? ir_build(r->graph, (enum ir_op)node.op, node.type, node.attr, args, n) : ref;
}

ir_ref closure_in_loop(struct shader *shader, ir_ref root, uint32_t loop)
{
    struct closure_rewriting r = {shader, shader->graph, NULL};
    uint32_t num_nodes = root + 1;
    if (!loop || !root || !(ir_get(r.graph, root)->flags & IR_NODE_LOOP))
        return root;
    ir_ref number = ir_const_int(r.graph, (int32_t)loop);
    const uint8_t *needed = ir_mark(r.graph, &root, 1, shader->arena);
    r.became = ARENA_ARRAY(shader->arena, ir_ref, num_nodes);
    for (ir_ref ref = 1; ref < num_nodes; ref++) {
        const struct ir_node *node = ir_get(r.graph, ref);
        r.became[ref] = ref;
        if (!needed[ref] || !(node->flags & IR_NODE_LOOP))
            continue;
        bool is_source = (node->op == IR_CONTEXT || node->op == IR_SAMPLE) && !node->num_args;
        ir_push_origin_of(r.graph, ref);
        r.became[ref] = closure_over_copies(&r, ref, is_source ? number : 0);
        ir_pop_origin(r.graph);
    }
    return r.became[root];
}

ir_ref closure_chosen(struct shader *shader, ir_ref root, ir_ref choice, bool is_true)
{
    struct closure_rewriting r = {shader, shader->graph, NULL};
    const uint8_t *needed = ir_mark(r.graph, &root, 1, shader->arena);
    r.became = ARENA_ARRAY(shader->arena, ir_ref, root + 1);
    for (ir_ref ref = 1; ref <= root; ref++) {
        r.became[ref] = ref;
        if (!needed[ref] || !(ir_get(r.graph, ref)->flags & IR_NODE_LOOP))
            continue;
        ir_push_origin_of(r.graph, ref);
        bool is_choice = ir_get(r.graph, ref)->op == IR_SELECT && ir_arg(r.graph, ref, 0) == choice;
        r.became[ref] = is_choice ? r.became[ir_arg(r.graph, ref, is_true ? 1 : 2)]
                                  : closure_over_copies(&r, ref, 0);
        ir_pop_origin(r.graph);
    }
    return r.became[root];
}
