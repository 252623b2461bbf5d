// SPDX-License-Identifier: Apache-2.0
/* The groups of a network, the layers of each group, and the shaders at their ends. */
#include "generators/osl/groups.h"

#include "base/hash.h"

#include <assert.h>

enum { SURFACE, VOLUME, DISPLACEMENT, PLAIN_VALUE };

static const struct osl_end ends[] = {
    [SURFACE] =
        {
            .stage = STAGE_PIXEL,
            .use = "surface",
            .name = "mx_surface_root",
            .source = "surface mx_surface_root(closure color surfaceshader = 0, closure color "
                      "backsurfaceshader = 0)\n{\n"
                      "    Ci = surfaceshader;\n"
                      "    if (backfacing() && isconnected(backsurfaceshader))\n"
                      "        Ci = backsurfaceshader;\n}\n",
            .inputs = {{NETWORK_SURFACE, "surfaceshader"},
                       {NETWORK_BACK_SURFACE, "backsurfaceshader"}},
        },
    [VOLUME] =
        {
            .stage = STAGE_PIXEL,
            .use = "volume",
            .name = "mx_volume_root",
            .source = "volume mx_volume_root(closure color volumeshader = 0)\n{\n"
                      "    Ci = volumeshader;\n}\n",
            .inputs = {{NETWORK_VOLUME, "volumeshader"}},
        },
    [DISPLACEMENT] =
        {
            .stage = STAGE_VERTEX,
            .use = "displacement",
            .name = "mx_displacement_root",
            .source = "displacement mx_displacement_root(vector displacementshader = 0)\n{\n"
                      "    P += displacementshader;\n    N = calculatenormal(P);\n}\n",
            .inputs = {{NETWORK_DISPLACEMENT, "displacementshader"}},
        },
    [PLAIN_VALUE] = {.stage = STAGE_PIXEL, .use = "value", .inputs = {{NETWORK_PLAIN_VALUE, ""}}},
};

/* ---- Layers ---- */

static void need(bool *needed, const struct network_input *input)
{
    if (input->kind == NETWORK_LAYER)
        needed[input->layer] = true;
}

uint32_t osl_num_aovs(const struct network *network, const struct osl_end *end)
{
    return end == &ends[SURFACE] ? network->aovs.len : 0;
}

static const bool *find_needed(struct network *network, const struct osl_end *end)
{
    bool *needed = ARENA_ARRAY(network->arena, bool, network->layers.len + 1);
    for (unsigned i = 0; i < OSL_MAX_ENDS && end->inputs[i].parameter; i++)
        need(needed, &network->results[end->inputs[i].result]);
    for (uint32_t i = 0; i < osl_num_aovs(network, end); i++)
        need(needed, &network->aovs.items[i].value);
    for (uint32_t i = network->layers.len; i-- > 0;) {
        const struct network_layer *layer = &network->layers.items[i];
        struct network_node *node = &network->nodes.items[layer->node];
        for (uint32_t k = 0; needed[i] && k < node->num_inputs; k++) {
            const struct network_input *input = &network->inputs.items[layer->first_input + k];
            assert(input->kind != NETWORK_LAYER || input->layer < i); /* sources come first */
            need(needed, input);
        }
        node->is_needed |= needed[i];
    }
    return needed;
}

static void add_group(struct network *network, unsigned end)
{
    struct osl_program *program = network->program;
    assert(program->num_groups < OSL_MAX_ENDS);
    program->groups[program->num_groups++] =
        (struct osl_group){.end = &ends[end],
                           .is_whole = network->is_whole,
                           .needed = find_needed(network, &ends[end])};
}

static bool gives(const struct network *network, enum network_result result)
{
    return network->results[result].type != IR_TYPE_VOID;
}

void osl_plan_network(struct network *network)
{
    network->program = ARENA_NEW(network->arena, struct osl_program);
    if (gives(network, NETWORK_SURFACE) || gives(network, NETWORK_BACK_SURFACE))
        add_group(network, SURFACE);
    else if (gives(network, NETWORK_VOLUME))
        add_group(network, VOLUME);
    else if (gives(network, NETWORK_PLAIN_VALUE))
        add_group(network, PLAIN_VALUE);
    if (gives(network, NETWORK_DISPLACEMENT))
        add_group(network, DISPLACEMENT);
}

void osl_add_network_parts(struct network *network)
{
    const struct osl_program *program = osl_program_of(network);
    for (unsigned i = 0; i < program->num_groups; i++) {
        const struct osl_end *end = program->groups[i].end;
        struct network_part part = {.name = end->name, .source = end->source, .nodedef = ""};
        if (!osl_has_end(&program->groups[i]))
            continue;
        part.size = strlen(end->source);
        vec_push(network->arena, &network->parts, part);
    }
}

/* ---- Topology ---- */

static uint64_t hash_input(const struct osl_group *group, const struct network_input *input,
                           uint64_t h)
{
    if (input->kind != NETWORK_LAYER)
        return hash_mix(h, 1);
    return hash_mix(hash_mix(h, group->needed[input->layer]),
                    (uint64_t)input->layer << 8 | input->output);
}

static uint64_t hash_end(const struct network *network, const struct osl_group *group, uint64_t h)
{
    static const struct network_input none = {.kind = NETWORK_DEFAULT};
    h = hash_mix(h, (uint64_t)(group->end - ends));
    for (unsigned i = 0; i < OSL_MAX_ENDS; i++)
        h = hash_input(group,
                       group->end->inputs[i].parameter
                           ? &network->results[group->end->inputs[i].result]
                           : &none,
                       h);
    for (uint32_t i = 0; i < osl_num_aovs(network, group->end); i++) {
        const char *name = str_text(network->strings, network->aovs.items[i].name);
        h = hash_input(group, &network->aovs.items[i].value, hash_stable(h, name, strlen(name)));
    }
    return h;
}

uint64_t osl_network_topology(const struct network *network)
{
    const struct osl_program *program = osl_program_of(network);
    uint64_t h = 0;
    for (unsigned g = 0; g < program->num_groups; g++) {
        const struct osl_group *group = &program->groups[g];
        h = hash_end(network, group, h);
        for (uint32_t i = 0; i < network->layers.len; i++) {
            const struct network_layer *layer = &network->layers.items[i];
            const struct network_node *node = &network->nodes.items[layer->node];
            const char *name = str_text(network->strings, node->name);
            if (!group->needed[i])
                continue;
            h = hash_stable(hash_mix(h, i), name, strlen(name));
            for (uint32_t k = 0; k < node->num_inputs; k++)
                h = hash_input(group, &network->inputs.items[layer->first_input + k], h);
        }
    }
    return h;
}
