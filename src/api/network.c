// SPDX-License-Identifier: Apache-2.0
/*
 * The network of an element: the shader of each node, and the text that the target writes for the
 * network.
 */
#include "api/generation.h"

#include "base/hash.h"

#include <assert.h>

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
    shader_init(shader, result->shader.role, arena, &result->strings, graph, unit);
    shader->style = result->shader.style;
    shader->sources.language = result->shader.sources.language;
    shader->reflection.name = node->definition_name;
    return shader;
}

/*
 * The build for the document has reported most faults of a node already. Others show only here,
 * where the inputs are parameters: true if there are none.
 */
static bool tell_own_faults(struct generation *g, const struct diag_list *own)
{
    struct diag_list *diags = &g->result->object.diagnostics.list;
    for (uint32_t i = 0; own->num_errors > 0 && i < own->items.len; i++)
        diag_repeat(diags, &own->items.items[i]);
    return own->num_errors == 0;
}

static bool emit_node(struct generation *g, struct shader *shader, struct network_node *node)
{
    struct arena *arena = shader->arena;
    struct diag_list *own = ARENA_NEW(arena, struct diag_list);
    struct closure_point *point = ARENA_NEW(arena, struct closure_point);
    ir_ref *results = ARENA_ARRAY(arena, ir_ref, node->num_outputs);
    struct network_output *outputs = ARENA_ARRAY(arena, struct network_output, node->num_outputs);
    str_id *names = ARENA_ARRAY(arena, str_id, node->num_outputs);
    diag_list_init(own, arena);
    struct builder *builder = build_start(&g->document->layer, &g->build_options, shader, own);
    build_network_node(builder, node, results);
    for (uint32_t i = 0; i < node->num_outputs; i++) {
        outputs[i] = (struct network_output){.value = results[i]};
        outputs[i].name = build_network_output(builder, node, i, &outputs[i].doc_type);
    }
    struct closure_host host = build_closure_host(builder, point);
    bool is_emitted =
        g->result->target->network->emit_node(shader, &host, outputs, node->num_outputs, &g->lacks);
    ir_assert_valid(shader->graph, "after closures");
    if (!tell_own_faults(g, own) || !is_emitted
        || !generation_effects_are_defined(g, shader, g->element))
        return false;
    struct shader_layout_rules rules = generation_layout_rules(g);
    shader_finish(shader, &rules);
    uint32_t n = 0;
    for (uint32_t i = 0; i < shader->interface.used.len; i++)
        if (shader_interface_variable(shader, i)->block == BLOCK_OUTPUTS)
            names[n++] = shader_interface_variable(shader, i)->name;
    assert(n <= node->num_outputs);
    node->outputs = names;
    return n == node->num_outputs;
}

