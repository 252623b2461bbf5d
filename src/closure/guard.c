// SPDX-License-Identifier: Apache-2.0
/*
 * Which values need a branch where their weight is 0: those with a call or a texture that no other value has, and those whose inputs may be
 * undefined when nobody asks for them (a colour that is divided by what the weight is made of). All else is cheaper computed than jumped over,
 * and processors that mask branches instead of taking them compute it in any case.
 */
#include "closure/closure_priv.h"

enum { SHARED = UINT16_MAX };

static bool is_dear(enum ir_op op)
{
    return op == IR_CALL || op == IR_GRAPH_CALL || op == IR_VERBATIM || (op >= IR_TEX && op <= IR_TEX_FETCH && op != IR_TEX_SIZE);
}

static void claim(uint16_t *owner, uint16_t by)
{
    *owner = *owner == 0 || *owner == by ? by : SHARED;
}

/* Operands come before their node, so one pass down finds who owns each node. */
static void guard_dear(struct shader *shader, struct closure_part *parts, uint32_t count, bool in_loop)
{
    const struct ir_graph *g = shader->graph;
    ir_ref last = 0;
    for (uint32_t i = 0; i < count; i++)
        last = parts[i].value > last ? parts[i].value : last;
    uint16_t *owners = ARENA_ARRAY(shader->arena, uint16_t, last + 1);
    for (uint32_t i = 0; i < count; i++)
        claim(&owners[parts[i].value], i + 1 < SHARED ? (uint16_t)(i + 1) : SHARED);
    for (ir_ref ref = last; ref > 0; ref--) {
        const struct ir_node *node = ir_get(g, ref);
        if (!owners[ref] || (in_loop && !(node->flags & IR_NODE_LOOP)))
            continue;
        if (owners[ref] != SHARED && is_dear((enum ir_op)node->op))
            parts[owners[ref] - 1].is_guarded = true;
        const ir_ref *args = ir_args(g, ref);
        for (uint32_t i = 0; i < node->num_args; i++)
            claim(&owners[args[i]], owners[ref]);
    }
}

/* A constant, or never below one; a divisor must not be 0. */
static bool is_bounded(const struct ir_graph *g, ir_ref ref, bool is_divisor)
{
    const struct ir_node *node = ir_get(g, ref);
    if (node->op == IR_MAX || node->op == IR_CLAMP)
        ref = ir_arg(g, ref, 1);
    else if (node->op == IR_ABS)
        return !is_divisor;
    return ir_is_const(g, ref) && !(is_divisor && ir_const_is(g, ref, 0.0f));
}

/* Whether the node may be undefined where its operands are not. */
static bool is_partial(const struct ir_graph *g, ir_ref ref)
{
    switch (ir_get(g, ref)->op) {
    case IR_DIV:
    case IR_MOD:
        return !is_bounded(g, ir_arg(g, ref, 1), true);
    case IR_POW:
    case IR_SQRT:
    case IR_RSQRT:
    case IR_LOG:
    case IR_LOG2:
    case IR_ASIN:
    case IR_ACOS:
        return !is_bounded(g, ir_arg(g, ref, 0), false);
    default:
        return false;
    }
}

/* Whether one of the nodes that `refs` stand on, they among them, is partial, or is dear where that is asked, too. */
static bool reaches(struct shader *shader, const ir_ref *refs, unsigned count, bool or_dear)
{
    const struct ir_graph *g = shader->graph;
    const uint8_t *needed = ir_mark(g, refs, count, shader->arena);
    ir_ref last = 0;
    for (unsigned i = 0; i < count; i++)
        last = refs[i] > last ? refs[i] : last;
    for (ir_ref ref = 1; ref <= last; ref++)
        if (needed[ref] && (is_partial(g, ref) || (or_dear && is_dear((enum ir_op)ir_get(g, ref)->op))))
            return true;
    return false;
}

bool closure_may_guard(struct shader *shader, const ir_ref *inputs, unsigned count)
{
    bool have_operands = false;
    for (unsigned i = 0; i < count; i++)
        have_operands |= ir_get(shader->graph, inputs[i])->num_args > 0;
    return have_operands && reaches(shader, inputs, count, true);
}

void closure_find_guarded(struct shader *shader, struct closure_part *parts, uint32_t count, bool in_loop)
{
    const struct ir_graph *g = shader->graph;
    guard_dear(shader, parts, count, in_loop);
    for (uint32_t i = 0; i < count; i++)
        if (!parts[i].is_guarded && !ir_is_const(g, parts[i].leaf->scalar))
            parts[i].is_guarded = reaches(shader, ir_args(g, parts[i].leaf->leaf), ir_get(g, parts[i].leaf->leaf)->num_args, false);
}
