// SPDX-License-Identifier: Apache-2.0
/* What hosts choose about the output: the encoding of its colour, and transmission as alpha. */
#include "closure/closure_priv.h"

ir_ref closure_encoded(struct ir_graph *g, ir_ref color)
{
    ir_type_id type = ir_type_of(g, color);
    ir_ref positive = ir_op2(g, IR_MAX, color, ir_const_float(g, 0.0f));
    ir_ref power = ir_op2(g, IR_POW, positive, ir_const_splat(g, type, 1.0f / 2.4f));
    ir_ref curve = ir_op2(g, IR_SUB, ir_op2(g, IR_MUL, power, ir_const_float(g, 1.055f)),
                          ir_const_splat(g, type, 0.055f));
    ir_ref line = ir_op2(g, IR_MUL, color, ir_const_float(g, 12.92f));
    ir_ref is_curve = ir_op2(g, IR_STEP, ir_const_splat(g, type, 0.0031308f), color);
    return ir_op3(g, IR_MIX, line, curve, is_curve);
}

/* The operand of a leaf for an input, for example "tint"; 0: it has none. */
static ir_ref operand_of(const struct shader *shader, const struct closure_host *host, ir_ref leaf,
                         const char *input)
{
    const struct ir_node *node = ir_get(shader->graph, leaf);
    for (unsigned i = 0; i + 1 < node->num_args; i++) {
        const char *name = host->leaf_input(host->user_data, node->attr, i);
        if (!name)
            break;
        if (strcmp(name, input) == 0)
            return ir_arg(shader->graph, leaf, i + 1);
    }
    return 0;
}

static bool only_reflects(const struct shader *shader, const struct closure_host *host, ir_ref leaf)
{
    struct ir_value mode;
    ir_ref operand = operand_of(shader, host, leaf, "scatter_mode");
    return operand && ir_get_const(shader->graph, operand, &mode)
           && strcmp(str_text(shader->strings, mode.w[0].u), "R") == 0;
}

ir_ref closure_through(struct shader *shader, const struct closure_host *host, ir_ref leaf)
{
    if (closure_source(shader, leaf) || !closure_has(shader, host, leaf, LEAF_TRANSMISSION)
        || only_reflects(shader, host, leaf))
        return 0;
    ir_ref decay, throughput = closure_leaf_throughput(shader, host, leaf, &decay);
    return closure_mul(shader->graph, throughput, operand_of(shader, host, leaf, "tint"));
}
