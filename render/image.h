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

/*
 * Four channels, rows from the top. Grey is spread over red, green and blue; a missing alpha is 1.
 */
struct image {
    uint32_t width, height;
    bool is_float; /* float, else uint8_t of a whole */
    void *pixels;  /* malloc; NULL: no image */
    /*
     * that many pictures of this size, one after another, for a texture array; 0: one, for a plain
     * texture
     */
    uint32_t layers;
    /*
     * that stand behind each other, each half the size of the one before, of a plain texture; 0:
     * one
     */
    uint32_t levels;
};

/*
 * Reads a picture; on failure false, with why in `reason`. Values are those of the file: no colour
 * space is changed. `layer` names a part of a file that has several, or the channels that have it
 * as prefix ("diffuse.R"); "" is the first.
 */
bool image_read(const char *path, const char *layer, struct image *out, char *reason,
                size_t capacity);
/* The first part with the mip levels that the file has. */
bool image_read_levels(const char *path, struct image *out, char *reason, size_t capacity);

/*
 * layers.c: the pictures as layers of one, each at the size of the largest. False: there is no
 * memory.
 */
bool image_stack(const struct image *parts, uint32_t count, struct image *out);

/* Whether files of this name hold linear light as floats: EXR, HDR. */
bool image_is_linear(const char *path);

/*
 * Whether a picture could be written, before it is drawn: its format is known, its folder is there.
 * False: `reason` says why not.
 */
bool image_can_write(const char *path, char *reason, size_t capacity);

/*
 * Writes a picture, with its levels (EXR alone has them): floats of linear light, premultiplied, or
 * 8-bit sRGB, not premultiplied. The format follows from the name's ending. The file appears whole
 * or not at all.
 */
bool image_write(const char *path, const struct image *image, char *reason, size_t capacity);

static inline void image_finish(struct image *image)
{
    free(image->pixels);
    image->pixels = NULL;
}

static inline uint32_t image_level_size(uint32_t size, uint32_t level)
{
    return size >> level ? size >> level : 1;
}

/* Its own levels, or those down to a single texel. */
static inline uint32_t image_num_mips(const struct image *image)
{
    if (image->levels)
        return image->levels;
    uint32_t mips = 1;
    for (uint32_t size = image->width > image->height ? image->width : image->height; size > 1;
         size /= 2)
        ++mips;
    return mips;
}

#ifdef __cplusplus
}
#endif
#endif
