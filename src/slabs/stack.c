// SPDX-License-Identifier: Apache-2.0
/*
 * From the base up, with the presence h of a layer:
 *
 *     coverage    c' = 1 - (1 - c)(1 - h)
 *     horizontal  mix(all below, layer, h / c')
 *     vertical    layer(mask · layer, the layer below)
 *
 * The surface has the opacity of the stack, which is c' times the cutouts. So every layer keeps the
 * weight that it has in the stack.
 */
#include "slabs/stack.h"

/* The closures of a surface; 0: it has none. */
struct lights {
    ir_ref bsdf, edf;
};

struct joiner {
    struct shader *shader;
    struct ir_graph *graph;
    const struct slabs_host *host;
    struct lights below; /* all layers so far */
    ir_ref coverage;     /* of them; 0: there are none */
};

/* ---- What can be joined ---- */

static bool is_no(const struct ir_graph *g, ir_ref flag)
{
    struct ir_value value;
    return !flag || (ir_get_const(g, flag, &value) && !value.w[0].u);
}

/* Light that passes slabs goes to what lies below, which a mix does not do. */
static bool is_opaque(const struct joiner *j, ir_ref slabs)
{
    ir_ref walked = slabs_walk(j->shader, j->host, slabs);
    return ir_const_is(j->graph, ir_arg(j->graph, walked, 2), 1.0f);
}

static bool is_layer(const struct joiner *j, const struct ir_slot *slot)
{
    const struct ir_graph *g = j->graph;
    bool is_vertical = ir_slot_is_vertical(g, slot);
    const struct ir_node *node = ir_get(g, slot->surface);
    if (!slot->surface)
        return true;
    if (node->op == IR_SLAB_SURFACE)
        return is_vertical || is_opaque(j, slot->surface);
    return node->op == IR_SURFACE_SHADER && !node->attr && is_no(g, ir_arg(g, slot->surface, 3));
}

static bool emits(const struct ir_graph *g, ir_ref surface)
{
    return surface && ir_get(g, surface)->op == IR_SURFACE_SHADER && ir_arg(g, surface, 1);
}

static bool is_joinable(const struct joiner *j, ir_ref slots)
{
    unsigned num = ir_num_slots(j->graph, slots);
    bool base_emits = false;
    for (unsigned i = 0; i < num; i++) {
        struct ir_slot slot = ir_slot(j->graph, slots, i);
        bool is_vertical = ir_slot_is_vertical(j->graph, &slot);
        bool light = emits(j->graph, slot.surface);
        base_emits = is_vertical ? base_emits : light;
        if (!is_layer(j, &slot) || (is_vertical && (light || base_emits)))
            return false;
    }
    return num > 1;
}

/* ---- Joining ---- */

static struct lights lights_of(const struct ir_graph *g, ir_ref surface)
{
    if (!surface)
        return (struct lights){0};
    return (struct lights){ir_arg(g, surface, 0), emits(g, surface) ? ir_arg(g, surface, 1) : 0};
}

static ir_ref mixed(struct ir_graph *g, ir_ref bg, ir_ref fg, ir_ref share)
{
    ir_ref args[3] = {bg, fg, share};
    if ((!bg && !fg) || ir_const_is(g, share, 1.0f))
        return fg;
    return ir_build(g, IR_CLOSURE_MIX, ir_type_of(g, fg ? fg : bg), 0, args, 3);
}

/* A coat is as thick as its sheet, or as a body. */
static ir_ref thickness_of(struct joiner *j, ir_ref coat)
{
    struct ir_graph *g = j->graph;
    if (ir_get(g, coat)->op == IR_SLAB_SURFACE && !is_no(g, ir_arg(g, coat, 1)))
        return ir_arg(g, coat, 2);
    uint32_t body = shader_private_uniform(j->shader, STR_u_slabThickness, IR_TYPE_FLOAT, 0);
    return shader_read(j->shader, body);
}

