// SPDX-License-Identifier: Apache-2.0
/*
 * Roughness tracking: a rough interface spreads the light that goes through it, so what lies below
 * looks rougher, and rough refraction: the way of the view bends there, so what lies below is
 * blurred (libraries/slabs/spread.glsl). A medium that scatters light lights what lies below it
 * evenly (libraries/slabs/scatter.glsl).
 */
#ifndef MXG_SLABS_SPREAD_H
#define MXG_SLABS_SPREAD_H

#include "slabs/slabs.h"

/* False: light goes straight through a slab, or not at all, whatever lies below. */
bool slab_spreads(const struct ir_graph *graph, const ir_ref *inputs);

/* The spread of the interface of a slab, by its inputs: a float. */
ir_ref slab_spread(struct shader *shader, const ir_ref *inputs);
/* Changes the roughness of both lobes, and of the diffuse reflection. spread 0: unchanged. */
void slab_widen(struct shader *shader, ir_ref spread, ir_ref *inputs);

/*
 * The optical depth for scattering of a centimetre of a slab, by its inputs: a vec3; 0: light goes
 * straight.
 */
ir_ref slab_scattering(struct shader *shader, const ir_ref *inputs);
/*
 * Below media of this depth (0: none) opaque matter gets a part of its light evenly, and what its
 * interface mirrors of that becomes a part of its diffuse albedo.
 */
void slab_even(struct shader *shader, ir_ref depth, ir_ref *inputs);

/* The variance of the slope of a refracted way behind the interface of a slab: a float. */
ir_ref slab_slope(struct shader *shader, const ir_ref *inputs);

#endif
