// SPDX-License-Identifier: Apache-2.0
/* Networks as a whole: what a group needs, and what it is for hosts (docs/reflection.md). */
#include "shader/network.h"

#include "base/hash.h"
#include "shader/json.h"

const char *network_use_text(enum network_use use)
{
    static const char *const words[] = {"surface", "volume", "displacement", "value"};
    return words[use];
}

static void need(bool *needed, const struct network_input *input)
{
    if (input->kind == NETWORK_LAYER)
        needed[input->layer] = true;
}

void network_find_needed(struct network_group *group)
{
    const struct network *network = group->network;
    bool *needed = ARENA_ARRAY(network->arena, bool, network->layers.len + 1);
    need(needed, &group->results[0]);
    need(needed, &group->results[1]);
    for (uint32_t i = network->layers.len; i-- > 0;) {
        const struct network_layer *layer = &network->layers.items[i];
        for (uint32_t k = 0; needed[i] && k < network->nodes.items[layer->node].num_inputs; k++)
            need(needed, &network->inputs.items[layer->first_input + k]);
    }
    group->needed = needed;
}

static uint64_t hash_input(const struct network_group *group, const struct network_input *input,
                           uint64_t h)
{
    if (input->kind != NETWORK_LAYER)
        return hash_mix(h, 1);
    return hash_mix(hash_mix(h, group->needed[input->layer]),
                    (uint64_t)input->layer << 8 | input->output);
}

uint64_t network_topology(const struct network_group *groups, uint32_t num_groups)
{
    uint64_t h = 0;
    for (uint32_t g = 0; g < num_groups; g++) {
        const struct network *network = groups[g].network;
        h = hash_input(&groups[g], &groups[g].results[1],
                       hash_input(&groups[g], &groups[g].results[0], hash_mix(h, groups[g].use)));
        for (uint32_t i = 0; i < network->layers.len; i++) {
            const struct network_layer *layer = &network->layers.items[i];
            const struct network_node *node = &network->nodes.items[layer->node];
            const char *name = str_text(network->strings, node->name);
            h = groups[g].needed[i] ? hash_stable(hash_mix(h, i), name, strlen(name)) : h;
            for (uint32_t k = 0; groups[g].needed[i] && k < node->num_inputs; k++)
                h = hash_input(&groups[g], &network->inputs.items[layer->first_input + k], h);
        }
    }
    return h;
}

/* ---- JSON ---- */

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
    if (input->kind == NETWORK_LAYER) {
        const struct network_layer *from = &network->layers.items[input->layer];
        reflect_id(json, "layer", from->name);
        reflect_id(json, "output", network->nodes.items[from->node].outputs[input->output]);
    }
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

static void put_end(struct json *json, const struct network_group *group)
{
    reflect_item(json);
    reflect_open(json, '{');
    reflect_string(json, "name", NETWORK_END_LAYER);
    reflect_string(json, "shader", group->end->name);
    reflect_key(json, "inputs");
    reflect_open(json, '[');
    for (unsigned i = 0; i < 2 && group->end->inputs[i]; i++)
        if (is_said(&group->results[i]))
            put_input(json, group->network, &group->results[i], group->end->inputs[i]);
    reflect_close(json, ']');
    reflect_close(json, '}');
}

static void put_group(struct json *json, const struct network_group *group)
{
    const struct network *network = group->network;
    reflect_item(json);
    reflect_open(json, '{');
    reflect_string(json, "use", network_use_text(group->use));
    reflect_key(json, "layers");
    reflect_open(json, '[');
    for (uint32_t i = 0; i < network->layers.len; i++)
        if (group->needed[i])
            put_layer(json, network, &network->layers.items[i]);
    if (group->end->name)
        put_end(json, group);
    reflect_close(json, ']');
    if (!group->end->name) {
        const struct network_layer *layer = &network->layers.items[group->results[0].layer];
        reflect_id(json, "layer", layer->name);
        reflect_id(json, "output",
                   network->nodes.items[layer->node].outputs[group->results[0].output]);
    }
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

void network_reflect(struct json *json, const struct network_group *groups, uint32_t num_groups)
{
    const struct network *network = groups->network;
    reflect_key(json, "groups");
    reflect_open(json, '[');
    for (uint32_t g = 0; g < num_groups; g++)
        put_group(json, &groups[g]);
    reflect_close(json, ']');
    reflect_key(json, "shaders");
    reflect_open(json, '[');
    for (uint32_t i = 0; i < network->nodes.len; i++)
        if (network->nodes.items[i].source)
            put_node(json, &network->nodes.items[i]);
    reflect_close(json, ']');
}