static ir_ref coated(struct joiner *j, ir_ref base, const struct ir_slot *coat)
{
    struct ir_graph *g = j->graph;
    bool is_slabs = ir_get(g, coat->surface)->op == IR_SLAB_SURFACE;
    ir_ref opacity = is_slabs ? 0 : ir_arg(g, coat->surface, 2), share = coat->weight;
    if (opacity)
        share = ir_op2(g, IR_MUL, share, opacity);
    ir_ref top = mixed(g, 0, ir_arg(g, coat->surface, 0), share);
    ir_ref args[3] = {top, base, thickness_of(j, coat->surface)};
    return ir_build(g, IR_SLAB_LAYER, IR_TYPE_BSDF, 0, args, 3);
}

/* A horizontal layer with the vertical ones on it. *next: the layer after them. */
static struct lights layer_of(struct joiner *j, ir_ref slots, unsigned *next)
{
    struct ir_slot slot = ir_slot(j->graph, slots, (*next)++);
    struct lights lights = lights_of(j->graph, slot.surface);
    for (; *next < ir_num_slots(j->graph, slots); ++*next) {
        struct ir_slot over = ir_slot(j->graph, slots, *next);
        if (!ir_slot_is_vertical(j->graph, &over))
            break;
        if (!lights.bsdf || !lights_of(j->graph, over.surface).bsdf)
            continue;
        ir_push_origin_of(j->graph, over.surface);
        lights.bsdf = coated(j, lights.bsdf, &over);
        ir_pop_origin(j->graph);
    }
    return lights;
}

static void add_layer(struct joiner *j, struct lights layer, ir_ref presence)
{
    struct ir_graph *g = j->graph;
    if (!j->coverage) {
        j->below = layer;
        j->coverage = presence;
        return;
    }
    ir_ref missing = closure_one_minus(g, j->coverage);
    missing = ir_op2(g, IR_MUL, missing, closure_one_minus(g, presence));
    j->coverage = closure_one_minus(g, missing);
    ir_ref least = ir_const_float(g, 1e-6f), some = ir_op2(g, IR_MAX, j->coverage, least);
    ir_ref share = ir_op2(g, IR_DIV, presence, some);
    j->below.bsdf = mixed(g, j->below.bsdf, layer.bsdf, share);
    j->below.edf = mixed(g, j->below.edf, layer.edf, share);
}

static ir_ref joined(struct joiner *j, ir_ref slots)
{
    struct ir_graph *g = j->graph;
    ir_ref alpha = ir_arg(g, slots, 0), shaded = closure_shade_slots(j->shader, slots, 0);
    j->coverage = 0;
    for (unsigned next = 0; next < ir_num_slots(g, shaded);) {
        struct ir_slot slot = ir_slot(g, shaded, next);
        struct lights layer = layer_of(j, shaded, &next);
        if (!slot.surface)
            continue;
        ir_push_origin_of(g, slot.surface);
        add_layer(j, layer, slot.presence);
        ir_pop_origin(g);
    }
    ir_ref args[4] = {j->below.bsdf, j->below.edf, alpha, 0};
    ir_push_name(g, str_intern_z(j->shader->strings, "stack"));
    ir_ref surface = ir_build(g, IR_SURFACE_SHADER, IR_TYPE_SURFACE, 0, args, 4);
    ir_pop_origin(g);
    return surface;
}

ir_ref slabs_join_stacks(struct shader *shader, const struct slabs_host *host, ir_ref root)
{
    struct joiner j = {.shader = shader, .graph = shader->graph, .host = host};
    if (!root)
        return 0;
    const uint8_t *needed = ir_mark(j.graph, &root, 1, shader->arena);
    ir_ref result = root;
    for (ir_ref ref = 1; ref <= root; ref++)
        if (needed[ref] && ir_get(j.graph, ref)->op == IR_SLOTS && is_joinable(&j, ref))
            result = ir_replace(j.graph, result, ref, joined(&j, ref), shader->arena);
    return result;
}
