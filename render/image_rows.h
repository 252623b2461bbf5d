// SPDX-License-Identifier: Apache-2.0
/* An image file that is written row by row, so that it need not fit into memory. */
#ifndef MXG_RENDER_IMAGE_ROWS_H
#define MXG_RENDER_IMAGE_ROWS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

struct image_format {
    uint32_t width, height;
    uint32_t channels; /* 1, 3 or 4 */
    uint32_t depth;    /* bits: 8 or 16 as parts of 1; 32 for floats of EXR, which has 16 too */
    bool is_float;
    bool is_srgb; /* says that the numbers are encoded so; does not convert */
};

struct image_rows;

/*
 * Begins a file that goes to `out`, which outlives the rows; the ending of the path selects the
 * format. NULL with the reason. Call image_rows_end in any case; it accepts NULL. A full disk is
 * a fault of `out`, which its owner finds.
 */
struct image_rows *image_rows_begin(FILE *out, const char *path, const struct image_format *format,
                                    char *reason, size_t capacity);
/* Writes the next rows from the top: `channels` numbers of each texel. false with the reason. */
bool image_rows_add(struct image_rows *rows, uint32_t count, const float *values, char *reason,
                    size_t capacity);
/* Ends the file, whose rows must be complete. false with the reason. */
bool image_rows_end(struct image_rows *rows, char *reason, size_t capacity);

#ifdef __cplusplus
}
#endif
#endif
