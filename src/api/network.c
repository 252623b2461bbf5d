// SPDX-License-Identifier: Apache-2.0
/*
 * The network of an element: which groups there are, the shader of each node that they need, and
 * the lists of layers, which stand in the place of stages.
 */
#include "api/generation.h"

/* ---- Groups ---- */

static struct network_group *add_group(struct generation *g, enum network_use use, ir_ref front,
                                       ir_ref back)
{
    mxg_result *result = g->result;
    struct network_group *group = &result->groups[result->num_groups++];
    *group = (struct network_group){
        .network = &result->network, .use = use, .end = &result->target->network->ends[use]};
    group->results[0] = build_network_input(g->builder, front);
    group->results[1] = build_network_input(g->builder, back);
    return group;
}

/* A value that is no layer's gets one. */
static bool add_value_group(struct generation *g)
{
    struct network_group *group = add_group(g, NETWORK_VALUE_OF, g->root, 0);
    if (group->results[0].kind == NETWORK_LAYER)
        return true;
    uint32_t layer = build_constant_layer(g->builder, g->root, g->result->shader.value_type);
    group->results[0] = (struct network_input){.kind = NETWORK_LAYER, .layer = layer};
    return layer != UINT32_MAX;
}

static void add_material_groups(struct generation *g)
{
    const struct ir_graph *graph = &g->result->graph;
    ir_ref args[4];
    memcpy(args, ir_args(graph, g->root), sizeof args);
    if (args[0] || args[1] || !args[3])
        add_group(g, NETWORK_SURFACE, args[0], args[1]);
    else
        add_group(g, NETWORK_VOLUME, args[3], 0);
    if (args[2])
        add_group(g, NETWORK_DISPLACEMENT, args[2], 0);
}

static bool add_groups(struct generation *g)
{
    ir_type_id type = ir_type_of(&g->result->graph, g->root);
    if (ir_get(&g->result->graph, g->root)->op == IR_MATERIAL)
        add_material_groups(g);
    else if (type == IR_TYPE_DISPLACEMENT)
        add_group(g, NETWORK_DISPLACEMENT, g->root, 0);
    else if (type == IR_TYPE_VOLUME || type == IR_TYPE_VDF)
        add_group(g, NETWORK_VOLUME, g->root, 0);
    else if (ir_type_is_closure(type) || ir_type_is_shader(type))
        add_group(g, NETWORK_SURFACE, g->root, 0);
    else
        return add_value_group(g);
    return true;
}

/* ---- Shaders of nodes ---- */

static struct shader *new_shader(struct generation *g, const struct network_node *node)
{
    mxg_result *result = g->result;
    struct arena *arena = &result->object.arena;
    struct shader *shader = ARENA_NEW(arena, struct shader);
    struct lang_unit *unit = ARENA_NEW(arena, struct lang_unit);
    struct ir_graph *graph = ARENA_NEW(arena, struct ir_graph);
    lang_unit_init(unit, arena, &result->strings, &g->document->layer.unit);
    ir_graph_init(graph, arena, &result->strings);
    graph->max_nodes = result->object.context->max_nodes;
    shader_init(shader, arena, &result->strings, graph, unit);
    shader->style = result->shader.style;
    shader->name = node->definition_name;
    return shader;
}

/* What is wrong with a node has been told where it was built for the document. */
static bool emit_node(struct generation *g, struct shader *shader, struct network_node *node)
{
    struct arena *arena = shader->arena;
    struct diag_list *told = ARENA_NEW(arena, struct diag_list);
    struct closure_point *point = ARENA_NEW(arena, struct closure_point);
    ir_ref *results = ARENA_ARRAY(arena, ir_ref, node->num_outputs);
    struct closure_result *outputs = ARENA_ARRAY(arena, struct closure_result, node->num_outputs);
    str_id *names = ARENA_ARRAY(arena, str_id, node->num_outputs);
    diag_list_init(told, arena);
    struct builder *builder = build_start(&g->document->layer, &g->build_options, shader, told);
    build_network_node(builder, node, results);
    for (uint32_t i = 0; i < node->num_outputs; i++) {
        outputs[i] = (struct closure_result){.value = results[i]};
        outputs[i].name = build_network_output(builder, node, i, &outputs[i].doc_type);
    }
    struct closure_host host = generation_closure_host(g, builder, point);
    bool is_emitted = closure_emit_node(shader, &host, outputs, node->num_outputs);
    ir_assert_valid(shader->graph, "after closures");
    if (!is_emitted)
        return false;
    struct shader_layout_rules rules = generation_layout_rules(g);
    shader_finish(shader, &rules);
    uint32_t n = 0;
    for (uint32_t i = 0; i < shader->interface.len; i++)
        if (shader->variables.items[shader->interface.items[i]].block == BLOCK_OUTPUTS)
            names[n++] = shader->variables.items[shader->interface.items[i]].name;
    node->outputs = names;
    return n == node->num_outputs;
}

