// SPDX-License-Identifier: Apache-2.0
/* The lobes of a slab: the library's graph, applied to the inputs of the slab and its place. */
#include "build/build_priv.h"

uint32_t build_definition_named(const struct builder *b, const char *name)
{
    str_id id = str_find(b->shader->strings, name, strlen(name));
    return id ? library_nodedef_by_name(b->lib, id) : LIBRARY_NONE;
}

ir_ref build_leaf_of_color(struct builder *b, const char *definition, ir_ref color)
{
    uint32_t id = build_definition_named(b, definition);
    if (id == LIBRARY_NONE)
        return 0;
    const struct port *ports = library_ports(b->lib, id, NULL);
    unsigned num = library_nodedef(b->lib, id)->num_inputs;
    ir_ref *args = ARENA_ARRAY(b->arena, ir_ref, num), results[LIBRARY_MAX_OUTPUTS] = {0};
    for (unsigned i = 0; i < num; i++)
        args[i] = ports[i].name == STR_color ? color : build_default(b, &ports[i]);
    build_apply(b, id, build_doc(b)->root, args, results);
    return results[0];
}

uint32_t build_slab_definition(const struct builder *b)
{
    return build_definition_named(b, "ND_slab_lobes");
}

uint32_t build_slab_lacks(const struct builder *b)
{
    return b->options->blurs ? 0 : 1u << SLAB_REFRACTION;
}

/* The value of an input of the graph; 0: neither the slab nor its place has it. */
static ir_ref value_of(str_id input, const ir_ref *inputs, const struct slab_place *place)
{
    switch (input) {
#define SLAB_INPUT(name, type) \
    case STR_##name: \
        return inputs[SLAB_##name];
#include "slabs/slabs.def"
#undef SLAB_INPUT
    case STR_thickness: return place->thickness;
    case STR_below: return place->below;
    case STR_is_body: return place->is_body;
    case STR_scatters: return place->scatters;
    case STR_is_sheet: return place->is_sheet;
    case STR_walks: return place->walks;
    case STR_unit: return place->unit;
    case STR_blur: return place->blur;
    default: return 0;
    }
}

const struct ir_origin *build_element_origin(const struct ir_graph *g)
{
    const struct ir_origin *origin = &g->origins.items[g->origin];
    while (!origin->element && origin->parent)
        origin = &g->origins.items[origin->parent];
    return origin;
}

/* Names what the graph makes after the slab: "coat_reflection" instead of "reflection_2". */
static void name_lobes(struct builder *b, uint32_t first_origin)
{
    str_id slab = build_element_origin(b->graph)->name; /* in its document */
    for (uint32_t i = first_origin; slab && i < b->graph->origins.len; i++) {
        struct ir_origin *origin = &b->graph->origins.items[i];
        if (origin->parent != b->graph->origin || !origin->name)
            continue;
        struct text name;
        text_init(&name, b->arena);
        text_fmt(&name, "%s_%s", build_text(b, slab), build_text(b, origin->name));
        origin->name = str_intern(b->shader->strings, name.data, name.len);
    }
}

/* The closure of a definition whose inputs are those of a slab and of its place. */
static ir_ref apply(struct builder *b, uint32_t id, const ir_ref *inputs,
                    const struct slab_place *place)
{
    assert(id != LIBRARY_NONE);
    const struct nodedef *def = library_nodedef(b->lib, id);
    const struct port *ports = library_ports(b->lib, id, NULL);
    ir_ref *args = ARENA_ARRAY(b->arena, ir_ref, def->num_inputs);
    ir_ref results[LIBRARY_MAX_OUTPUTS] = {0};
    for (unsigned i = 0; i < def->num_inputs; i++) {
        ir_ref value = value_of(ports[i].name, inputs, place);
        args[i] = value ? value : build_default(b, &ports[i]);
    }
    uint32_t first_origin = b->graph->origins.len;
    build_apply(b, id, build_doc(b)->root, args, results);
    name_lobes(b, first_origin);
    return results[0];
}

ir_ref build_slab_lobes(struct builder *b, const ir_ref *inputs, const struct slab_place *place)
{
    return apply(b, build_slab_definition(b), inputs, place);
}

ir_ref build_marked_lobes(struct builder *b, const ir_ref *inputs, const struct slab_place *place)
{
    ir_ref lobes = build_slab_lobes(b, inputs, place);
    if (!role_stores(b->shader->role))
        return lobes;
    ir_ref args[2] = {apply(b, build_definition_named(b, "ND_slab_mark"), inputs, place), lobes};
    if (!lobes)
        return args[0];
    return ir_build(b->graph, IR_LAYER, IR_TYPE_BSDF, 0, args, 2);
}
