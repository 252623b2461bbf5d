// SPDX-License-Identifier: Apache-2.0
/* Networks in the reflection: groups with their layers, and the shaders (docs/reflection.md). */
#include "generators/osl/groups.h"
#include "shader/reflect.h"

/* The layer that an input is connected to. */
static void put_source(struct reflect *r, const struct network *network,
                       const struct network_input *input)
{
    const struct network_layer *from = &network->layers.items[input->layer];
    reflect_id(r, "layer", from->name);
    reflect_id(r, "output", network->nodes.items[from->node].outputs[input->output]);
}

static void put_input(struct reflect *r, const struct network *network,
                      const struct network_input *input, const char *name)
{
    json_item(&r->json);
    json_open(&r->json, '{');
    json_put_text(&r->json, "name", name);
    reflect_id(r, "documentType", input->doc_type);
    if (input->kind == NETWORK_VALUE)
        reflect_value(&r->json, "value", &input->value);
    else if (input->kind == NETWORK_FILE)
        reflect_id(r, "file", input->file);
    reflect_id(r, "path", input->path);
    if (input->kind == NETWORK_LAYER)
        put_source(r, network, input);
    json_close(&r->json, '}');
}

static bool has_source(const struct network_input *input)
{
    return input->kind != NETWORK_DEFAULT
           && !(input->kind == NETWORK_FILE && !input->file && !input->path);
}

static void put_layer(struct reflect *r, const struct network *network,
                      const struct network_layer *layer)
{
    const struct network_node *node = &network->nodes.items[layer->node];
    json_item(&r->json);
    json_open(&r->json, '{');
    reflect_id(r, "name", layer->name);
    reflect_id(r, "path", layer->path);
    reflect_id(r, "shader", node->name);
    json_key(&r->json, "inputs");
    json_open(&r->json, '[');
    for (uint32_t i = 0; i < node->num_inputs; i++)
        if (node->inputs[i] && has_source(&network->inputs.items[layer->first_input + i]))
            put_input(r, network, &network->inputs.items[layer->first_input + i],
                      str_text(network->strings, node->inputs[i]));
    json_close(&r->json, ']');
    json_close(&r->json, '}');
}

static void put_end(struct reflect *r, const struct network *network, const struct osl_end *end)
{
    json_item(&r->json);
    json_open(&r->json, '{');
    json_put_text(&r->json, "name", network->end_layer);
    json_put_text(&r->json, "shader", end->name);
    json_key(&r->json, "inputs");
    json_open(&r->json, '[');
    for (unsigned i = 0; i < OSL_MAX_ENDS && end->inputs[i].parameter; i++) {
        const struct network_input *input = &network->results[end->inputs[i].result];
        if (has_source(input))
            put_input(r, network, input, end->inputs[i].parameter);
    }
    json_close(&r->json, ']');
    json_close(&r->json, '}');
}

static void put_aovs(struct reflect *r, const struct network *network, uint32_t num)
{
    json_key(&r->json, "aovs");
    json_open(&r->json, '[');
    for (uint32_t i = 0; i < num; i++) {
        const struct network_aov *aov = &network->aovs.items[i];
        json_item(&r->json);
        json_open(&r->json, '{');
        reflect_id(r, "name", aov->name);
        reflect_id(r, "documentType", aov->doc_type);
        put_source(r, network, &aov->value);
        json_close(&r->json, '}');
    }
    json_close(&r->json, ']');
}

static void put_group(struct reflect *r, const struct network *network,
                      const struct osl_group *group)
{
    json_item(&r->json);
    json_open(&r->json, '{');
    json_put_text(&r->json, "use", group->end->use);
    json_key(&r->json, "layers");
    json_open(&r->json, '[');
    for (uint32_t i = 0; i < network->layers.len; i++)
        if (group->needed[i])
            put_layer(r, network, &network->layers.items[i]);
    if (osl_has_end(group))
        put_end(r, network, group->end);
    json_close(&r->json, ']');
    if (!group->end->name)
        put_source(r, network, &network->results[group->end->inputs[0].result]);
    if (osl_num_aovs(network, group->end))
        put_aovs(r, network, osl_num_aovs(network, group->end));
    json_close(&r->json, '}');
}

static void put_settled(struct reflect *r, const struct network_node *node)
{
    bool any = false;
    for (uint32_t i = 0; i < node->num_inputs; i++)
        any |= node->fixed[i].type != IR_TYPE_VOID;
    if (!any)
        return;
    json_key(&r->json, "settled");
    json_open(&r->json, '{');
    for (uint32_t i = 0; i < node->num_inputs; i++) {
        const char *name = str_text(r->shader->strings, node->ports[i]);
        if (node->fixed[i].type == IR_TYPE_STRING || node->fixed[i].type == IR_TYPE_SAMPLER)
            reflect_id(r, name, node->fixed[i].w[0].u);
        else if (node->fixed[i].type != IR_TYPE_VOID)
            reflect_value(&r->json, name, &node->fixed[i]);
    }
    json_close(&r->json, '}');
}

static void put_node(struct reflect *r, const struct network_node *node)
{
    json_item(&r->json);
    json_open(&r->json, '{');
    reflect_id(r, "name", node->name);
    reflect_id(r, "definition", node->definition_name);
    put_settled(r, node);
    json_close(&r->json, '}');
}

void osl_reflect_network(const struct network *network, struct reflect *r)
{
    const struct osl_program *program = osl_program_of(network);
    json_key(&r->json, "groups");
    json_open(&r->json, '[');
    for (unsigned i = 0; i < program->num_groups; i++)
        put_group(r, network, &program->groups[i]);
    json_close(&r->json, ']');
    json_key(&r->json, "shaders");
    json_open(&r->json, '[');
    for (uint32_t i = 0; i < network->nodes.len; i++)
        if (network->nodes.items[i].is_needed && !network->nodes.items[i].whole.source)
            put_node(r, &network->nodes.items[i]);
    json_close(&r->json, ']');
}
