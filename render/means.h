// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_RENDER_MEANS_H
#define MXG_RENDER_MEANS_H

#include <stdint.h>

/*
 * Writes the means of size × size equal parts of an image to standard output, as floats: rows from
 * the top, RGBA each. Returns the exit code.
 */
int means_print(const char *file, const char *layer, uint32_t size);

#endif
