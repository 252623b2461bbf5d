// SPDX-License-Identifier: Apache-2.0
/*
 * Finds the values that need a branch around them for the case that their weight is 0: values with
 * a call or a texture read that no other value shares, and values whose inputs may be undefined at
 * weight 0 (for example a colour divided by a part of its weight). All other values cost less than
 * the branch; processors that mask branches compute them anyway.
 */
#include "closure/closure_priv.h"

#include <assert.h>

enum { SHARED = UINT16_MAX };

static bool is_dear(enum ir_op op)
{
    return op == IR_CALL || op == IR_GRAPH_CALL || op == IR_VERBATIM
           || (op >= IR_TEX && op <= IR_TEX_FETCH && op != IR_TEX_SIZE);
}

/* Returns true if no other part has claimed the node. */
static bool claim(uint16_t *owner, uint16_t by)
{
    assert(by > 0);
    bool is_new = *owner == 0;
    *owner = is_new || *owner == by ? by : SHARED;
    return is_new;
}

/*
 * Operands precede their node, so one downward pass finds the owner of each node. Only nodes with
 * IR_NODE_DEAR need an owner.
 */
static void guard_dear(struct shader *shader, struct closure_part *parts, uint32_t count,
                       bool in_loop)
{
    const struct ir_graph *g = shader->graph;
    unsigned wanted = IR_NODE_DEAR | (in_loop ? IR_NODE_LOOP : 0u);
    ir_ref last = 0;
    for (uint32_t i = 0; i < count; i++)
        last = parts[i].value > last ? parts[i].value : last;
    uint16_t *owners = ARENA_ARRAY(shader->arena, uint16_t, last + 1);
    uint32_t num_open = 0; /* nodes with a claim that the pass has not visited yet */
    for (uint32_t i = 0; i < count; i++)
        num_open += claim(&owners[parts[i].value], i + 1 < SHARED ? (uint16_t)(i + 1) : SHARED);
    for (ir_ref ref = last; ref > 0 && num_open > 0; ref--) {
        if (!owners[ref])
            continue;
        assert(num_open > 0);
        num_open--;
        const struct ir_node *node = ir_get(g, ref);
        if ((node->flags & wanted) != wanted)
            continue;
        if (owners[ref] != SHARED && is_dear((enum ir_op)node->op))
            parts[owners[ref] - 1].is_guarded = true;
        const ir_ref *args = ir_args(g, ref);
        for (uint32_t i = 0; i < node->num_args; i++)
            num_open += claim(&owners[args[i]], owners[ref]);
    }
}

/* True if a leaf's inputs, or the nodes that they depend on, include a partial node. */
static bool has_partial_input(const struct ir_graph *g, ir_ref leaf)
{
    unsigned flags = 0;
    for (uint32_t i = 1; i < ir_get(g, leaf)->num_args; i++)
        flags |= ir_get(g, ir_arg(g, leaf, i))->flags;
    return flags & IR_NODE_PARTIAL;
}

void closure_find_guarded(struct shader *shader, struct closure_parts *list, bool in_loop)
{
    const struct ir_graph *g = shader->graph;
    struct closure_part *parts = list->parts.items;
    uint32_t count = list->parts.len;
    guard_dear(shader, parts, count, in_loop);
    for (uint32_t i = 0; i < count; i++)
        if (!parts[i].is_guarded && !ir_is_const(g, parts[i].scalar))
            parts[i].is_guarded = has_partial_input(g, parts[i].leaf);
}