/* Removes parameters that the shader does not read. */
static void drop_unread(const struct shader *shader, struct network_node *node)
{
    str_id *names = ARENA_ARRAY(shader->arena, str_id, node->num_inputs);
    for (uint32_t i = 0; i < node->num_inputs; i++)
        for (uint32_t k = 0; node->inputs[i] && k < shader->interface.used.len; k++) {
            const struct shader_variable *variable = shader_interface_variable(shader, k);
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
    if (!emit_node(g, shader, node))
        return false;
    drop_unread(shader, node);
    struct text source;
    struct spell_mark *marks;
    uint32_t num_marks;
    struct network_part part = {.name = str_text(&result->strings, node->name),
                                .nodedef = str_text(&result->strings, node->definition_name)};
    options->shader_name = part.name;
    text_init(&source, &result->object.arena);
    spell_shader_stage(result->target, options, shader, STAGE_PIXEL, &g->scratch, &source, &marks,
                       &num_marks);
    part.source = text_cstr(&source);
    part.size = source.len;
    vec_push(&result->object.arena, &result->network.parts, part);
    return true;
}

/* ---- One shader for the closures of the element ---- */

static struct text spell_whole(struct generation *g, struct spell_options *options,
                               const char *name, enum shader_stage_id stage)
{
    struct text source;
    struct spell_mark *marks;
    uint32_t num_marks;
    options->shader_name = name;
    text_init(&source, &g->result->object.arena);
    spell_shader_stage(g->result->target, options, &g->result->shader, stage, &g->scratch, &source,
                       &marks, &num_marks);
    return source;
}

/* The name of the element, and a hash of the source: two parts of one name are equal. */
static const char *whole_name(struct generation *g, struct text source)
{
    const struct shader *shader = &g->result->shader;
    struct text name;
    size_t len;
    text_init(&name, &g->result->object.arena);
    text_fmt(&name, "%s_%08x",
             shader->interface.rules.neutral_names
                 ? "neutral"
                 : str_text(shader->strings, shader->reflection.path),
             (unsigned)hash_stable(0, text_cstr(&source), source.len));
    return identifier_from(text_cstr(&name), name.len, &g->result->object.arena, &len);
}

static void make_whole_stage(struct generation *g, enum shader_stage_id stage)
{
    struct spell_options options = generation_spell_options(g);
    options.path = NULL; /* as in the shaders of nodes */
    struct network_part part = {
        .name =
            whole_name(g, spell_whole(g, &options, g->result->target->network->end_layer, stage)),
        .nodedef = ""};
    struct text source = spell_whole(g, &options, part.name, stage);
    part.source = text_cstr(&source);
    part.size = source.len;
    build_network_whole(g->builder, stage, &part);
}

/* The shader of the element without a network, over the outputs of layers. */
static bool make_whole(struct generation *g)
{
    mxg_result *result = g->result;
    if (!generation_emit(g))
        return false;
    build_network_parameters(g->builder);
    if (!generation_finish(g))
        return false;
    for (int stage = 0; stage < NUM_STAGES; stage++)
        if (generation_has_stage(result, stage))
            make_whole_stage(g, (enum shader_stage_id)stage);
    /* the description of the network has its variables */
    result->shader.interface.used.len = 0;
    memset(result->shader.interface.first_of_block, 0,
           sizeof result->shader.interface.first_of_block);
    return true;
}

/* ---- The network ---- */

static bool make_part(struct generation *g, struct spell_options *options,
                      struct network_node *node)
{
    if (!node->whole.source)
        return make_node(g, options, node);
    vec_push(&g->result->object.arena, &g->result->network.parts, node->whole);
    return true;
}

static bool make_parts(struct generation *g)
{
    struct network *network = &g->result->network;
    struct spell_options options = generation_spell_options(g);
    options.path = NULL;      /* shaders of nodes belong to no element and have equal options */
    options.interface = NULL; /* the interface option does not matter: all inputs are parameters */
    for (uint32_t i = 0; i < network->nodes.len; i++)
        if (network->nodes.items[i].is_needed && !make_part(g, &options, &network->nodes.items[i]))
            return false;
    g->result->target->network->add_parts(network);
    return true;
}

static void write_stage(mxg_result *result, enum shader_stage_id stage)
{
    assert(result->stages[stage].size == 0);
    struct text text;
    text_init(&text, &result->object.arena);
    result->target->network->write(&result->network, stage, &text);
    if (text.len)
        result->stages[stage] = (struct stage_source){.text = text_cstr(&text), .size = text.len};
}

bool generation_make_network(struct generation *g)
{
    mxg_result *result = g->result;
    bool good = build_network_results(g->builder, g->root, result->shader.reflection.value_type)
                && (!result->network.is_whole || make_whole(g));
    if (good)
        result->target->network->plan(&result->network);
    if (!good || !make_parts(g)) {
        if (result->object.diagnostics.list.num_errors == 0)
            generation_report_not_renderable(g, "there is no layer that gives it");
        return false;
    }
    for (int stage = 0; stage < NUM_STAGES; stage++)
        write_stage(result, (enum shader_stage_id)stage);
    return true;
}

/* ---- Access for callers ---- */

uint32_t mxg_result_num_parts(const mxg_result *result)
{
    return result && result->has_shader ? result->network.parts.len : 0;
}

mxg_status mxg_result_part(const mxg_result *result, uint32_t index, mxg_part *out)
{
    if (index >= mxg_result_num_parts(result))
        return MXG_ERROR_ARGUMENT;
    const struct network_part *part = &result->network.parts.items[index];
    assert(part->size > 0);
    mxg_part full = {.name = part->name,
                     .source = part->source,
                     .source_size = part->size,
                     .nodedef = part->nodedef};
    return struct_write(out, &full, sizeof full);
}
