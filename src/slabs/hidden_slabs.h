// SPDX-License-Identifier: Apache-2.0
/*
 * hidden_slabs.c: matter that opaque matter above it hides at every point. No pixel has it, so no
 * budget counts it.
 */
#ifndef MXG_SLABS_HIDDEN_SLABS_H
#define MXG_SLABS_HIDDEN_SLABS_H

#include "slabs/slabs.h"

/* True for a slab that no light goes through. */
typedef bool slab_is_opaque_fn(void *user_data, ir_ref slab);

/* True for matter that lets nothing through, at every point: a closure, or 0. */
bool slabs_hides(const struct ir_graph *graph, ir_ref matter, slab_is_opaque_fn *is_opaque,
                 void *user_data, struct arena *scratch);

/* The tree without what its values, as the shader has them, hide. The scratch gets garbage. */
ir_ref slabs_visible(struct ir_graph *graph, ir_ref root, struct arena *scratch);

#endif
