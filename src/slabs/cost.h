// SPDX-License-Identifier: Apache-2.0
/*
 * cost.c: what a tree of slabs costs. Of matter that a mask selects (<slab_select>), a pixel has
 * one side, so the larger one counts.
 */
#ifndef MXG_SLABS_COST_H
#define MXG_SLABS_COST_H

#include "slabs/slabs.h"

/* The closure on top of all others below a root; ref 0: there is none. */
struct slab_top {
    ir_ref ref;
    bool is_whole; /* no operator takes light from it */
};
struct slab_top slabs_top(const struct ir_graph *graph, ir_ref root);

/* The cost of the closures below a root, in the pixel that has most. */
struct slab_cost {
    uint32_t closures; /* slabs and other BSDFs, each at each thickness */
    uint32_t others;   /* of them, those that are no slabs */
    uint32_t bytes;    /* of the slabs */
    uint32_t features; /* of any slab */
};
/* The scratch gets garbage. */
struct slab_cost slabs_cost(struct ir_graph *graph, ir_ref root, struct arena *scratch);

/* The closures of both sides. */
uint32_t slabs_num_closures(struct ir_graph *graph, ir_ref root, struct arena *scratch);

/* True for a share that is 0 or 1, by a condition. */
bool slab_is_choice(const struct ir_graph *graph, ir_ref share);

#endif
