// SPDX-License-Identifier: Apache-2.0
/* blend.c: one slab with blended inputs in the place of an operator and its slabs. */
#ifndef MXG_SLABS_BLEND_H
#define MXG_SLABS_BLEND_H

#include "slabs/spots.h"

struct slab_blend {
    struct shader *shader;
    const struct slabs_host *host;
    uint32_t off; /* features, as bits, that the result does not get */
};

/* True for an operator whose operands are slabs, or one slab, also below coverages. */
bool slab_can_blend(const struct ir_graph *graph, ir_ref ref);

/*
 * The slab that stands for an operator at its spot. It reflects light like the operator along the
 * normal; its roughness, its normal and its tangent are means by reflected light.
 */
ir_ref slab_blended(const struct slab_blend *blend, const struct slab_spot *spot);

#endif
