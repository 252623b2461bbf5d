// SPDX-License-Identifier: Apache-2.0
#include "slabs/spots.h"

#include "slabs/spread.h"

#include "base/hash.h"

static bool is_bsdf(const struct ir_graph *g, ir_ref ref)
{
    return ref && ir_type_of(g, ref) == IR_TYPE_BSDF;
}

/* ---- Piles ---- */

/* The index + 1 of matter on other matter. */
static uint32_t pile_of(const struct shader *shader, struct slab_spots *spots, ir_ref ref,
                        uint32_t next)
{
    uint32_t hash = hash_pair(ref, next), at = hash, found;
    while ((found = table_next(&spots->known_piles, hash, &at)))
        if (spots->piles.items[found - 1].ref == ref && spots->piles.items[found - 1].next == next)
            return found;
    vec_push(shader->arena, &spots->piles, (struct slab_pile){ref, next});
    table_add(&spots->known_piles, shader->arena, hash, spots->piles.len);
    return spots->piles.len;
}

static void find_spreading(const struct shader *shader, ir_ref root, const uint8_t *needed,
                           uint8_t *out)
{
    const struct ir_graph *g = shader->graph;
    for (ir_ref ref = 1; ref <= root; ref++) {
        const struct ir_node *node = ir_get(g, ref);
        if (!needed[ref] || node->type != IR_TYPE_BSDF)
            continue;
        if (node->op == IR_SLAB)
            out[ref] = SLAB_FEATURES_BELOW & ~node->attr && slab_spreads(g, ir_args(g, ref));
        for (uint32_t i = 0; node->op != IR_SLAB && i < node->num_args; i++)
            out[ref] |= out[ir_arg(g, ref, i)];
    }
}

/* ---- Spots ---- */

bool slabs_is_absent(const struct ir_graph *g, ir_ref ref, uint32_t operand)
{
    return ir_get(g, ref)->op == IR_CLOSURE_MIX
           && ir_const_is(g, ir_arg(g, ref, 2), operand == 0 ? 1.0f : 0.0f);
}

static void add_spot(const struct shader *shader, struct slab_spots *spots, struct slab_spot spot)
{
    if (!is_bsdf(shader->graph, spot.ref))
        return;
    spot.next = spots->first[spot.ref];
    for (uint32_t i = spot.next; i; i = spots->items.items[i - 1].next) {
        const struct slab_spot *known = &spots->items.items[i - 1];
        bool is_there = known->thickness == spot.thickness && known->is_sheet == spot.is_sheet
                        && known->root == spot.root;
        if (is_there
            && (spots->items.len >= SLAB_MAX_SPOTS
                || (known->below == spot.below && known->above == spot.above)))
            return;
    }
    vec_push(shader->arena, &spots->items, spot);
    spots->first[spot.ref] = spots->items.len;
}

/* The operands of an operator lie where it lies, but the top of a layer has its thickness. */
static void spread(const struct shader *shader, struct slab_spots *spots, ir_ref ref,
                   const struct slab_spot *spot)
{
    struct ir_graph *g = shader->graph;
    uint32_t num_args = ir_get(g, ref)->num_args;
    for (uint32_t i = 0; i < num_args; i++) {
        struct slab_spot at = *spot;
        at.ref = ir_arg(g, ref, i);
        if (!is_bsdf(g, at.ref) || slabs_is_absent(g, ref, i))
            continue;
        if (i == 0 && slabs_is_layer(g, ref)) {
            ir_ref base = ir_arg(g, ref, 1);
            at.thickness = slabs_layer_thickness(g, ref);
            at.is_sheet = false;
            at.below = is_bsdf(g, base) ? pile_of(shader, spots, base, spot->below) : spot->below;
        } else if (i == 1 && slabs_is_layer(g, ref) && spots->spreads[ir_arg(g, ref, 0)]) {
            at.above = pile_of(shader, spots, ir_arg(g, ref, 0), spot->above);
        }
        if (spots->depth[at.ref] <= spots->depth[ref])
            spots->depth[at.ref] = spots->depth[ref] + 1;
        add_spot(shader, spots, at);
    }
}

void slabs_find_spots(const struct shader *shader, ir_ref root, struct slab_spots *out)
{
    struct ir_graph *g = shader->graph;
    *out = (struct slab_spots){.num_nodes = root + 1};
    out->first = ARENA_ARRAY(shader->arena, uint32_t, root + 1);
    out->depth = ARENA_ARRAY(shader->arena, uint32_t, root + 1);
    if (!root)
        return;
    const uint8_t *needed = ir_mark(g, &root, 1, shader->arena);
    out->spreads = ARENA_ARRAY(shader->arena, uint8_t, root + 1);
    find_spreading(shader, root, needed, out->spreads);
    add_spot(shader, out, (struct slab_spot){.ref = root, .root = root});
    for (ir_ref ref = root; ref; ref--) {
        uint8_t op = ir_get(g, ref)->op;
        if (needed[ref] && (op == IR_SLAB_SURFACE || op == IR_SURFACE_SHADER)) {
            ir_ref thickness = slabs_sheet_thickness(g, ref);
            add_spot(shader, out,
                     (struct slab_spot){.ref = ir_arg(g, ref, 0),
                                        .thickness = thickness,
                                        .is_sheet = thickness != 0,
                                        .root = ref});
        }
        for (uint32_t i = out->first[ref]; i; i = out->items.items[i - 1].next) {
            const struct slab_spot spot = out->items.items[i - 1];
            spread(shader, out, ref, &spot);
        }
    }
}

const struct slab_spot *slab_spot_at(const struct slab_spots *spots, ir_ref ref, ir_ref thickness)
{
    for (uint32_t i = spots->first[ref]; i; i = spots->items.items[i - 1].next)
        if (spots->items.items[i - 1].thickness == thickness)
            return &spots->items.items[i - 1];
    return NULL;
}
