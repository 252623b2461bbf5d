// SPDX-License-Identifier: Apache-2.0
/*
 * Shares: numbers from 0 to 1, as weights of closures are. A value of a document may be any number,
 * so it is clamped where it becomes a share, unless the ops that make it keep it there.
 */
#include "ir/arithmetic.h"

enum { MAX_DEPTH = 4 };

static bool is_const_share(const struct ir_graph *g, ir_ref ref)
{
    struct ir_value value;
    if (!ir_get_const(g, ref, &value) || !ir_type_is_float(value.type))
        return false;
    for (unsigned i = 0; i < ir_type_info(value.type)->components; i++)
        if (!(value.w[i].f >= 0.0f && value.w[i].f <= 1.0f))
            return false;
    return true;
}

static bool is_share(const struct ir_graph *g, ir_ref ref, unsigned depth)
{
    const struct ir_node *node = ir_get(g, ref);
    if (node->op == IR_CONST)
        return is_const_share(g, ref);
    if (depth == MAX_DEPTH)
        return false;
    const ir_ref *args = ir_args(g, ref);
    unsigned first = 0;
    switch (node->op) {
    case IR_STEP:
    case IR_SMOOTHSTEP: return true;
    case IR_CLAMP: /* its bounds are enough */
    case IR_SELECT: first = 1; break;
    case IR_SUB:
        if (!ir_const_is(g, args[0], 1.0f))
            return false;
        break;
    case IR_CONVERT:
        if (ir_type_of(g, args[0]) == IR_TYPE_BOOL)
            return true;
        break;
    case IR_MUL:
    case IR_MIN:
    case IR_MAX:
    case IR_MIX:
    case IR_CONSTRUCT: break;
    default: return false;
    }
    for (unsigned i = first; i < node->num_args; i++)
        if (!is_share(g, args[i], depth + 1))
            return false;
    return true;
}

ir_ref ir_share(struct ir_graph *graph, ir_ref value)
{
    return !value || is_share(graph, value, 0) ? value : ir_saturate(graph, value);
}
