// SPDX-License-Identifier: Apache-2.0
/* Draws small text in pictures: capitals, digits and punctuation of names. */
#ifndef MXG_RENDER_LABEL_H
#define MXG_RENDER_LABEL_H

#include <stdint.h>

enum { LABEL_ADVANCE = 6, LABEL_HEIGHT = 7 }; /* of a letter, in pixels at scale 1 */

/* Writes white text over RGBA at its upper left corner (x, y), clipped to `width` pixels. */
void label_draw(uint8_t *rgba, uint32_t stride, uint32_t x, uint32_t y, uint32_t width,
                unsigned scale, const char *text);

#endif
