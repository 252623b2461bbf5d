// SPDX-License-Identifier: Apache-2.0
/* Small letters in pictures: capitals, digits and what else stands in names. */
#ifndef MXG_RENDER_LABEL_H
#define MXG_RENDER_LABEL_H

#include <stdint.h>

enum { LABEL_ADVANCE = 6, LABEL_HEIGHT = 7 }; /* of a letter, in pixels of scale 1 */

/* Writes text in white over RGBA at (x, y), its upper left corner, cut at `width` pixels. */
void label_draw(uint8_t *rgba, uint32_t stride, uint32_t x, uint32_t y, uint32_t width,
                unsigned scale, const char *text);

#endif
