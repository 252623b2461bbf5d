// SPDX-License-Identifier: Apache-2.0
/* The size of a picture from the begin of its file: PNG, JPEG, OpenEXR, Radiance. */
#ifndef MXG_LSP_IMAGE_HEADER_H
#define MXG_LSP_IMAGE_HEADER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* How much of a file is enough for most. */
enum { IMAGE_HEADER_SIZE = 64 << 10 };

struct image_header {
    const char *format;
    uint32_t width, height;
};

/* False: it is no such file, or its header is longer. The bytes have a NUL after them. */
bool image_header_read(const char *bytes, size_t size, struct image_header *out);

#endif
