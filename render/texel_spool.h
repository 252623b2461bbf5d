// SPDX-License-Identifier: Apache-2.0
/*
 * Texels of an image on disk, so that large images need little memory. The file has no name, so
 * nothing of it stays.
 */
#ifndef MXG_RENDER_TEXEL_SPOOL_H
#define MXG_RENDER_TEXEL_SPOOL_H

#include <stdbool.h>
#include <stdint.h>

struct spool {
    int file;
    uint32_t width, height, channels;
    /* of the texels that were put */
    uint64_t count;
    double sum[4];
    float low[4], high[4];
};

/* A spool in a folder. All texels must be put before they are read. Returns NULL, or the reason for
 * a failure. */
const char *spool_open(struct spool *spool, const char *folder, uint32_t width, uint32_t height,
                       uint32_t channels);
void spool_close(struct spool *spool);

/*
 * Puts consecutive texels of a row: `channels` numbers each. The first number of an empty texel is
 * NaN; others must be finite. Returns NULL, or the reason for a failure.
 */
const char *spool_put(struct spool *spool, uint32_t x, uint32_t y, uint32_t count,
                      const float *texels);
/* Reads whole rows. Returns NULL, or the reason for a failure. */
const char *spool_read(const struct spool *spool, uint32_t row, uint32_t count, float *out);

#endif
