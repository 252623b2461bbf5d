// SPDX-License-Identifier: Apache-2.0
/* Networks as a whole: what a group needs, and what it is for hosts (docs/reflection.md). */
#include "shader/network.h"

#include "base/hash.h"
#include "shader/reflect.h"

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
    if (input->kind == NETWORK_LAYER) {
        const struct network_layer *from = &network->layers.items[input->layer];
        reflect_id(r, "layer", from->name);
        reflect_id(r, "output", network->nodes.items[from->node].outputs[input->output]);
    }
    json_close(&r->json, '}');
}

static bool is_said(const struct network_input *input)
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
        if (node->inputs[i] && is_said(&network->inputs.items[layer->first_input + i]))
            put_input(r, network, &network->inputs.items[layer->first_input + i],
                      str_text(network->strings, node->inputs[i]));
    json_close(&r->json, ']');
    json_close(&r->json, '}');
}

static void put_end(struct reflect *r, const struct network_group *group)
{
    json_item(&r->json);
    json_open(&r->json, '{');
    json_put_text(&r->json, "name", NETWORK_END_LAYER);
    json_put_text(&r->json, "shader", group->end->name);
    json_key(&r->json, "inputs");
    json_open(&r->json, '[');
    for (unsigned i = 0; i < 2 && group->end->inputs[i]; i++)
        if (is_said(&group->results[i]))
            put_input(r, group->network, &group->results[i], group->end->inputs[i]);
    json_close(&r->json, ']');
    json_close(&r->json, '}');
}

static void put_group(struct reflect *r, const struct network_group *group)
{
    const struct network *network = group->network;
    json_item(&r->json);
    json_open(&r->json, '{');
    json_put_text(&r->json, "use", network_use_text(group->use));
    json_key(&r->json, "layers");
    json_open(&r->json, '[');
    for (uint32_t i = 0; i < network->layers.len; i++)
        if (group->needed[i])
            put_layer(r, network, &network->layers.items[i]);
    if (group->end->name)
        put_end(r, group);
    json_close(&r->json, ']');
    if (!group->end->name) {
        const struct network_layer *layer = &network->layers.items[group->results[0].layer];
        reflect_id(r, "layer", layer->name);
        reflect_id(r, "output",
                   network->nodes.items[layer->node].outputs[group->results[0].output]);
    }
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

void network_reflect(struct reflect *r, const struct network_group *groups, uint32_t num_groups)
{
    const struct network *network = groups->network;
    json_key(&r->json, "groups");
    json_open(&r->json, '[');
    for (uint32_t g = 0; g < num_groups; g++)
        put_group(r, &groups[g]);
    json_close(&r->json, ']');
    json_key(&r->json, "shaders");
    json_open(&r->json, '[');
    for (uint32_t i = 0; i < network->nodes.len; i++)
        if (network->nodes.items[i].source)
            put_node(r, &network->nodes.items[i]);
    json_close(&r->json, ']');
}
