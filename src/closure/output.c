// SPDX-License-Identifier: Apache-2.0
/* Hosts choose the encoding of the output's colour, and transmission as alpha. */
#include "closure/closure_priv.h"

#include "shader/formula.h"

#include <assert.h>

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
    return ir_product(shader->graph, throughput, operand_of(shader, host, leaf, "tint"));
}

static void write_value(struct shader *shader, str_id name, ir_ref value)
{
    uint32_t out = shader_output(shader, name, ir_type_of(shader->graph, value));
    shader_effect(shader, STAGE_PIXEL,
                  (struct effect){.kind = EFFECT_OUTPUT, .index = out, .value = value});
}

/* The second source of a blend: what the surface lets through, and 1 - alpha. */
static void write_second_source(struct shader *shader, ir_ref through, ir_ref alpha)
{
    struct ir_graph *g = shader->graph;
    ir_ref rest = ir_one_minus(g, alpha);
    through = through ? through : ir_convert(g, IR_TYPE_VEC3, rest);
    ir_ref parts[2] = {through, rest};
    bool is_member = shader->role->is_in_host_file;
    ir_ref value = is_member ? through : ir_construct(g, IR_TYPE_VEC4, parts, 2);
    const struct shader_variable variable = {.name = is_member ? STR_transmittance : STR_out2,
                                             .block = BLOCK_OUTPUTS,
                                             .type = ir_type_of(g, value),
                                             .semantic = STR_transmittance};
    uint32_t index = shader_add_variable(shader, &variable);
    shader_effect(shader, STAGE_PIXEL,
                  (struct effect){.kind = EFFECT_OUTPUT, .index = index, .value = value});
}

void closure_write_output(struct shader *shader, ir_ref color, ir_ref alpha, ir_ref through)
{
    struct ir_graph *g = shader->graph;
    assert(ir_type_of(g, color) == IR_TYPE_VEC3 && ir_type_of(g, alpha) == IR_TYPE_FLOAT);
    if (shader->role->is_in_host_file) {
        write_value(shader, STR_color, color);
        write_value(shader, STR_alpha, alpha);
    } else {
        ir_ref parts[2] = {color, alpha};
        write_value(shader, STR_out1, ir_construct(g, IR_TYPE_VEC4, parts, 2));
    }
    if (shader->has_two_sources)
        write_second_source(shader, through, alpha);
}

bool closure_emit_value(struct shader *shader, bool encodes, ir_ref root)
{
    struct ir_graph *g = shader->graph;
    ir_ref zero = ir_const_float(g, 0.0f);
    ir_type_id type = ir_type_of(g, root);
    if (type == IR_TYPE_BOOL || type == IR_TYPE_INT || type == IR_TYPE_UINT) {
        root = ir_convert(g, IR_TYPE_FLOAT, root);
        type = IR_TYPE_FLOAT;
    }
    ir_ref color = root, alpha = ir_const_float(g, 1.0f);
    bool is_color =
        shader->reflection.value_type == STR_color3 || shader->reflection.value_type == STR_color4;
    switch (type) {
    case IR_TYPE_FLOAT: color = ir_convert(g, IR_TYPE_VEC3, root); break;
    case IR_TYPE_VEC2: color = ir_construct(g, IR_TYPE_VEC3, (ir_ref[]){root, zero}, 2); break;
    case IR_TYPE_VEC3: break;
    case IR_TYPE_VEC4:
        color = ir_swizzle(g, root, (uint8_t[]){0, 1, 2}, 3);
        alpha = ir_component(g, root, 3);
        break;
    default: return false;
    }
    if (encodes && is_color)
        color = FORMULA(shader, "mx_srgb_encoded", color);
    closure_write_output(shader, color, alpha, 0);
    return true;
}
