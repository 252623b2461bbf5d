// SPDX-License-Identifier: Apache-2.0
/*
 * A surface is a piece of matter: what is there, and the probability o that it is there, its
 * opacity. Slabs tell themselves what they let through, so they are always there.
 *
 *     mix(a, b, t)    o = (1 - t) o_a + t o_b,  mix(a, b, t o_b / o)
 *
 * A stack from the base up, with the mask m of a layer and its presence h = m o:
 *
 *     coverage        c' = 1 - (1 - c)(1 - h)
 *     horizontal      mix(all below, layer, h / c')
 *     a sheet         layer(m · sheet, all below); c' = 1
 *     vertical        layer(m · layer, the layer below)
 *
 * The opacity of the stack is c' times the cutouts. So every layer keeps the weight that it has in
 * the stack.
 */
#include "slabs/joined_surfaces.h"

#include "ir/arithmetic.h"
#include "shader/formula.h"

struct piece {
    ir_ref bsdf;
    ir_ref edf;       /* for a budget; light that walks has it on the bsdf */
    ir_ref opacity;   /* 0: 1 */
    ir_ref thickness; /* of a sheet; 0: it is none */
    bool is_solid;    /* light that passes the bsdf ends there */
    ir_ref *aovs;     /* BSDFs by number of the AOV; 0: absent */
};

struct joiner {
    struct shader *shader;
    struct ir_graph *graph;
    const struct slabs_host *host;
    bool walks;          /* for light that walks, else for a budget */
    struct piece *known; /* by surface */
};

static bool is_no(const struct ir_graph *g, ir_ref flag)
{
    struct ir_value value;
    return !flag || (ir_get_const(g, flag, &value) && !value.w[0].u);
}

static ir_ref one_or(const struct joiner *j, ir_ref opacity)
{
    return opacity ? opacity : ir_const_float(j->graph, 1.0f);
}

/* ---- Trees ---- */

static ir_ref mixed(const struct joiner *j, ir_ref bg, ir_ref fg, ir_ref share)
{
    ir_ref args[3] = {bg, fg, share};
    if ((!bg && !fg) || ir_const_is(j->graph, share, 1.0f))
        return fg;
    return ir_build(j->graph, IR_CLOSURE_MIX, ir_type_of(j->graph, fg ? fg : bg), 0, args, 3);
}

static ir_ref layered(const struct joiner *j, ir_ref top, ir_ref base, ir_ref thickness)
{
    ir_ref args[3] = {top, base, thickness};
    return top ? ir_build(j->graph, IR_SLAB_LAYER, IR_TYPE_BSDF, 0, args, 3) : base;
}

static ir_ref on(const struct joiner *j, ir_ref top, ir_ref base)
{
    ir_ref args[2] = {top, base};
    return top ? ir_build(j->graph, IR_LAYER, IR_TYPE_BSDF, 0, args, 2) : base;
}

/* Returns what is there with this probability; 0: always. */
static ir_ref covered(const struct joiner *j, ir_ref bsdf, ir_ref opacity)
{
    return opacity && bsdf ? mixed(j, 0, bsdf, opacity) : bsdf;
}

static ir_ref *new_aovs(const struct joiner *j)
{
    return ARENA_ARRAY(j->shader->arena, ir_ref, j->shader->interface.aovs.len);
}

/* All parts of two pieces beside each other; the opacity is the caller's. */
static struct piece beside(const struct joiner *j, const struct piece *bg, const struct piece *fg,
                           ir_ref share)
{
    struct piece out = {.bsdf = mixed(j, bg->bsdf, fg->bsdf, share),
                        .edf = mixed(j, bg->edf, fg->edf, share),
                        .aovs = new_aovs(j)};
    for (uint32_t i = 0; i < j->shader->interface.aovs.len; i++)
        out.aovs[i] = mixed(j, bg->aovs[i], fg->aovs[i], share);
    return out;
}

