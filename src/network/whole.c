// SPDX-License-Identifier: Apache-2.0
/*
 * The whole shader of a network, for closures that no layers of their own give: outputs of layers
 * become its parameters, and it is the layer of the results.
 */
#include "build/recorder.h"

/* Name and type of a layer's output as a parameter. */
static void make_parameter(struct builder *b, uint32_t variable)
{
    const struct network *network = b->recorded->network;
    const struct network_layer *layer =
        &network->layers.items[recorder_layer_of(b->recorded, variable) - 1];
    const struct nodedef *def =
        library_nodedef(b->lib, network->nodes.items[layer->node].definition);
    const struct port *port =
        library_ports(b->lib, network->nodes.items[layer->node].definition, NULL) + def->num_inputs
        + b->recorded->output_of.items[variable];
    str_id name = layer->name;
    if (def->num_outputs > 1) {
        struct text text;
        text_init(&text, b->arena);
        text_fmt(&text, "%s_%s", build_text(b, layer->name), build_text(b, port->name));
        name = str_intern(b->shader->strings, text.data, text.len);
    }
    shader_make_parameter(b->shader, variable, name, library_type_name(b->lib, port->type));
}

/* The value of a parameter in the document, or the layer that gives it. */
static struct network_input parameter_input(const struct builder *b, uint32_t variable)
{
    const struct shader_variable *v = &b->shader->interface.variables.items[variable];
    struct network_input input = {.type = v->type, .doc_type = v->doc_type, .path = v->path};
    if (recorder_layer_of(b->recorded, variable)) {
        input.kind = NETWORK_LAYER;
        input.layer = recorder_layer_of(b->recorded, variable) - 1;
        input.output = b->recorded->output_of.items[variable];
    } else if (v->type == IR_TYPE_SAMPLER) {
        input.kind = NETWORK_FILE;
        input.file = v->file;
    } else if (v->has_default) {
        input.kind = NETWORK_VALUE;
        input.value = v->value;
    }
    return input;
}

static bool is_parameter(const struct shader_variable *v)
{
    return v->block == BLOCK_PUBLIC_UNIFORMS || v->block == BLOCK_TEXTURES;
}

/* The list of layers has the values, so that the shader does not depend on them. */
static void take_value(struct builder *b, struct shader_variable *v)
{
    if (v->type != IR_TYPE_SAMPLER)
        v->has_default = false;
    else if (v->path)
        v->file = recorder_tiles(b, v->file);
}

void build_network_parameters(struct builder *b)
{
    struct recorder *r = b->recorded;
    r->num_values = b->shader->interface.variables.len;
    r->values = ARENA_ARRAY(b->arena, struct network_input, r->num_values);
    for (uint32_t i = 0; i < r->num_values; i++) {
        struct shader_variable *v = &b->shader->interface.variables.items[i];
        if (recorder_layer_of(r, i) && build_is_number(v->type))
            make_parameter(b, i);
        r->values[i] = parameter_input(b, i);
        if (is_parameter(v))
            take_value(b, v);
    }
}

/* The AOV that an output of the shader has; NULL: it is the closure of the surface. */
static const struct shader_aov *aov_of(const struct shader *shader, uint32_t variable)
{
    for (uint32_t i = 0; i < shader->interface.aovs.len; i++)
        if (shader->interface.aovs.items[i].is_output
            && shader->interface.aovs.items[i].variable == variable)
            return &shader->interface.aovs.items[i];
    return NULL;
}

static void add_output(struct builder *b, uint32_t variable, struct network_node *node,
                       str_id *outputs)
{
    struct network *network = b->recorded->network;
    const struct shader_aov *aov = aov_of(b->shader, variable);
    if (!aov)
        return;
    const struct network_input value = {.kind = NETWORK_LAYER,
                                        .layer = network->layers.len,
                                        .output = (uint8_t)node->num_outputs,
                                        .type = aov->type,
                                        .doc_type = aov->doc_type};
    const struct network_aov made = {aov->name, aov->doc_type, value};
    vec_push(b->arena, &network->aovs, made);
    outputs[node->num_outputs++] = b->shader->interface.variables.items[variable].name;
}

void build_network_whole(struct builder *b, enum shader_stage_id stage,
                         const struct network_part *part)
{
    struct network *network = b->recorded->network;
    const struct shader *shader = b->shader;
    struct network_layer layer = {.name = str_intern_z(shader->strings, network->end_layer),
                                  .path = shader->reflection.path,
                                  .node = network->nodes.len,
                                  .first_input = network->inputs.len};
    str_id *names = ARENA_ARRAY(b->arena, str_id, shader->interface.used.len),
           *outputs = ARENA_ARRAY(b->arena, str_id, shader->interface.used.len);
    struct network_node node = {.name = str_intern_z(shader->strings, part->name),
                                .whole = *part,
                                .definition = LIBRARY_NONE,
                                .inputs = names,
                                .outputs = outputs};
    for (uint32_t i = 0; i < shader->interface.used.len; i++) {
        uint32_t variable = shader->interface.used.items[i];
        const struct shader_variable *v = &shader->interface.variables.items[variable];
        if (!(v->stages >> stage & 1))
            continue;
        if (is_parameter(v)) {
            assert(variable < b->recorded->num_values); /* only streams and results are younger */
            vec_push(b->arena, &network->inputs, b->recorded->values[variable]);
            names[node.num_inputs++] = v->name;
        } else if (v->block == BLOCK_OUTPUTS) {
            add_output(b, variable, &node, outputs);
        }
    }
    enum network_result result = stage == STAGE_VERTEX                      ? NETWORK_DISPLACEMENT
                                 : shader->reflection.kind == SHADER_VOLUME ? NETWORK_VOLUME
                                                                            : NETWORK_SURFACE;
    network->results[result] = (struct network_input){
        .kind = NETWORK_LAYER, .layer = network->layers.len, .type = IR_TYPE_SURFACE};
    vec_push(b->arena, &network->nodes, node);
    vec_push(b->arena, &network->layers, layer);
}
