// SPDX-License-Identifier: Apache-2.0
/* Texels beside the triangles of a surface, so that filters do not read what lies between them. */
#ifndef MXG_RENDER_DILATE_H
#define MXG_RENDER_DILATE_H

#include "render/texel_spool.h"

/*
 * Rows of a spool, in bands: empty texels take the nearest one within `padding`, and others the
 * mean of all.
 */
struct dilation {
    const struct spool *spool;
    uint32_t padding;
    float *rows;     /* of the band, and `padding` more on each side */
    uint32_t *above; /* by texel of `rows`: rows to the nearest one with a value; malloc */
};

void dilation_begin(struct dilation *dilation, const struct spool *spool, uint32_t padding);
/*
 * Fills `out` with `count` rows, at most DILATION_BAND, from `row` on. Returns NULL, or the reason
 * for a failure.
 */
enum { DILATION_BAND = 64 };
const char *dilation_read(struct dilation *dilation, uint32_t row, uint32_t count, float *out);
void dilation_end(struct dilation *dilation);

#endif
