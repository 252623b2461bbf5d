// SPDX-License-Identifier: Apache-2.0
/*
 * Graphs of the image's definitions as fragments (lang/fragment.h): a shading model of whose inputs
 * none is constant is restored, without asking its nodes one by one.
 */
#include "build/build_priv.h"
#include "lang/fragment.h"

static const struct library *lowest(const struct builder *b)
{
    const struct library *layer = b->lib;
    while (layer->base)
        layer = layer->base;
    return layer;
}

/*
 * Were another layer to implement one of the graph's nodes, or values in it to be converted, the
 * graph would be another one. The library's own implementations for single targets are asked for
 * when it is packed.
 */
bool build_may_restore(const struct builder *b)
{
    const struct build_options *o = b->options;
    for (const struct library *layer = b->lib; layer->base; layer = layer->base)
        if (layer->overrides.len)
            return false;
    for (uint32_t i = 0; b->shader->unit->recorder && i < lowest(b)->impls.len; i++)
        if (lowest(b)->impls.items[i].target)
            return false;
    return strcmp(build_text(b, o->colorspace), "lin_rec709") == 0
           && strcmp(build_text(b, o->distance_unit), "meter") == 0;
}

/* False where the graph has no fragments. */
static bool may_have_fragment(const struct builder *b, const struct frame *frame)
{
    const struct lang_unit *unit = &lowest(b)->unit;
    uint32_t nodedef = frame->node.nodedef;
    bool is_known = b->shader->unit->recorder ? nodedef < lowest(b)->nodedefs.len
                                              : nodedef < unit->graph_fragment_of.len
                                                    && unit->graph_fragment_of.items[nodedef];
    return is_known && b->may_restore && !b->recorder && !frame->has_tokens
           && b->host.choice != LANG_NONE;
}

struct restoring {
    struct builder *b;
    uint32_t outer; /* origin of the node that uses the graph */
};

static uint32_t leaf(void *user_data, uint32_t family)
{
    const struct restoring *r = user_data;
    return build_leaf_callee(r->b, family);
}

static void set_origin(void *user_data, uint32_t element)
{
    const struct restoring *r = user_data;
    r->b->graph->origin =
        element ? ir_add_origin(r->b->graph, doc_element(&r->b->lib->doc, element)->name, element,
                                r->outer)
                : r->outer;
}

static ir_ref geomprop(void *user_data, str_id name, ir_type_id type)
{
    const struct restoring *r = user_data;
    const struct geomprop *prop = library_geomprop(r->b->lib, name);
    return prop ? build_geomprop(r->b, name, prop->type, (struct diag_place){0})
                : ir_poison(r->b->graph, type);
}

static str_id geomprop_name(void *user_data, ir_ref node)
{
    const struct restoring *r = user_data;
    for (uint32_t i = 0; i < r->b->geomprops.len; i += 2)
        if (r->b->geomprops.items[i + 1] == node)
            return r->b->geomprops.items[i];
    return 0;
}

static struct fragment_host host_of(struct restoring *r)
{
    struct builder *b = r->b;
    return (struct fragment_host){.unit = b->shader->unit,
                                  .graph = b->graph,
                                  .lang = &b->host,
                                  .user_data = r,
                                  .leaf = leaf,
                                  .origin = set_origin,
                                  .own = r->outer,
                                  .outer = r->outer,
                                  .named = geomprop,
                                  .name = geomprop_name};
}

bool build_restore(struct builder *b, const struct frame *frame, ir_ref *results)
{
    const struct lang_unit *unit = &lowest(b)->unit;
    uint32_t nodedef = frame->node.nodedef;
    unsigned num_args = library_nodedef(b->lib, nodedef)->num_inputs, num_inputs;
    ir_ref inputs[FRAGMENT_MAX_INPUTS];
    if (b->shader->unit->recorder || !may_have_fragment(b, frame) || num_args > FRAGMENT_MAX_INPUTS)
        return false;
    const struct lang_fragment *fragment =
        fragment_find_open(unit, unit->graph_fragment_of.items[nodedef], b->graph, b->host.choice,
                           frame->args, num_args, inputs, &num_inputs);
    if (!fragment)
        return false;
    struct restoring restoring = {b, b->graph->origin};
    struct fragment_host host = host_of(&restoring);
    size_t room = fragment_room(fragment, num_inputs);
    ir_ref *nodes = arena_alloc(b->arena, room * sizeof *nodes);
    bool *known = arena_alloc(b->arena, room * sizeof *known);
    nodes[0] = known[0] = 0;
    memcpy(nodes + 1, inputs, num_inputs * sizeof *nodes);
    fragment_note_known(b->graph, inputs, num_inputs, known + 1);
    const uint16_t *codes = fragment_restore(&host, unit, fragment, num_inputs, nodes, known);
    for (unsigned i = 0; i < codes[0]; i++)
        results[i] = nodes[codes[i + 1]];
    b->graph->origin = restoring.outer;
    b->shader->model =
        (struct shader_model){.root = host.has_folded ? 0 : results[0],
                              .fragment = (unsigned)(fragment - unit->fragments.items) + 1,
                              .nodes = nodes,
                              .known = known,
                              .num_nodes = (unsigned)room,
                              .num_inputs = num_inputs,
                              .origin = restoring.outer};
    return true;
}

void build_record(struct builder *b, const struct frame *frame, const ir_ref *results)
{
    struct fragment_pattern pattern;
    struct lang_recorder *recorder = b->shader->unit->recorder;
    const struct nodedef *def = library_nodedef(b->lib, frame->node.nodedef);
    const struct port *outputs = library_ports(b->lib, frame->node.nodedef, NULL) + def->num_inputs;
    if (!recorder || !recorder->of_graphs || def->num_outputs != 1
        || !ir_type_is_shader(library_type_ir(b->lib, outputs->type))
        || !may_have_fragment(b, frame))
        return;
    fragment_pattern_begin(&pattern, b->graph, &lowest(b)->unit);
    for (uint32_t i = 0; i < def->num_inputs; i++)
        fragment_pattern_add(&pattern, frame->args[i]);
    if (!fragment_is_open(&pattern))
        return;
    struct restoring restoring = {b, frame->inner->origin};
    struct fragment_host host = host_of(&restoring);
    uint32_t before = b->graph->origin;
    b->graph->origin = frame->inner->origin;
    unsigned number = fragment_record(
        &host, &recorder->graph_fragment_of.items[frame->node.nodedef], &pattern, results, 1);
    b->shader->model = (struct shader_model){.root = number ? results[0] : 0,
                                             .fragment = number,
                                             .nodes = recorder->nodes.items,
                                             .num_nodes = recorder->nodes.len,
                                             .num_inputs = pattern.num_inputs,
                                             .origin = restoring.outer};
    b->graph->origin = before;
}
