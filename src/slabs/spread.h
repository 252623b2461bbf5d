// SPDX-License-Identifier: Apache-2.0
/*
 * Roughness tracking: a rough interface spreads the light that goes through it, so what lies below
 * looks rougher (Belcour 2018, "Efficient Rendering of Layered Materials using an Atomic
 * Decomposition with Statistical Operators"). Variances of lobes add:
 *
 *     var(alpha) = alpha^1.1 / (1 - alpha^1.1)
 *     spread     = var(alpha/2 |n - 1| / n) + var(alpha/2 |1/n - 1| n)    in and out, n = 1.5
 *     below      : var(alpha') = var(alpha) + spread of what lies above
 *
 * Rough refraction: the way of the view bends at a rough interface, so what lies below is blurred.
 * Half of the facets of GGX have a slope below alpha, and refraction to the index 1.5 leaves a
 * third of it. A normal distribution with that median has the variance
 *
 *     slope      = (alpha / 3)^2 / (2 ln 2)    per axis, for each centimetre of way
 */
#ifndef MXG_SLABS_SPREAD_H
#define MXG_SLABS_SPREAD_H

#include "slabs/slabs.h"

/* False: the interface of a slab is smooth, absent or opaque, whatever lies below. */
bool slab_spreads(const struct ir_graph *graph, const ir_ref *inputs);

/* The spread of the interface of a slab, by its inputs: a float. */
ir_ref slab_spread(struct ir_graph *graph, const ir_ref *inputs);
/* Changes the roughness of both lobes, and of the diffuse reflection. spread 0: unchanged. */
void slab_widen(struct ir_graph *graph, ir_ref spread, ir_ref *inputs);

/* The variance of the slope of a refracted way behind the interface of a slab: a float. */
ir_ref slab_slope(struct ir_graph *graph, const ir_ref *inputs);

#endif
