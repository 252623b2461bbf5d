// SPDX-License-Identifier: Apache-2.0
/*
 * The material of a stack. Each layer is built by itself: the document's nodes are built anew, with
 * the inputs that the layer's overrides drive. compose.c makes one material of them.
 */
#include "bind/drive.h"
#include "build/build_priv.h"

/* ---- Layers ---- */

/* The value that drives an input that a material does not have; 0: nothing does. */
static ir_ref virtual_input(struct builder *b, elem_id material, str_id name, doc_type type)
{
    elem_id source = library_driver(b->resolved.drives, material, name);
    const struct port port = {.name = name, .type = type};
    if (!source)
        return 0;
    struct binding binding = library_resolve_port(b->lib, source, type, &b->resolved, b->diags);
    if (binding.kind == BIND_NODE)
        build_demand(b, b->document, binding.ref);
    return build_input(b, b->document, material, &port, &binding);
}

/* A surfacematerial has a mask, too, and takes the normal of a weaker assignment. */
static ir_ref with_virtual_inputs(struct builder *b, elem_id node, ir_ref material)
{
    if (!material || ir_get(b->graph, material)->op != IR_MATERIAL)
        return material;
    ir_ref args[4] = {material, virtual_input(b, node, STR_normal, DOC_TYPE_vector3),
                      virtual_input(b, node, STR_mask, DOC_TYPE_float), 0};
    uint32_t modes = build_modes(IR_SLOT_MIX, IR_SLOT_MIX);
    return args[1] || args[2] ? ir_build(b->graph, IR_SUBSTANCE, IR_TYPE_MATERIAL, modes, args, 4)
                              : material;
}

/* The inputs of overrides and variants belong to the interface of the shader. */
static void publish_drives(struct builder *b, const struct library_drives *drives)
{
    for (uint32_t i = 0; i < drives->items.len; i++) {
        elem_id source = drives->items.items[i].source;
        if (doc_element(build_doc(b), source)->kind == KIND_INPUT)
            vec_push(b->arena, &b->public_nodes, doc_element(build_doc(b), source)->parent);
    }
}

/* The nodegraphs of the layer's overrides: their AOVs are the layer's. */
static void note_override_graphs(struct builder *b, const struct bindings *bindings,
                                 const struct bind_item *items, uint32_t num)
{
    b->aov_graphs.len = 0;
    for (uint32_t i = 1; i < num; i++) {
        const struct look_assign *a = &bindings->look.assigns.items[items[i].assign];
        if (items[i].kind == ITEM_OVERRIDE && a->kind == ASSIGN_GRAPH)
            vec_push(b->arena, &b->aov_graphs, a->target);
    }
}

/* Forgets the results of the layer before: the same nodes may have other inputs now. */
static void begin_layer(struct builder *b, const char *slot, const struct library_drives *drives)
{
    b->aovs.len = 0;
    memset(b->document->slots, 0, b->document->num_slots * sizeof *b->document->slots);
    b->public_nodes.len = 0;
    b->resolved.drives = drives->items.len ? drives : NULL;
    b->resolved.chains = (struct library_chains){0};
    b->slot = b->graph->slot = str_intern_z(b->shader->strings, slot);
    publish_drives(b, drives);
}

/* The AOV "matte.050": 1 in this layer. */
static void add_matte(struct builder *b, elem_id node, ir_ref *material)
{
    struct text name;
    text_init(&name, b->arena);
    text_fmt(&name, "matte.%s", build_text(b, b->slot));
    struct aov_use use = {.scope = b->document,
                          .node = node,
                          .name = str_intern(b->shader->strings, name.data, name.len),
                          .type = STR_float,
                          .value = ir_const_float(b->graph, 1.0f)};
    build_add_aov(b, &use, material);
}

static ir_ref build_layer(struct builder *b, const struct bindings *bindings,
                          const struct bind_item *items, uint32_t num)
{
    const struct look_assign *a = &bindings->look.assigns.items[items->assign];
    const char *slot = bindings->look.names.items[a->name].text;
    struct library_drives drives = {0};
    elem_id node = bind_material_node(b->lib, a->target, b->diags);
    bind_drives(bindings, b->lib, items, num, NULL, b->arena, &drives);
    begin_layer(b, slot, &drives);
    note_override_graphs(b, bindings, items, num);
    ir_push_name(b->graph, b->slot);
    ir_ref material = node ? build_element(b, node, 0) : 0;
    if (material && b->options->mattes)
        add_matte(b, node, &material);
    material = with_virtual_inputs(b, node, material);
    ir_pop_origin(b->graph);
    b->resolved.drives = NULL;
    b->resolved.chains = (struct library_chains){0};
    return material;
}

/* ---- The whole ---- */

/* White, 0.8, and matt: the substance of a primitive without layers (ASH paper, section 6.1). */
static ir_ref default_substance(struct builder *b)
{
    ir_ref grey = ir_const_splat(b->graph, IR_TYPE_VEC3, 0.8f);
    ir_ref bsdf = build_leaf_of_color(b, "ND_oren_nayar_diffuse_bsdf", grey);
    if (!bsdf)
        return 0;
    ir_ref surface[4] = {bsdf, 0, ir_const_float(b->graph, 1.0f), ir_const_bool(b->graph, false)};
    ir_ref material[4] = {ir_build(b->graph, IR_SURFACE_SHADER, IR_TYPE_SURFACE, 0, surface, 4), 0,
                          0, 0};
    return ir_build(b->graph, IR_MATERIAL, IR_TYPE_MATERIAL, 0, material, 4);
}

ir_ref build_stack(struct builder *b, const struct bindings *bindings, uint32_t stack)
{
    const struct bind_state *state = &bindings->states.items[bindings->stacks.items[stack].state];
    const struct bind_item *items = bindings->items.items + state->first_item;
    struct build_part *parts = ARENA_ARRAY(b->arena, struct build_part, state->num_items);
    uint32_t num_parts = 0;
    ir_ref volume = 0;
    for (uint32_t i = 0, num; i < state->num_items; i += num) {
        num = bind_num_parts(items + i, state->num_items - i);
        bool is_layer = items[i].kind == ITEM_LAYER || items[i].kind == ITEM_VERTICAL;
        if (!is_layer && items[i].kind != ITEM_VOLUME)
            continue;
        if (b->cancelled)
            return 0;
        ir_ref material = build_layer(b, bindings, items + i, num);
        if (!is_layer) {
            volume = material;
            continue;
        }
        struct build_part *part = &parts[num_parts++];
        *part = build_part_of(b, material);
        part->is_vertical = items[i].kind == ITEM_VERTICAL;
        part->slot = build_text(b, b->slot);
    }
    b->slot = b->graph->slot = 0;
    if (!num_parts)
        return volume ? volume : default_substance(b);
    return build_compose(b, parts, num_parts);
}