/* True if light may pass the lowest closure, which is no slab. */
static bool is_open_below(const struct joiner *j, ir_ref bsdf)
{
    const struct ir_graph *g = j->graph;
    while (bsdf && ir_type_of(g, bsdf) == IR_TYPE_BSDF && ir_get(g, bsdf)->op != IR_LEAF) {
        uint8_t op = ir_get(g, bsdf)->op;
        bool is_layer = slabs_is_layer(g, bsdf);
        if (!is_layer && op != IR_CLOSURE_SCALE)
            return false;
        ir_ref base = is_layer ? ir_arg(g, bsdf, 1) : 0;
        bool is_base = base && ir_type_of(g, base) == IR_TYPE_BSDF;
        bsdf = is_base ? base : ir_arg(g, bsdf, 0);
    }
    ir_ref way = ir_const_float(j->graph, 0.0f);
    return !bsdf || ir_type_of(g, bsdf) != IR_TYPE_BSDF
           || !ir_const_is(g, closure_throughput(j->shader, j->host->closures, bsdf, way), 0.0f);
}

/* A piece that is no layer on others: a sheet with its thickness, a solid with its floor. */
static struct piece alone(const struct joiner *j, struct piece piece)
{
    struct ir_graph *g = j->graph;
    if (piece.thickness) {
        const ir_ref *aovs = piece.aovs;
        piece.bsdf = layered(j, piece.bsdf, 0, piece.thickness);
        piece.aovs = new_aovs(j);
        for (uint32_t i = 0; i < j->shader->interface.aovs.len; i++)
            piece.aovs[i] = layered(j, aovs[i], 0, piece.thickness);
    } else if (j->walks && piece.is_solid && is_open_below(j, piece.bsdf)) {
        ir_ref black = ir_const_splat(g, IR_TYPE_VEC3, 0.0f);
        piece.bsdf = on(j, piece.bsdf, j->host->slab_like(j->host->user_data, 0, black));
    }
    piece.thickness = 0;
    piece.is_solid = false;
    return piece;
}

/* ---- Pieces ---- */

static bool is_slabs(const struct ir_graph *g, ir_ref surface)
{
    return ir_get(g, surface)->op == IR_SLAB_SURFACE;
}

static struct piece leaf_of(const struct joiner *j, ir_ref ref)
{
    const struct ir_graph *g = j->graph;
    struct piece out = {.aovs = new_aovs(j), .is_solid = !is_slabs(g, ref)};
    if (ir_get(g, ref)->op == IR_SURFACE_UNLIT) {
        out.opacity = closure_surface_alpha(j->shader, ref);
        return out;
    }
    out.bsdf = ir_arg(g, ref, 0);
    if (is_slabs(g, ref)) {
        out.thickness = is_no(g, ir_arg(g, ref, 1)) ? 0 : ir_arg(g, ref, 2);
        return out;
    }
    if (j->walks)
        out.bsdf = on(j, ir_arg(g, ref, 1), out.bsdf);
    else
        out.edf = ir_arg(g, ref, 1);
    out.opacity = ir_const_is(g, ir_arg(g, ref, 2), 1.0f) ? 0 : ir_arg(g, ref, 2);
    return out;
}

static struct piece with_aov(const struct joiner *j, ir_ref ref)
{
    struct piece out = j->known[ir_arg(j->graph, ref, 0)];
    ir_ref value = ir_arg(j->graph, ref, 1), *aovs = new_aovs(j);
    if (ir_type_of(j->graph, value) != IR_TYPE_BSDF)
        return out;
    memcpy(aovs, out.aovs, j->shader->interface.aovs.len * sizeof *aovs);
    aovs[ir_get(j->graph, ref)->attr] = value;
    out.aovs = aovs;
    return out;
}

static struct piece mix_of(const struct joiner *j, ir_ref ref)
{
    struct ir_graph *g = j->graph;
    const struct piece bg = alone(j, j->known[ir_arg(g, ref, 0)]),
                       fg = alone(j, j->known[ir_arg(g, ref, 1)]);
    ir_ref mix = ir_arg(g, ref, 2), opacity = 0, share = mix;
    if (bg.opacity || fg.opacity) {
        ir_ref behind = one_or(j, bg.opacity), before = one_or(j, fg.opacity);
        opacity = ir_op3(g, IR_MIX, behind, before, mix);
        ir_ref there = ir_product(j->graph, mix, fg.opacity);
        share = FORMULA(j->shader, "mx_blend_per_coverage", there, opacity);
    }
    struct piece out = beside(j, &bg, &fg, share);
    out.opacity = opacity;
    return out;
}

