// SPDX-License-Identifier: Apache-2.0
/* Pictures: read and written by OpenImageIO, which has a C++ interface only (image_oiio.cpp). */
#ifndef MXG_RENDER_IMAGE_H
#define MXG_RENDER_IMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Four channels, rows from the top. Grey is spread over red, green and blue; a missing alpha is 1. */
struct image {
    uint32_t width, height;
    bool is_float; /* float, else uint8_t of a whole */
    void *pixels;  /* malloc; NULL: no image */
};

/* Reads a picture; on failure false, with why in `reason`. Values are those of the file: no colour space is changed. */
bool image_read(const char *path, struct image *out, char *reason, size_t capacity);

/* Whether files of this name hold linear light as floats: EXR, HDR, PFM. */
bool image_is_linear(const char *path);

/*
 * Writes a picture: floats of linear light, premultiplied, or 8-bit sRGB, not premultiplied. The format follows from the name's
 * ending. The file appears whole or not at all.
 */
bool image_write(const char *path, const struct image *image, char *reason, size_t capacity);

static inline void image_finish(struct image *image)
{
    free(image->pixels);
    image->pixels = NULL;
}

/* Levels down to a single texel. */
static inline uint32_t image_num_mips(const struct image *image)
{
    uint32_t mips = 1;
    for (uint32_t size = image->width > image->height ? image->width : image->height; size > 1; size /= 2)
        ++mips;
    return mips;
}

#ifdef __cplusplus
}
#endif
#endif
