// SPDX-License-Identifier: Apache-2.0
/*
 * Shader groups as text for ShadingSystem::ShaderGroupBegin and testshade. Each layer has its
 * values, its shader and its connections.
 *
 *     param float amplitude 0.5 ;
 *     shader ND_noise2d_float NG_marble_noise ;
 *     connect NG_marble_place.out NG_marble_noise.texcoord ;
 */
#include "generators/osl/groups.h"
#include "generators/osl/osl.h"
#include "generators/osl/closure_tree.h"

#include <math.h>

static const char parts[] = "xyzw";

static const char *text_of(const struct network *network, str_id id)
{
    return str_text(network->strings, id);
}

static void write_float(float f, struct text *out)
{
    if (isinf(f) && signbit(f))
        text_char(out, '-');
    if (isfinite(f))
        text_float(out, f);
    else
        text_str(out, isnan(f) ? OSL_NAN : OSL_INFINITY);
}

static void write_numbers(const struct ir_value *value, unsigned count, struct text *out)
{
    bool is_float = ir_type_info(value->type)->scalar == IR_TYPE_FLOAT;
    for (unsigned i = 0; i < count; i++) {
        text_char(out, ' ');
        if (is_float)
            write_float(value->w[i].f, out);
        else
            text_i32(out, value->w[i].i);
    }
}

/* The upper left of a 4x4 matrix, whose rows are the IR's columns. */
static void write_matrix33(const struct ir_value *value, struct text *out)
{
    for (unsigned i = 0; i < 16; i++) {
        text_char(out, ' ');
        bool is_inside = i / 4 < 3 && i % 4 < 3;
        write_float(is_inside ? value->w[i / 4 * 3 + i % 4].f : i == 15 ? 1.0f : 0.0f, out);
    }
}

static void write_value(const struct network_input *input, const char *name, struct text *out)
{
    const struct ir_value *value = &input->value;
    unsigned count = ir_type_info(value->type)->components;
    for (unsigned i = 0; osl_is_struct(value->type) && i < count; i++) {
        text_fmt(out, "param float %s.%c ", name, parts[i]);
        write_float(value->w[i].f, out);
        text_str(out, " ;\n");
    }
    if (osl_is_struct(value->type))
        return;
    bool is_color = value->type == IR_TYPE_VEC3 && input->doc_type == STR_color3;
    text_fmt(out, "param %s %s", is_color ? "color" : lang_syntax_type(&osl_syntax, value->type),
             name);
    if (value->type == IR_TYPE_MAT3)
        write_matrix33(value, out);
    else
        write_numbers(value, count, out);
    text_str(out, " ;\n");
}

static void write_parameter(const struct network *network, const struct network_input *input,
                            const char *name, struct text *out)
{
    if (input->kind == NETWORK_VALUE)
        write_value(input, name, out);
    if (input->kind != NETWORK_FILE || !*text_of(network, input->file))
        return;
    const char *file = text_of(network, input->file);
    text_fmt(out, "param string %s ", name);
    text_json_string(out, file, strlen(file));
    text_str(out, " ;\n");
}

static void write_connection(const struct network *network, const struct network_input *input,
                             const char *layer, const char *name, struct text *out)
{
    if (input->kind != NETWORK_LAYER)
        return;
    const struct network_layer *from = &network->layers.items[input->layer];
    const struct network_node *node = &network->nodes.items[from->node];
    text_fmt(out, "connect %s.%s %s.%s ;\n", text_of(network, from->name),
             text_of(network, node->outputs[input->output]), layer, name);
}

static void write_layer(const struct network *network, const struct network_layer *layer,
                        struct text *out)
{
    const struct network_node *node = &network->nodes.items[layer->node];
    const struct network_input *inputs = network->inputs.items + layer->first_input;
    for (uint32_t i = 0; i < node->num_inputs; i++)
        if (node->inputs[i])
            write_parameter(network, &inputs[i], text_of(network, node->inputs[i]), out);
    text_fmt(out, "shader %s %s ;\n", text_of(network, node->name), text_of(network, layer->name));
    for (uint32_t i = 0; i < node->num_inputs; i++)
        if (node->inputs[i])
            write_connection(network, &inputs[i], text_of(network, layer->name),
                             text_of(network, node->inputs[i]), out);
}

static void write_end(const struct network *network, const struct osl_end *end, struct text *out)
{
    text_fmt(out, "shader %s %s ;\n", end->name, network->end_layer);
    for (unsigned i = 0; i < OSL_MAX_ENDS && end->inputs[i].parameter; i++)
        write_connection(network, &network->results[end->inputs[i].result], network->end_layer,
                         end->inputs[i].parameter, out);
}

static void write_network(const struct network *network, enum shader_stage_id stage,
                          struct text *out)
{
    const struct osl_program *program = osl_program_of(network);
    for (unsigned g = 0; g < program->num_groups; g++) {
        const struct osl_group *group = &program->groups[g];
        if (group->end->stage != stage)
            continue;
        for (uint32_t i = 0; i < network->layers.len; i++)
            if (group->needed[i])
                write_layer(network, &network->layers.items[i], out);
        if (osl_has_end(group))
            write_end(network, group->end, out);
    }
}

const struct target_network osl_network = {
    .end_layer = "root",
    .fits_family = osl_fits_family,
    .plan = osl_plan_network,
    .emit_node = osl_emit_node,
    .add_parts = osl_add_network_parts,
    .write = write_network,
    .topology = osl_network_topology,
    .reflect = osl_reflect_network,
};
