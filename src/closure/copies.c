// SPDX-License-Identifier: Apache-2.0
/*
 * Copies of values: for a loop over lights or samples, or where a choice is known. Values share
 * copies, so a value that is copied after another one costs only the nodes that differ.
 */
#include "closure/closure_priv.h"

#include <assert.h>
#include <string.h>

#define OPEN UINT32_MAX /* needs a copy */

ir_ref *closure_room_for_copies(struct closure_copies *c, ir_ref last)
{
    uint32_t len = c->became.len;
    if (last >= len)
        memset(vec_extend(c->shader->arena, &c->became, last + 1 - len), 0,
               (last + 1 - len) * sizeof(ir_ref));
    return c->became.items;
}

ir_ref closure_over_copies(struct closure_copies *c, ir_ref ref, ir_ref last)
{
    struct ir_graph *g = c->shader->graph;
    const struct ir_node node = *ir_get(g, ref);
    ir_ref *args = ARENA_ARRAY(c->shader->arena, ir_ref, node.num_args + 1u);
    bool changed = last != 0;
    uint32_t n = 0;
    for (; n < node.num_args; n++) {
        ir_ref arg = ir_arg(g, ref, n), copy = c->became.items[arg];
        assert(copy != OPEN);
        args[n] = copy ? copy : arg;
        changed |= args[n] != arg;
    }
    if (last)
        args[n++] = last;
    return changed ? ir_copy_as(g, ref, node.type, node.attr, args, n) : ref;
}

static bool open(struct closure_copies *c, ir_ref ref)
{
    if (c->became.items[ref] || !(ir_get(c->shader->graph, ref)->flags & IR_NODE_LOOP))
        return false;
    c->became.items[ref] = OPEN;
    return true;
}

/*
 * Opens the nodes of a loop that `root` needs and that have no copy. Returns the first of them;
 * root + 1: there are none. Nodes of a loop are younger than most others, so the pass down ends
 * long before node 1.
 */
static ir_ref open_needed(struct closure_copies *c, ir_ref root)
{
    const struct ir_graph *g = c->shader->graph;
    closure_room_for_copies(c, root);
    ir_ref ref = root + 1;
    for (uint32_t num_open = open(c, root); num_open > 0;) {
        if (c->became.items[--ref] != OPEN)
            continue;
        num_open--;
        for (uint32_t i = 0; i < ir_get(g, ref)->num_args; i++)
            num_open += open(c, ir_arg(g, ref, i));
    }
    c->first = ref < c->first ? ref : c->first;
    return ref;
}

static ir_ref copy_of(const struct closure_copies *c, ir_ref ref)
{
    return c->became.items[ref] ? c->became.items[ref] : ref;
}

void closure_forget_copies(struct closure_copies *c)
{
    if (c->first < c->became.len)
        memset(c->became.items + c->first, 0, (c->became.len - c->first) * sizeof(ir_ref));
    c->first = UINT32_MAX;
}

void closure_enter_loop(struct closure_copies *c, uint32_t loop)
{
    if (c->loop != loop)
        closure_forget_copies(c);
    c->loop = loop;
}

ir_ref closure_in_loop(struct closure_copies *c, ir_ref root)
{
    if (!c->loop || !root)
        return root;
    struct ir_graph *g = c->shader->graph;
    ir_ref number = ir_const_int(g, (int32_t)c->loop);
    for (ir_ref ref = open_needed(c, root); ref <= root; ref++) {
        if (c->became.items[ref] != OPEN)
            continue;
        const struct ir_node *node = ir_get(g, ref);
        bool is_source = (node->op == IR_CONTEXT || node->op == IR_SAMPLE) && !node->num_args;
        c->became.items[ref] = closure_over_copies(c, ref, is_source ? number : 0);
    }
    return copy_of(c, root);
}

ir_ref closure_chosen(struct closure_copies *c, ir_ref root, ir_ref choice, bool is_true)
{
    struct ir_graph *g = c->shader->graph;
    for (ir_ref ref = open_needed(c, root); ref <= root; ref++) {
        if (c->became.items[ref] != OPEN)
            continue;
        bool is_choice = ir_get(g, ref)->op == IR_SELECT && ir_arg(g, ref, 0) == choice;
        c->became.items[ref] = is_choice ? copy_of(c, ir_arg(g, ref, is_true ? 1 : 2))
                                         : closure_over_copies(c, ref, 0);
    }
    return copy_of(c, root);
}

ir_ref closure_at_first_sample(struct closure_copies *c, ir_ref root)
{
    struct ir_graph *g = c->shader->graph;
    for (ir_ref ref = open_needed(c, root); ref <= root; ref++) {
        if (c->became.items[ref] != OPEN)
            continue;
        const struct ir_node *node = ir_get(g, ref);
        if (node->op != IR_SAMPLE)
            c->became.items[ref] = closure_over_copies(c, ref, 0);
        else
            c->became.items[ref] =
                node->attr == IR_SAMPLE_TURN ? closure_first_turn(g) : ir_const_int(g, 0);
    }
    return copy_of(c, root);
}

bool closure_reads_turn(struct closure_copies *c, ir_ref root)
{
    bool any = false;
    for (ir_ref ref = open_needed(c, root); ref <= root; ref++) {
        if (c->became.items[ref] != OPEN)
            continue;
        const struct ir_node *node = ir_get(c->shader->graph, ref);
        any |= node->op == IR_SAMPLE && node->attr == IR_SAMPLE_TURN;
        c->became.items[ref] = ref;
    }
    return any;
}

ir_ref closure_last_sample(struct closure_copies *c, ir_ref root)
{
    const struct ir_graph *g = c->shader->graph;
    ir_ref found = 0;
    for (ir_ref ref = open_needed(c, root); ref <= root; ref++) {
        if (c->became.items[ref] != OPEN)
            continue;
        c->became.items[ref] = ref;
        ir_ref condition = ir_get(g, ref)->op == IR_SELECT ? ir_arg(g, ref, 0) : 0;
        if (!condition || ir_get(g, condition)->op != IR_LT)
            continue;
        const struct ir_node *index = ir_get(g, ir_arg(g, condition, 0)),
                             *count = ir_get(g, ir_arg(g, condition, 1));
        if (index->op == IR_SAMPLE && !(count->flags & IR_NODE_LOOP))
            found = condition;
    }
    return found;
}
