// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L /* open_memstream */
#include "export/texture_image.h"

#include "program/files.h"
#include "program/memory.h"
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

/* Texels along an axis that show an image as it is. */
static uint32_t find_size(const struct texture *texture, const struct flat_image *image,
                          uint32_t size, size_t axis)
{
    const double most = 4096; /* of images that only placing makes large */
    double scale = texture->is_placed ? fabs(image->scale[axis]) : 1;
    return !(scale > 1) || size >= most ? size : (uint32_t)fmin(size * scale, most);
}

static bool read_parts(struct report *report, const struct texture *texture, struct parts *out)
{
    out->width = out->height = 1;
    for (size_t c = 0; c < 4; ++c) {
        const struct flat_image *image = texture->channels[c].image;
        struct image *texels = &out->images[c];
        if (!image)
            continue;
        if (c && image == texture->channels[c - 1].image)
            *texels = out->images[c - 1];
        else if (!read_image(report, image, texels))
            return false;
        uint32_t width = find_size(texture, image, texels->width, 0),
                 height = find_size(texture, image, texels->height, 1);
        out->width = width > out->width ? width : out->width;
        out->height = height > out->height ? height : out->height;
    }
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

static uint32_t wrap(double index, uint32_t size, enum flat_wrap how)
{
    double period = how == FLAT_MIRROR ? 2.0 * size : size;
    double at = how == FLAT_CLAMP ? fmin(fmax(index, 0), size - 1.0)
                                  : index - period * floor(index / period);
    return (uint32_t)(at < size ? at : period - 1 - at);
}

/* `place` counts in sizes of the image. */
static struct between find_between(double place, uint32_t size, enum flat_wrap how)
{
    double at = place * size - 0.5, first = floor(at);
    return (struct between){{wrap(first, size, how), wrap(first + 1, size, how)},
                            (float)(at - first)};
}

/* The linear number of a channel at a texel of an image that may be larger than its part. */
static float sample(const struct texture *texture, size_t c, const struct parts *parts, uint32_t x,
                    uint32_t y)
{
    const struct flat_image *from = texture->channels[c].image;
    const struct image *image = &parts->images[c];
    double u = (x + 0.5) / parts->width, v = 1 - (y + 0.5) / parts->height;
    if (texture->is_placed) {
        u = u * from->scale[0] + from->offset[0];
        v = v * from->scale[1] + from->offset[1];
    }
    const struct between across = find_between(u, image->width, from->wrap[0]),
                         down = find_between(1 - v, image->height, from->wrap[1]);
    float sum = 0;
    for (size_t i = 0; i < 2; ++i)
        for (size_t k = 0; k < 2; ++k) {
            float weight =
                (i ? across.weight : 1 - across.weight) * (k ? down.weight : 1 - down.weight);
            size_t texel = (size_t)down.at[k] * image->width + across.at[i];
            if (weight > 0)
                sum += weight * linear(from, image, texel, texture->channels[c].component);
        }
    return sum;
}

static float find_value(const struct texture *texture, size_t c, const struct parts *parts,
                        uint32_t x, uint32_t y)
{
    const struct texture_channel *channel = &texture->channels[c];
    float value = channel->image ? sample(texture, c, parts, x, y) : channel->value;
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
                float value = find_value(texture, c, parts, x, y);
                value = fminf(fmaxf(value, 0), 1);
                row[x * channels + c] = texture->is_srgb && c < 3 ? flat_encode_srgb(value) : value;
            }
        good = image_rows_add(rows, 1, row, reason, capacity);
    }
    free(row);
    return good;
}

static bool write_image(const struct texture *texture, const struct parts *parts, FILE *out,
                        char *reason, size_t capacity)
{
    const struct image_format format = {.width = parts->width,
                                        .height = parts->height,
                                        .channels = texture->has_alpha ? 4 : 3,
                                        .depth = 8,
                                        .is_srgb = texture->is_srgb};
    char later[256];
    struct image_rows *rows = image_rows_begin(out, "texture.png", &format, reason, capacity);
    bool good = rows && write_rows(rows, texture, parts, reason, capacity);
    return image_rows_end(rows, good ? reason : later, good ? capacity : sizeof later) && good;
}

/* Makes the bytes of an image; false with the reason. */
static bool encode(const struct texture *texture, const struct parts *parts,
                   struct texture_file *made, char *reason, size_t capacity)
{
    char *data = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&data, &size);
    bool good = out && write_image(texture, parts, out, reason, capacity);
    if ((!out || fclose(out) != 0) && !*reason) {
        snprintf(reason, capacity, "%s", strerror(errno));
        good = false;
    }
    if (!good) {
        free(data);
        return false;
    }
    *made = (struct texture_file){data, size, "png"};
    return true;
}

bool texture_make(struct report *report, const struct texture *texture, struct texture_file *out)
{
    if (copy(texture, out))
        return true;
    struct parts parts = {0};
    char reason[256] = "";
    bool good = read_parts(report, texture, &parts);
    if (good && !encode(texture, &parts, out, reason, sizeof reason)) {
        report_error(report, "output-failed", "cannot make a texture: %s", reason);
        good = false;
    }
    finish_parts(&parts);
    return good;
}

char *texture_key(const struct texture *texture)
{
    char *key = cli_format("%d%d%d%d", texture->is_srgb, texture->has_alpha, texture->is_placed,
                           texture->is_whole);
    for (size_t c = 0; c < 4; ++c) {
        const struct texture_channel *channel = &texture->channels[c];
        const struct flat_image *image = channel->image;
        char *longer =
            cli_format("%s|%s|%d|%u|%d|%g|%g|%g", key, image ? image->path : "",
                       image && image->is_srgb, channel->component, (int)channel->part,
                       (double)channel->value, (double)channel->low, (double)channel->range);
        free(key);
        key = longer;
        if (!texture->is_placed || !image)
            continue;
        longer = cli_format("%s|%g|%g|%g|%g|%d|%d", key, image->scale[0], image->scale[1],
                            image->offset[0], image->offset[1], (int)image->wrap[0],
                            (int)image->wrap[1]);
        free(key);
        key = longer;
    }
    return key;
}
