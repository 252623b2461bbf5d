// SPDX-License-Identifier: Apache-2.0
#include "export/texture.h"

#include "program/files.h"
#include "program/memory.h"
#include "program/temporary.h"
#include "render/image.h"
#include "render/image_rows.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Images of the document ---- */

static bool read_image(struct report *report, const struct flat_image *image, struct image *out)
{
    char reason[256];
    if (image_read(image->path, "", out, reason, sizeof reason))
        return true;
    report_error(report, "missing-texture", "cannot read '%s': %s", image->path, reason);
    return false;
}

static float linear(const struct flat_image *from, const struct image *image, size_t texel,
                    unsigned component)
{
    float value = image_channel(image, texel * 4 + component);
    return from->is_srgb && component < 3 ? flat_decode_srgb(value) : value;
}

bool texture_find_range(struct report *report, const struct flat_image *image, float *out_low,
                        float *out_high)
{
    struct image texels;
    if (!read_image(report, image, &texels))
        return false;
    *out_low = INFINITY;
    *out_high = -INFINITY;
    for (size_t i = 0; i < (size_t)texels.width * texels.height; ++i)
        for (unsigned c = 0; c < image->components; ++c) {
            float value = linear(image, &texels, i, c);
            *out_low = fminf(*out_low, value);
            *out_high = fmaxf(*out_high, value);
        }
    image_finish(&texels);
    return true;
}

/* ---- Whole files ---- */

/* The ending that the first bytes of a file tell; NULL: another format. */
static const char *ending_of(const char *data, size_t size)
{
    static const struct {
        const char *ending, *start;
    } formats[] = {{"png", "\x89PNG\r\n\x1a\n"}, {"jpg", "\xff\xd8\xff"}};
    for (size_t i = 0; i < sizeof formats / sizeof *formats; ++i) {
        size_t len = strlen(formats[i].start);
        if (size > len && memcmp(data, formats[i].start, len) == 0)
            return formats[i].ending;
    }
    return NULL;
}

/* True if the file is taken as it is. */
static bool copy(const struct texture *texture, struct texture_file *out)
{
    const struct flat_image *image = texture->channels[0].image;
    if (!texture->is_whole || image->is_srgb != texture->is_srgb)
        return false;
    char *data = files_read(image->path, &out->size);
    out->ending = data ? ending_of(data, out->size) : NULL;
    out->data = data;
    if (!out->ending)
        free(data);
    return out->ending != NULL;
}

/* ---- Images of several parts ---- */

struct parts {
    struct image images[4]; /* of the channels; no pixels: none */
    uint32_t width, height;
};

static bool read_parts(struct report *report, const struct texture *texture, struct parts *out)
{
    for (size_t c = 0; c < 4; ++c) {
        const struct flat_image *image = texture->channels[c].image;
        struct image *texels = &out->images[c];
        if (c && image && image == texture->channels[c - 1].image)
            *texels = out->images[c - 1];
        else if (image && !read_image(report, image, texels))
            return false;
        out->width = image && texels->width > out->width ? texels->width : out->width;
        out->height = image && texels->height > out->height ? texels->height : out->height;
    }
    out->width = out->width ? out->width : 1;
    out->height = out->height ? out->height : 1;
    return true;
}

static void finish_parts(struct parts *parts)
{
    for (size_t c = 4; c-- > 0;)
        if (!c || parts->images[c].pixels != parts->images[c - 1].pixels)
            image_finish(&parts->images[c]);
}

/* A place between texels: their indices, and the weight of the second. */
struct between {
    uint32_t at[2];
    float weight;
};

static struct between find_between(uint32_t index, uint32_t size, uint32_t of)
{
    float place = fmaxf(((float)index + 0.5f) * (float)of / (float)size - 0.5f, 0);
    uint32_t first = (uint32_t)place, last = of - 1;
    return (struct between){{first < last ? first : last, first < last ? first + 1 : last},
                            place - (float)first};
}