/* A coat is as thick as its sheet, or as a body. */
static ir_ref thickness_of(const struct joiner *j, const struct piece *coat)
{
    if (coat->thickness)
        return coat->thickness;
    uint32_t body = shader_private_uniform(j->shader, STR_u_slabThickness, IR_TYPE_FLOAT, 0);
    return shader_read(j->shader, body);
}

/* The coat covers the AOVs of its base that it has, too. */
static void put_coat(const struct joiner *j, struct piece *base, const struct piece *coat,
                     ir_ref mask)
{
    ir_ref share = ir_product(j->graph, mask, coat->opacity);
    if (base->bsdf && coat->bsdf) {
        ir_ref top = mixed(j, 0, coat->bsdf, share), thickness = thickness_of(j, coat);
        base->bsdf = layered(j, top, base->bsdf, thickness);
    }
    ir_ref *aovs = new_aovs(j);
    for (uint32_t i = 0; i < j->shader->interface.aovs.len; i++)
        aovs[i] = coat->aovs[i] ? mixed(j, base->aovs[i], coat->aovs[i], share) : base->aovs[i];
    base->aovs = aovs;
}

/* A layer with the vertical ones on it. *next: the slot after them. */
static struct piece layer_of(const struct joiner *j, ir_ref slots, unsigned *next)
{
    struct ir_slot slot = ir_slot(j->graph, slots, (*next)++);
    struct piece layer = slot.surface ? j->known[slot.surface] : (struct piece){0};
    for (; *next < ir_num_slots(j->graph, slots); ++*next) {
        struct ir_slot over = ir_slot(j->graph, slots, *next);
        if (!ir_slot_is_vertical(j->graph, &over))
            break;
        if (!slot.surface || !over.surface)
            continue;
        ir_push_origin_of(j->graph, over.surface);
        put_coat(j, &layer, &j->known[over.surface], over.mask);
        ir_pop_origin(j->graph);
    }
    return layer;
}

/* A sheet lies on all below. */
static struct piece under_sheet(const struct joiner *j, const struct piece *below,
                                const struct piece *sheet, ir_ref mask)
{
    struct piece out = beside(j, below, sheet, mask);
    ir_ref base = covered(j, below->bsdf, below->opacity);
    out.bsdf = layered(j, covered(j, sheet->bsdf, mask), base, sheet->thickness);
    return out;
}

/* below->aovs NULL: there is nothing. */
static void put_layer(const struct joiner *j, struct piece *below, struct piece layer, ir_ref mask)
{
    if (layer.thickness && below->aovs) {
        *below = under_sheet(j, below, &layer, mask);
        return;
    }
    layer = alone(j, layer);
    ir_ref presence =
        ir_product(j->graph, mask, layer.opacity ? ir_share(j->graph, layer.opacity) : 0);
    if (below->aovs) {
        ir_ref whole = one_or(j, below->opacity),
               coverage = FORMULA(j->shader, "mx_blend_coverage", whole, presence),
               share = FORMULA(j->shader, "mx_blend_per_coverage", presence, coverage);
        layer = beside(j, below, &layer, share);
        presence = coverage;
    }
    *below = layer;
    below->opacity = presence;
}

static struct piece stack_of(const struct joiner *j, ir_ref slots)
{
    struct piece below = {0};
    for (unsigned next = 0; next < ir_num_slots(j->graph, slots);) {
        struct ir_slot slot = ir_slot(j->graph, slots, next);
        struct piece layer = layer_of(j, slots, &next);
        if (!slot.surface)
            continue;
        ir_push_origin_of(j->graph, slot.surface);
        put_layer(j, &below, layer, slot.mask);
        ir_pop_origin(j->graph);
    }
    below.aovs = below.aovs ? below.aovs : new_aovs(j);
    below.opacity = ir_product(j->graph, below.opacity, ir_arg(j->graph, slots, 1));
    return below;
}

