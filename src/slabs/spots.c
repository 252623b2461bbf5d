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
static uint32_t pile_of(struct slab_spots *spots, ir_ref ref, uint32_t next)
{
    uint32_t hash = hash_pair(ref, next), at = hash, found;
    while ((found = table_next(&spots->known_piles, hash, &at)))
        if (spots->piles.items[found - 1].ref == ref && spots->piles.items[found - 1].next == next)
            return found;
    vec_push(spots->arena, &spots->piles, (struct slab_pile){ref, next});
    table_add(&spots->known_piles, spots->arena, hash, spots->piles.len);
    return spots->piles.len;
}

static void find_spreading(const struct ir_graph *g, const struct slab_nodes *nodes, uint8_t *out)
{
    for (uint32_t at = 1; at < nodes->items.len; at++) {
        ir_ref ref = nodes->items.items[at];
        const struct ir_node *node = ir_get(g, ref);
        if (node->type != IR_TYPE_BSDF)
            continue;
        if (node->op == IR_SLAB)
            out[at] = SLAB_FEATURES_BELOW & ~node->attr && slab_spreads(g, ir_args(g, ref));
        for (uint32_t i = 0; node->op != IR_SLAB && i < node->num_args; i++)
            out[at] |= out[slab_node_at(nodes, ir_arg(g, ref, i))];
    }
}

/* ---- Spots ---- */

bool slabs_is_absent(const struct ir_graph *g, ir_ref ref, uint32_t operand)
{
    return ir_get(g, ref)->op == IR_CLOSURE_MIX
           && ir_const_is(g, ir_arg(g, ref, 2), operand == 0 ? 1.0f : 0.0f);
}

static void add_spot(const struct ir_graph *g, struct slab_spots *spots, struct slab_spot spot)
{
    if (!is_bsdf(g, spot.ref))
        return;
    uint32_t at = slab_node_at(&spots->nodes, spot.ref);
    spot.next = spots->first[at];
    for (uint32_t i = spot.next; i; i = spots->items.items[i - 1].next) {
        const struct slab_spot *known = &spots->items.items[i - 1];
        bool is_there = known->thickness == spot.thickness && known->is_sheet == spot.is_sheet
                        && known->root == spot.root;
        if (is_there
            && (spots->items.len >= SLAB_MAX_SPOTS
                || (known->below == spot.below && known->above == spot.above)))
            return;
    }
    vec_push(spots->arena, &spots->items, spot);
    spots->first[at] = spots->items.len;
}

static bool spreads(const struct slab_spots *spots, ir_ref ref)
{
    return spots->spreads[slab_node_at(&spots->nodes, ref)];
}

/* The operands of an operator lie where it lies, but the top of a layer has its thickness. */
static void spread(struct ir_graph *g, struct slab_spots *spots, ir_ref ref,
                   const struct slab_spot *spot)
{
    uint32_t num_args = ir_get(g, ref)->num_args,
             depth = spots->depth[slab_node_at(&spots->nodes, ref)];
    for (uint32_t i = 0; i < num_args; i++) {
        struct slab_spot at = *spot;
        at.ref = ir_arg(g, ref, i);
        if (!is_bsdf(g, at.ref) || slabs_is_absent(g, ref, i))
            continue;
        if (i == 0 && slabs_is_layer(g, ref)) {
            ir_ref base = ir_arg(g, ref, 1);
            at.thickness = slabs_layer_thickness(g, ref);
            at.is_sheet = false;
            at.below = is_bsdf(g, base) ? pile_of(spots, base, spot->below) : spot->below;
        } else if (i == 1 && slabs_is_layer(g, ref) && spreads(spots, ir_arg(g, ref, 0))) {
            at.above = pile_of(spots, ir_arg(g, ref, 0), spot->above);
        }
        uint32_t *depth_of_arg = &spots->depth[slab_node_at(&spots->nodes, at.ref)];
        if (*depth_of_arg <= depth)
            *depth_of_arg = depth + 1;
        add_spot(g, spots, at);
    }
}

void slabs_find_spots(struct ir_graph *g, ir_ref root, struct arena *arena, struct slab_spots *out)
{
    *out = (struct slab_spots){.arena = arena};
    slabs_find_nodes(g, root, arena, &out->nodes);
    uint32_t num = out->nodes.items.len;
    out->first = ARENA_ARRAY(arena, uint32_t, num);
    out->depth = ARENA_ARRAY(arena, uint32_t, num);
    out->spreads = ARENA_ARRAY(arena, uint8_t, num);
    find_spreading(g, &out->nodes, out->spreads);
    add_spot(g, out, (struct slab_spot){.ref = root, .root = root});
    for (uint32_t at = num; --at > 0;) {
        ir_ref ref = out->nodes.items.items[at];
        uint8_t op = ir_get(g, ref)->op;
        if (op == IR_SLAB_SURFACE || op == IR_SURFACE_SHADER) {
            ir_ref thickness = slabs_sheet_thickness(g, ref);
            add_spot(g, out,
                     (struct slab_spot){.ref = ir_arg(g, ref, 0),
                                        .thickness = thickness,
                                        .is_sheet = thickness != 0,
                                        .root = ref});
        }
        for (uint32_t i = out->first[at]; i; i = out->items.items[i - 1].next) {
            const struct slab_spot spot = out->items.items[i - 1];
            spread(g, out, ref, &spot);
        }
    }
}

const struct slab_spot *slab_spot_at(const struct slab_spots *spots, ir_ref ref, ir_ref thickness)
{
    uint32_t first = spots->first[slab_node_at(&spots->nodes, ref)];
    for (uint32_t i = first; i; i = spots->items.items[i - 1].next)
        if (spots->items.items[i - 1].thickness == thickness)
            return &spots->items.items[i - 1];
    return NULL;
}