/* The linear number of a channel at a texel of an image that may be larger than its part. */
static float sample(const struct texture_channel *channel, const struct image *image,
                    const struct parts *parts, uint32_t x, uint32_t y)
{
    const struct between across = find_between(x, parts->width, image->width),
                         down = find_between(y, parts->height, image->height);
    float sum = 0;
    for (size_t i = 0; i < 2; ++i)
        for (size_t k = 0; k < 2; ++k) {
            float weight =
                (i ? across.weight : 1 - across.weight) * (k ? down.weight : 1 - down.weight);
            size_t texel = (size_t)down.at[k] * image->width + across.at[i];
            if (weight > 0)
                sum += weight * linear(channel->image, image, texel, channel->component);
        }
    return sum;
}

static float find_value(const struct texture_channel *channel, const struct image *image,
                        const struct parts *parts, uint32_t x, uint32_t y)
{
    float value = channel->image ? sample(channel, image, parts, x, y) : channel->value;
    return channel->part == TEXTURE_COSINE ? cosf(value) * 0.5f + 0.5f
           : channel->part == TEXTURE_SINE ? sinf(value) * 0.5f + 0.5f
                                           : (value - channel->low) / channel->range;
}

static bool write_rows(struct image_rows *rows, const struct texture *texture,
                       const struct parts *parts, char *reason, size_t capacity)
{
    const size_t channels = texture->has_alpha ? 4 : 3;
    float *row = memory_alloc(parts->width * channels * sizeof *row);
    bool good = true;
    for (uint32_t y = 0; good && y < parts->height; ++y) {
        for (uint32_t x = 0; x < parts->width; ++x)
            for (size_t c = 0; c < channels; ++c) {
                float value = find_value(&texture->channels[c], &parts->images[c], parts, x, y);
                value = fminf(fmaxf(value, 0), 1);
                row[x * channels + c] = texture->is_srgb && c < 3 ? flat_encode_srgb(value) : value;
            }
        good = image_rows_add(rows, 1, row, reason, capacity);
    }
    free(row);
    return good;
}

/* Writes the image to a file. */
static bool write_image(const struct texture *texture, const struct parts *parts, const char *path,
                        char *reason, size_t capacity)
{
    const struct image_format format = {.width = parts->width,
                                        .height = parts->height,
                                        .channels = texture->has_alpha ? 4 : 3,
                                        .depth = 8,
                                        .is_srgb = texture->is_srgb};
    char later[256];
    struct image_rows *rows = image_rows_begin(path, &format, reason, capacity);
    bool good = rows && write_rows(rows, texture, parts, reason, capacity);
    return image_rows_end(rows, good ? reason : later, good ? capacity : sizeof later) && good;
}

bool texture_make(struct report *report, const struct texture *texture, const char *folder,
                  struct texture_file *out)
{
    if (copy(texture, out))
        return true;
    struct parts parts = {0};
    char reason[256] = "", *stem = cli_format("%s/texture", folder),
         *path = temporary_name(stem, ".png");
    free(stem);
    if (!path)
        memory_fail();
    temporary_note(path);
    bool good = read_parts(report, texture, &parts);
    if (good) {
        out->ending = "png";
        good = write_image(texture, &parts, path, reason, sizeof reason);
        out->data = good ? files_read(path, &out->size) : NULL;
        if (!out->data)
            report_error(report, "output-failed", "cannot write '%s': %s", path,
                         good ? strerror(errno) : reason);
    }
    remove(path);
    temporary_forget(path);
    free(path);
    finish_parts(&parts);
    return good && out->data;
}

char *texture_key(const struct texture *texture)
{
    char *key = cli_format("%d%d%d", texture->is_srgb, texture->has_alpha, texture->is_whole);
    for (size_t c = 0; c < 4; ++c) {
        const struct texture_channel *channel = &texture->channels[c];
        const struct flat_image *image = channel->image;
        char *longer =
            cli_format("%s|%s|%d|%u|%d|%g|%g|%g", key, image ? image->path : "",
                       image && image->is_srgb, channel->component, (int)channel->part,
                       (double)channel->value, (double)channel->low, (double)channel->range);
        free(key);
        key = longer;
    }
    return key;
}
