// SPDX-License-Identifier: Apache-2.0
/* Networks in the reflection: groups with their layers, and the shaders (docs/reflection.md). */
#include "generators/osl/groups.h"
#include "shader/json.h"

/* The layer that an input is connected to. */
static void put_source(struct json *json, const struct network *network,
                       const struct network_input *input)
{
    const struct network_layer *from = &network->layers.items[input->layer];
    reflect_id(json, "layer", from->name);
    reflect_id(json, "output", network->nodes.items[from->node].outputs[input->output]);
}

static void put_input(struct json *json, const struct network *network,
                      const struct network_input *input, const char *name)
{
    reflect_item(json);
    reflect_open(json, '{');
    reflect_string(json, "name", name);
    reflect_id(json, "documentType", input->doc_type);
    if (input->kind == NETWORK_VALUE)
        reflect_value(json, "value", &input->value);
    else if (input->kind == NETWORK_FILE)
        reflect_id(json, "file", input->file);
    reflect_id(json, "path", input->path);
    if (input->kind == NETWORK_LAYER)
        put_source(json, network, input);
    reflect_close(json, '}');
}

static bool is_said(const struct network_input *input)
{
    return input->kind != NETWORK_DEFAULT
           && !(input->kind == NETWORK_FILE && !input->file && !input->path);
}

static void put_layer(struct json *json, const struct network *network,
                      const struct network_layer *layer)
{
    const struct network_node *node = &network->nodes.items[layer->node];
    reflect_item(json);
    reflect_open(json, '{');
    reflect_id(json, "name", layer->name);
    reflect_id(json, "path", layer->path);
    reflect_id(json, "shader", node->name);
    reflect_key(json, "inputs");
    reflect_open(json, '[');
    for (uint32_t i = 0; i < node->num_inputs; i++)
        if (node->inputs[i] && is_said(&network->inputs.items[layer->first_input + i]))
            put_input(json, network, &network->inputs.items[layer->first_input + i],
                      str_text(network->strings, node->inputs[i]));
    reflect_close(json, ']');
    reflect_close(json, '}');
}

static void put_end(struct json *json, const struct network *network, const struct osl_end *end)
{
    reflect_item(json);
    reflect_open(json, '{');
    reflect_string(json, "name", OSL_END_LAYER);
    reflect_string(json, "shader", end->name);
    reflect_key(json, "inputs");
    reflect_open(json, '[');
    for (unsigned i = 0; i < OSL_MAX_ENDS && end->inputs[i].parameter; i++) {
        const struct network_input *input = &network->results[end->inputs[i].result];
        if (is_said(input))
            put_input(json, network, input, end->inputs[i].parameter);
    }
    reflect_close(json, ']');
    reflect_close(json, '}');
}

static void put_group(struct json *json, const struct network *network,
                      const struct osl_group *group)
{
    reflect_item(json);
    reflect_open(json, '{');
    reflect_string(json, "use", group->end->use);
    reflect_key(json, "layers");
    reflect_open(json, '[');
    for (uint32_t i = 0; i < network->layers.len; i++)
        if (group->needed[i])
            put_layer(json, network, &network->layers.items[i]);
    if (group->end->name)
        put_end(json, network, group->end);
    reflect_close(json, ']');
    if (!group->end->name)
        put_source(json, network, &network->results[group->end->inputs[0].result]);
    reflect_close(json, '}');
}

static void put_settled(struct json *json, const struct network_node *node)
{
    bool any = false;
    for (uint32_t i = 0; i < node->num_inputs; i++)
        any |= node->fixed[i].type != IR_TYPE_VOID;
    if (!any)
        return;
    reflect_key(json, "settled");
    reflect_open(json, '{');
    for (uint32_t i = 0; i < node->num_inputs; i++) {
        const char *name = str_text(json->shader->strings, node->ports[i]);
        if (node->fixed[i].type == IR_TYPE_STRING || node->fixed[i].type == IR_TYPE_SAMPLER)
            reflect_id(json, name, node->fixed[i].w[0].u);
        else if (node->fixed[i].type != IR_TYPE_VOID)
            reflect_value(json, name, &node->fixed[i]);
    }
    reflect_close(json, '}');
}

static void put_node(struct json *json, const struct network_node *node)
{
    reflect_item(json);
    reflect_open(json, '{');
    reflect_id(json, "name", node->name);
    reflect_id(json, "definition", node->definition_name);
    put_settled(json, node);
    reflect_close(json, '}');
}

void osl_reflect_network(const struct network *network, struct json *json)
{
    const struct osl_program *program = osl_program_of(network);
    reflect_key(json, "groups");
    reflect_open(json, '[');
    for (unsigned i = 0; i < program->num_groups; i++)
        put_group(json, network, &program->groups[i]);
    reflect_close(json, ']');
    reflect_key(json, "shaders");
    reflect_open(json, '[');
    for (uint32_t i = 0; i < network->nodes.len; i++)
        if (network->nodes.items[i].is_needed)
            put_node(json, &network->nodes.items[i]);
    reflect_close(json, ']');
}