static struct piece piece_of(const struct joiner *j, ir_ref ref)
{
    switch (ir_get(j->graph, ref)->op) {
    case IR_SURFACE_SHADER:
    case IR_SURFACE_UNLIT:
    case IR_SLAB_SURFACE: return leaf_of(j, ref);
    case IR_AOV: return with_aov(j, ref);
    case IR_SHADER_MIX: return mix_of(j, ref);
    case IR_SLOTS: return stack_of(j, ref);
    default: return (struct piece){.aovs = new_aovs(j)};
    }
}

/* Operands precede their node, so one pass finds nested ones. */
static struct piece joined(struct joiner *j, ir_ref root)
{
    struct ir_graph *g = j->graph;
    if (ir_get(g, root)->op == IR_SLOTS)
        root = closure_shade_slots(j->shader, root, 0);
    const uint8_t *needed = ir_mark(g, &root, 1, j->shader->arena);
    j->known = ARENA_ARRAY(j->shader->arena, struct piece, root + 1);
    for (ir_ref ref = 1; ref <= root; ref++) {
        if (!needed[ref] || ir_type_of(g, ref) != IR_TYPE_SURFACE)
            continue;
        ir_push_origin_of(g, ref);
        j->known[ref] = piece_of(j, ref);
        ir_pop_origin(g);
    }
    return j->known[root];
}

/* ---- Budgets ---- */

/* Light that passes slabs goes to what lies below, which a mix does not do. */
static bool is_opaque(const struct joiner *j, ir_ref slabs)
{
    ir_ref walked = slabs_walk(j->shader, j->host, slabs);
    return ir_const_is(j->graph, ir_arg(j->graph, walked, 2), 0.0f);
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

static ir_ref joined_stack(struct joiner *j, ir_ref slots)
{
    struct ir_graph *g = j->graph;
    struct piece piece = joined(j, slots);
    ir_ref args[4] = {piece.bsdf, piece.edf, ir_arg(g, slots, 0), 0};
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
            result = ir_replace(j.graph, result, ref, joined_stack(&j, ref), shader->arena);
    return result;
}

/* ---- Light that walks ---- */

static bool is_one_piece(const struct ir_graph *g, ir_ref surface)
{
    for (; ir_get(g, surface)->op == IR_AOV; surface = ir_arg(g, surface, 0))
        if (ir_type_of(g, ir_arg(g, surface, 1)) == IR_TYPE_BSDF)
            return false;
    uint8_t op = ir_get(g, surface)->op;
    return op != IR_SHADER_MIX && op != IR_SLOTS;
}

static ir_ref matter_of(struct joiner *j, ir_ref surface)
{
    uint32_t num_aovs = j->shader->interface.aovs.len;
    ir_ref *args = ARENA_ARRAY(j->shader->arena, ir_ref, num_aovs + 2);
    struct piece piece = alone(j, joined(j, surface));
    args[0] = surface;
    args[1] = covered(j, piece.bsdf, piece.opacity);
    for (uint32_t i = 0; i < num_aovs; i++)
        args[i + 2] = covered(j, piece.aovs[i], piece.opacity);
    return ir_build(j->graph, IR_MATTER, IR_TYPE_SURFACE, 0, args, num_aovs + 2);
}

ir_ref slabs_join_matter(struct shader *shader, const struct slabs_host *host, ir_ref root)
{
    struct joiner j = {.shader = shader, .graph = shader->graph, .host = host, .walks = true};
    ir_ref args[4] = {root, 0, 0, 0};
    bool is_material = root && ir_get(j.graph, root)->op == IR_MATERIAL;
    if (is_material)
        memcpy(args, ir_args(j.graph, root), sizeof args);
    if (!args[0] || ir_type_of(j.graph, args[0]) != IR_TYPE_SURFACE
        || is_one_piece(j.graph, args[0]) || !slabs_has_media(shader, args[0]))
        return root;
    args[0] = matter_of(&j, args[0]);
    return is_material ? ir_build(j.graph, IR_MATERIAL, IR_TYPE_MATERIAL, 0, args, 4) : args[0];
}
