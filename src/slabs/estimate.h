// SPDX-License-Identifier: Apache-2.0
/*
 * estimate.c: what a tree of slabs looks like, without a picture: the colours of fixed points of a
 * ball in a white environment of 0.5, with one light. The graph's evaluator computes them with the
 * document's values and texels; a texture that cannot be read counts as a few fixed colours.
 */
#ifndef MXG_SLABS_ESTIMATE_H
#define MXG_SLABS_ESTIMATE_H

#include "slabs/places.h"
#include "slabs/slabs.h"

struct slab_look {
    VEC(float) colors; /* in threes */
    struct slab_glances glances;
    bool is_known;      /* false: the evaluator cannot compute a value */
    uint64_t num_steps; /* that the evaluator took */
};

/*
 * Looks at all surfaces below a root, with the glances of `like`; NULL: as the root needs. The
 * arena host->scratch is empty after the call.
 */
void slabs_look(struct shader *shader, const struct slabs_host *host, ir_ref root,
                const struct slab_look *like, struct slab_look *out);

/*
 * Returns what a closure lets through as a layer of this thickness, of light on the mean way
 * and goes out along the normal: a vec3 for slabs_brightness.
 */
ir_ref slabs_through(struct shader *shader, const struct slabs_host *host, ir_ref top,
                     ir_ref thickness);
/* The mean of the channels, seen along the normal; below 0: unknown. */
float slabs_brightness(struct shader *shader, const struct slabs_host *host, ir_ref color);

/* The mean CIEDE2000 of two looks of one document. -1: unknown. */
float slabs_difference(const struct slab_look *a, const struct slab_look *b);

#endif
