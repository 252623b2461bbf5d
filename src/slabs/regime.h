// SPDX-License-Identifier: Apache-2.0
/*
 * A medium without an albedo is clear: light goes straight through it. A slab as a whole is clear,
 * not a texel of it: its albedo is 0 as a constant or as a uniform. Where an albedo varies over the
 * surface, its 0 is a black that hides what lies behind (docs/slabs.md).
 */
#ifndef MXG_SLABS_REGIME_H
#define MXG_SLABS_REGIME_H

#include "slabs/slabs.h"

/* The albedo of such a black, less than any matter has. */
#define SLAB_BLACK 0.001f

/* SLAB_NEVER_CLEAR for the operands of a slab that nobody blends, or 0. */
uint32_t slab_regime(const struct ir_graph *graph, const ir_ref *operands);
/* The albedo of a slab with an attribute and a mean free path, which is black instead of 0. */
ir_ref slab_regime_albedo(struct ir_graph *graph, uint32_t attr, ir_ref path, ir_ref albedo);

#endif