/* Inputs that the shader does not read are no parameters of it. */
static void drop_unread(const struct shader *shader, struct network_node *node)
{
    str_id *names = ARENA_ARRAY(shader->arena, str_id, node->num_inputs);
    for (uint32_t i = 0; i < node->num_inputs; i++)
        for (uint32_t k = 0; node->inputs[i] && k < shader->interface.len; k++) {
            const struct shader_variable *variable =
                &shader->variables.items[shader->interface.items[k]];
            if (variable->name == node->inputs[i] && variable->block != BLOCK_OUTPUTS)
                names[i] = node->inputs[i];
        }
    node->inputs = names;
}

static bool make_node(struct generation *g, struct spell_options *options,
                      struct network_node *node)
{
    mxg_result *result = g->result;
    struct shader *shader = new_shader(g, node);
    if (!emit_node(g, shader, node)) {
        result->shader.unknown_closure = shader->unknown_closure;
        return false;
    }
    drop_unread(shader, node);
    struct text source;
    struct spell_mark *marks;
    uint32_t num_marks;
    options->shader_name = str_text(&result->strings, node->name);
    text_init(&source, &result->object.arena);
    spell_shader_stage(result->target, options, shader, STAGE_PIXEL, &g->scratch, &source, &marks,
                       &num_marks);
    node->source = text_cstr(&source);
    node->size = source.len;
    return true;
}

static bool is_needed(const mxg_result *result, uint32_t node)
{
    for (uint32_t g = 0; g < result->num_groups; g++)
        for (uint32_t i = 0; i < result->network.layers.len; i++)
            if (result->groups[g].needed[i] && result->network.layers.items[i].node == node)
                return true;
    return false;
}

static void add_part(mxg_result *result, const struct network_part *part)
{
    vec_push(&result->object.arena, &result->parts, *part);
}

static bool make_parts(struct generation *g)
{
    mxg_result *result = g->result;
    struct spell_options options = generation_spell_options(g);
    options.path = NULL;      /* they belong to no element, and are the same */
    options.interface = NULL; /* whatever stays variable */
    for (uint32_t i = 0; i < result->network.nodes.len; i++) {
        struct network_node *node = &result->network.nodes.items[i];
        if (!is_needed(result, i))
            continue;
        if (!make_node(g, &options, node))
            return false;
        add_part(result, &(struct network_part){str_text(&result->strings, node->name),
                                                node->source, node->size,
                                                str_text(&result->strings, node->definition_name)});
    }
    for (uint32_t i = 0; i < result->num_groups; i++) {
        const struct network_end *end = result->groups[i].end;
        if (end->name)
            add_part(result,
                     &(struct network_part){end->name, end->source, strlen(end->source), ""});
    }
    return true;
}

static void write_group(mxg_result *result, const struct network_group *group)
{
    struct text list;
    text_init(&list, &result->object.arena);
    result->target->network->write(group, &list);
    enum shader_stage_id stage = group->use == NETWORK_DISPLACEMENT ? STAGE_VERTEX : STAGE_PIXEL;
    result->stages[stage] = (struct stage_source){.text = text_cstr(&list), .size = list.len};
}

bool generation_make_network(struct generation *g)
{
    bool good = add_groups(g);
    for (uint32_t i = 0; i < g->result->num_groups; i++)
        if (good)
            network_find_needed(&g->result->groups[i]);
    if (!good || !make_parts(g)) {
        generation_report_not_renderable(g, "there is no layer that gives it");
        return false;
    }
    for (uint32_t i = 0; i < g->result->num_groups; i++)
        write_group(g->result, &g->result->groups[i]);
    return true;
}

/* ---- What callers see ---- */

uint32_t mxg_result_num_parts(const mxg_result *result)
{
    return result && result->has_shader ? result->parts.len : 0;
}

mxg_status mxg_result_part(const mxg_result *result, uint32_t index, mxg_part *out)
{
    if (index >= mxg_result_num_parts(result))
        return MXG_ERROR_ARGUMENT;
    const struct network_part *part = &result->parts.items[index];
    mxg_part full = {.name = part->name,
                     .source = part->source,
                     .source_size = part->size,
                     .nodedef = part->nodedef};
    return struct_write(out, &full, sizeof full);
}
