// SPDX-License-Identifier: Apache-2.0
/*
 * Where the slabs of a tree lie, before the walk. One slab at two thicknesses, or with other matter
 * above or below, is two spots.
 */
#ifndef MXG_SLABS_SPOTS_H
#define MXG_SLABS_SPOTS_H

#include "base/table.h"
#include "slabs/slab_nodes.h"
#include "slabs/slabs.h"

struct slab_spot {
    ir_ref ref;       /* a closure */
    ir_ref thickness; /* float; 0: of the body */
    ir_ref root;      /* the surface shader, or the closure at the top */
    uint32_t below;   /* all matter below it: of slab_spots.piles; 0: none */
    uint32_t above;   /* all matter above it that changes its roughness, the same */
    bool is_sheet;    /* the thickness is that of a sheet */
    uint32_t next;    /* of the same closure, + 1 */
};

/* Matter on other matter. */
struct slab_pile {
    ir_ref ref;
    uint32_t next; /* index of the rest + 1; 0: nothing */
};

struct slab_spots {
    VEC(struct slab_spot) items; /* operators before their operands */
    struct slab_nodes nodes;
    uint32_t *first;             /* per node: index in items + 1; 0: none */
    uint32_t *depth;             /* per node: operators above it, at most */
    uint8_t *spreads;            /* per node: what lies below it looks rougher, or blurred */
    VEC(struct slab_pile) piles; /* each once */
    struct table known_piles;    /* their indices + 1 */
    struct arena *arena;
};

/* All closures below a root of any type. root 0: none. The arena keeps the list. */
void slabs_find_spots(struct ir_graph *graph, ir_ref root, struct arena *arena,
                      struct slab_spots *out);

/* The first spot of a closure below the root. */
static inline const struct slab_spot *slab_spot_of(const struct slab_spots *spots, ir_ref ref)
{
    return &spots->items.items[spots->first[slab_node_at(&spots->nodes, ref)] - 1];
}

/* The first one at a thickness; NULL: there is none. */
const struct slab_spot *slab_spot_at(const struct slab_spots *spots, ir_ref ref, ir_ref thickness);

/* True for an operand of a mix whose share is the constant 0: it has no spot. */
bool slabs_is_absent(const struct ir_graph *graph, ir_ref ref, uint32_t operand);

/* From there on, matter above and below makes no other spots. */
enum { SLAB_MAX_SPOTS = 4096 };

#endif
