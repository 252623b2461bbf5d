// SPDX-License-Identifier: Apache-2.0
/* Image files of a format, whose channels come from images of a flat document. */
#ifndef MXG_EXPORT_TEXTURE_IMAGE_H
#define MXG_EXPORT_TEXTURE_IMAGE_H

#include "export/flat.h"

/* A channel holds the number of the image, or a part of a direction in place of its angle. */
enum texture_part { TEXTURE_VALUE, TEXTURE_COSINE, TEXTURE_SINE };

struct texture_channel {
    const struct flat_image *image; /* NULL: it is `value` */
    unsigned component;             /* of the image */
    enum texture_part part;
    float value;
    float low;   /* the number that becomes 0 */
    float range; /* from there to the number that becomes 1 */
};

struct texture {
    struct texture_channel channels[4]; /* red, green, blue, alpha */
    bool has_alpha;
    bool is_placed; /* its parts lie where their images say; else the format says it for all */
    bool is_srgb;   /* red, green and blue are encoded */
    bool is_whole;  /* an image gives all channels as they are, so its file may be copied */
};

/* Bytes of a file, which `ending` names: "png" or "jpg". */
struct texture_file {
    void *data;
    size_t size;
    const char *ending;
};

/* The numbers of an image, linear. false after reporting an error. */
bool texture_find_range(struct report *report, const struct flat_image *image, float *out_low,
                        float *out_high);
/*
 * Makes an image of 8 bits, as large as the largest of its parts, or copies its file. false after
 * reporting an error. The caller frees the data.
 */
bool texture_make(struct report *report, const struct texture *texture, struct texture_file *out);
/* Returns a text that is equal for equal textures. The caller frees it. */
char *texture_key(const struct texture *texture);

#endif
