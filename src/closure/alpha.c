// SPDX-License-Identifier: Apache-2.0
/*
 * The possible values of an alpha, from the graph. An alpha of only 0 and 1 (a cut-out) needs a
 * test but no blending.
 */
#include "closure/closure_priv.h"

#include <assert.h>

/*
 * True if an op over values that are 0 or 1 gives such a value. `is_binary` is valid for all nodes
 * below `ref`.
 */
static bool keeps_binary(const struct ir_graph *g, ir_ref ref, const bool *is_binary)
{
    const struct ir_node *node = ir_get(g, ref);
    const ir_ref *args = ir_args(g, ref);
    switch (node->op) {
    case IR_CONST: return ir_const_is(g, ref, 0.0f) || ir_const_is(g, ref, 1.0f);
    case IR_STEP: return true;
    case IR_CONVERT: return ir_type_of(g, args[0]) == IR_TYPE_BOOL || is_binary[args[0]];
    case IR_SELECT: return is_binary[args[1]] && is_binary[args[2]];
    case IR_SUB: return ir_const_is(g, args[0], 1.0f) && is_binary[args[1]];
    case IR_MUL:
    case IR_MIN:
    case IR_MAX:
    case IR_CLAMP:
    case IR_MIX:
        for (uint32_t i = 0; i < node->num_args; i++)
            if (!is_binary[args[i]])
                return false;
        return true;
    default: return false;
    }
}

enum shader_alpha closure_alpha(struct shader *shader, ir_ref alpha)
{
    const struct ir_graph *g = shader->graph;
    assert(ir_type_of(g, alpha) == IR_TYPE_FLOAT);
    bool *is_binary = ARENA_ARRAY(shader->arena, bool, alpha + 1);
    uint8_t *needed = ir_mark(g, &alpha, 1, shader->arena);
    for (ir_ref ref = 1; ref <= alpha; ref++)
        is_binary[ref] = needed[ref] && keeps_binary(g, ref, is_binary);
    return is_binary[alpha] ? ALPHA_MASK : ALPHA_BLEND;
}
