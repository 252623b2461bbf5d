// SPDX-License-Identifier: Apache-2.0
/*
 * Images in memory. OpenImageIO, which has only a C++ interface, reads and writes them
 * (image_oiio.cpp).
 */
#ifndef MXG_RENDER_IMAGE_H
#define MXG_RENDER_IMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A further channel of a picture, which only EXR files have: one float per pixel. */
struct image_plane {
    const char *name;    /* "albedo.R" */
    const float *values; /* each `stride` floats behind the one before */
    size_t stride;
};

/* Four channels, rows from the top. Grey fills red, green and blue; a missing alpha is 1. */
struct image {
    uint32_t width, height;
    bool is_float; /* float, otherwise uint8_t */
    void *pixels;  /* malloc; NULL: no image */
    /* of a float picture: how much it shows of what lies behind, RGB; NULL: 1 - alpha; malloc */
    float *through;
    /* number of consecutive array layers of this size; 0: one, not an array */
    uint32_t layers;
    /*
     * number of consecutive mip levels, each half the size of the one before, of an image that is
     * not an array; 0: one
     */
    uint32_t levels;
    /*
     * number of texels with components that were NaN or infinite, for an environment also 1e9 or
     * more; the reader replaced these components by 0
     */
    uint64_t num_bad;
    const struct image_plane *planes; /* of a float picture without levels */
    uint32_t num_planes;
};

/*
 * Reads an image file of at most 65,536 pixels on a side and 268,435,456 in total. On failure
 * returns false and the reason. Does not convert colour spaces.
 * `layer` names a part of a file, or the channels with this prefix ("diffuse.R"); "" is the first
 * part.
 */
bool image_read(const char *path, const char *layer, struct image *out, char *reason,
                size_t capacity);
/* Reads the first part with its mip levels. */
bool image_read_levels(const char *path, struct image *out, char *reason, size_t capacity);

/* The larger side of a file's first part. On failure returns false and the reason. */
bool image_find_size(const char *path, uint32_t *out, char *reason, size_t capacity);

/* array_layers.c: combines images as array layers of the largest size. false: out of memory. */
bool image_stack(const struct image *parts, uint32_t count, struct image *out);
/*
 * Combines tables, whose outer texels are the ends of their ranges, as squares of the largest size
 * in one image, the first at the bottom. false: out of memory.
 */
bool image_tables(const struct image *parts, uint32_t count, struct image *out);

/* True if files of this name contain linear light as floats: EXR, HDR. */
bool image_is_linear(const char *path);

/*
 * Checks before rendering that a picture can be written: its format is supported, its folder
 * exists. On failure returns the reason.
 */
bool image_can_write(const char *path, char *reason, size_t capacity);

/*
 * Writes a picture, with its levels (EXR only): floats of linear light, premultiplied, or 8-bit
 * sRGB, not premultiplied. The ending of the name selects the format. Writes the file completely or
 * not at all.
 */
bool image_write(const char *path, const struct image *image, char *reason, size_t capacity);

static inline void image_finish(struct image *image)
{
    free(image->pixels);
    free(image->through);
    image->pixels = NULL;
    image->through = NULL;
}

/* The channel `at` of all channels of the first layer or level. */
static inline float image_channel(const struct image *image, size_t at)
{
    return image->is_float ? ((const float *)image->pixels)[at]
                           : (float)((const uint8_t *)image->pixels)[at] / 255.0f;
}

static inline uint32_t image_level_size(uint32_t size, uint32_t level)
{
    return size >> level ? size >> level : 1;
}

/* Its own levels, or the number of levels down to one texel. */
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
