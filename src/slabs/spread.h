// SPDX-License-Identifier: Apache-2.0
/*
 * Roughness tracking: a rough interface spreads the light that goes through it, so what lies below
 * looks rougher (Belcour 2018, "Efficient Rendering of Layered Materials using an Atomic
 * Decomposition with Statistical Operators"). Variances of lobes add:
 *
 *     var(alpha) = alpha^1.1 / (1 - alpha^1.1)
 *     spread     = var(alpha/2 |n - 1| / n) + var(alpha/2 |1/n - 1| n)    in and out, n = 1.5
 *     below      : var(alpha') = var(alpha) + spread of what lies above
 */
#ifndef MXG_SLABS_SPREAD_H
#define MXG_SLABS_SPREAD_H

#include "slabs/slabs.h"

/* The spread of the interface of a slab, by its inputs: a float. */
ir_ref slab_spread(struct ir_graph *graph, const ir_ref *inputs);
/* Changes the roughness of both lobes, and of the diffuse reflection. spread 0: unchanged. */
void slab_widen(struct ir_graph *graph, ir_ref spread, ir_ref *inputs);

#endif
