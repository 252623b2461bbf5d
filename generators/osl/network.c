// SPDX-License-Identifier: Apache-2.0
/*
 * Shader groups as the text that hosts give to ShadingSystem::ShaderGroupBegin, and testshade
 * takes: values, layer, connections, layer by layer.
 *
 *     param float amplitude 0.5 ;
 *     shader ND_noise2d_float NG_marble_noise ;
 *     connect NG_marble_place.out NG_marble_noise.texcoord ;
 */
#include "generators/osl/osl.h"
#include "generators/osl/tree.h"

static const char parts[] = "xyzw";

static const char *text_of(const struct network_group *group, str_id id)
{
    return str_text(group->network->strings, id);
}

static void write_numbers(const struct ir_value *value, unsigned count, struct text *out)
{
    bool is_float = ir_type_info(value->type)->scalar == IR_TYPE_FLOAT;
    for (unsigned i = 0; i < count; i++) {
        text_char(out, ' ');
        if (is_float)
            text_float(out, value->w[i].f);
        else
            text_i32(out, value->w[i].i);
    }
}

/* The upper left of a 4x4 matrix, whose rows are our columns. */
static void write_matrix33(const struct ir_value *value, struct text *out)
{
    for (unsigned i = 0; i < 16; i++) {
        text_char(out, ' ');
        bool is_inside = i / 4 < 3 && i % 4 < 3;
        text_float(out, is_inside ? value->w[i / 4 * 3 + i % 4].f : i == 15 ? 1.0f : 0.0f);
    }
}

static bool is_struct(ir_type_id type)
{
    return type == IR_TYPE_VEC2 || type == IR_TYPE_VEC4;
}

static void write_value(const struct network_group *group, const struct network_input *input,
                        const char *name, struct text *out)
{
    const struct ir_value *value = &input->value;
    unsigned count = ir_type_info(value->type)->components;
    for (unsigned i = 0; is_struct(value->type) && i < count; i++) {
        text_fmt(out, "param float %s.%c ", name, parts[i]);
        text_float(out, value->w[i].f);
        text_str(out, " ;\n");
    }
    if (is_struct(value->type))
        return;
    bool is_color =
        value->type == IR_TYPE_VEC3 && strcmp(text_of(group, input->doc_type), "color3") == 0;
    text_fmt(out, "param %s %s", is_color ? "color" : lang_syntax_type(&osl_syntax, value->type),
             name);
    if (value->type == IR_TYPE_MAT3)
        write_matrix33(value, out);
    else
        write_numbers(value, count, out);
    text_str(out, " ;\n");
}

static void write_parameter(const struct network_group *group, const struct network_input *input,
                            const char *name, struct text *out)
{
    if (input->kind == NETWORK_VALUE)
        write_value(group, input, name, out);
    if (input->kind != NETWORK_FILE || !*text_of(group, input->file))
        return;
    const char *file = text_of(group, input->file);
    text_fmt(out, "param string %s ", name);
    text_json_string(out, file, strlen(file));
    text_str(out, " ;\n");
}

static void write_connection(const struct network_group *group, const struct network_input *input,
                             const char *layer, const char *name, struct text *out)
{
    if (input->kind != NETWORK_LAYER)
        return;
    const struct network_layer *from = &group->network->layers.items[input->layer];
    const struct network_node *node = &group->network->nodes.items[from->node];
    text_fmt(out, "connect %s.%s %s.%s ;\n", text_of(group, from->name),
             text_of(group, node->outputs[input->output]), layer, name);
}

static void write_layer(const struct network_group *group, const struct network_layer *layer,
                        struct text *out)
{
    const struct network_node *node = &group->network->nodes.items[layer->node];
    const struct network_input *inputs = group->network->inputs.items + layer->first_input;
    for (uint32_t i = 0; i < node->num_inputs; i++)
        if (node->inputs[i])
            write_parameter(group, &inputs[i], text_of(group, node->inputs[i]), out);
    text_fmt(out, "shader %s %s ;\n", text_of(group, node->name), text_of(group, layer->name));
    for (uint32_t i = 0; i < node->num_inputs; i++)
        if (node->inputs[i])
            write_connection(group, &inputs[i], text_of(group, layer->name),
                             text_of(group, node->inputs[i]), out);
}

static void write_group(const struct network_group *group, struct text *out)
{
    for (uint32_t i = 0; i < group->network->layers.len; i++)
        if (group->needed[i])
            write_layer(group, &group->network->layers.items[i], out);
    if (!group->end->name)
        return;
    text_fmt(out, "shader %s %s ;\n", group->end->name, NETWORK_END_LAYER);
    for (unsigned i = 0; i < 2 && group->end->inputs[i]; i++)
        write_connection(group, &group->results[i], NETWORK_END_LAYER, group->end->inputs[i], out);
}

const struct target_network osl_network = {
    .ends =
        {
            [NETWORK_SURFACE] =
                {"mx_surface_root",
                 {"surfaceshader", "backsurfaceshader"},
                 "surface mx_surface_root(closure color surfaceshader = 0, closure color "
                 "backsurfaceshader = 0)\n{\n"
                 "    Ci = surfaceshader;\n    if (backfacing() && "
                 "isconnected(backsurfaceshader))\n        Ci = backsurfaceshader;\n}\n"},
            [NETWORK_VOLUME] = {"mx_volume_root",
                                {"volumeshader"},
                                "volume mx_volume_root(closure color volumeshader = 0)\n{\n    Ci "
                                "= volumeshader;\n}\n"},
            [NETWORK_DISPLACEMENT] =
                {"mx_displacement_root",
                 {"displacementshader"},
                 "displacement mx_displacement_root(vector displacementshader = 0)\n{\n"
                 "    P += displacementshader;\n    N = calculatenormal(P);\n}\n"},
        },
    .write = write_group,
    .emit_node = osl_emit_node,
};
