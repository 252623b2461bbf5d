// SPDX-License-Identifier: Apache-2.0
/*
 * Combines pictures from several files into the array layers of a texture array, or into one
 * picture of squares, with one size and format.
 */
#include "render/image.h"

static float texel(const struct image *image, uint32_t x, uint32_t y, unsigned channel)
{
    return image_channel(image, ((size_t)y * image->width + x) * 4 + channel);
}

/* two adjacent texels of a row or column, and the fraction of the distance to the second */
struct between {
    uint32_t first, second;
    float part;
};

/* is_table: the outer texels stay the outer ones. */
static struct between place(uint32_t at, uint32_t size, uint32_t old_size, bool is_table)
{
    float x = ((float)at + 0.5f) * (float)old_size / (float)size - 0.5f;
    if (is_table)
        x = size > 1 ? (float)at * (float)(old_size - 1) / (float)(size - 1) : 0.0f;
    x = x < 0.0f ? 0.0f : x;
    uint32_t first = (uint32_t)x < old_size ? (uint32_t)x : old_size - 1;
    return (struct between){first, first + 1 < old_size ? first + 1 : first, x - (float)first};
}

static float mix(float a, float b, float part)
{
    return a + (b - a) * part;
}

static float sample(const struct image *image, const struct between *x, const struct between *y,
                    unsigned channel)
{
    return mix(mix(texel(image, x->first, y->first, channel),
                   texel(image, x->second, y->first, channel), x->part),
               mix(texel(image, x->first, y->second, channel),
                   texel(image, x->second, y->second, channel), x->part),
               y->part);
}

/* Writes a picture at layer `layer`, enlarged by linear interpolation. */
static void write_layer(const struct image *part, struct image *out, uint32_t layer,
                        uint32_t height, bool is_table)
{
    size_t at = (size_t)layer * out->width * height * 4;
    for (uint32_t y = 0; y < height; ++y) {
        struct between row = place(y, height, part->height, is_table);
        for (uint32_t x = 0; x < out->width; ++x) {
            struct between column = place(x, out->width, part->width, is_table);
            for (unsigned c = 0; c < 4; ++c, ++at) {
                float value = sample(part, &column, &row, c);
                if (out->is_float)
                    ((float *)out->pixels)[at] = value;
                else
                    ((uint8_t *)out->pixels)[at] = (uint8_t)(value * 255.0f + 0.5f);
            }
        }
    }
}

static void find_size(const struct image *parts, uint32_t count, struct image *out)
{
    for (uint32_t i = 0; i < count; ++i) {
        out->width = parts[i].width > out->width ? parts[i].width : out->width;
        out->height = parts[i].height > out->height ? parts[i].height : out->height;
        out->is_float |= parts[i].is_float;
    }
}

bool image_stack(const struct image *parts, uint32_t count, struct image *out)
{
    *out = (struct image){.layers = count};
    find_size(parts, count, out);
    out->pixels = calloc((size_t)count * out->height,
                         (size_t)out->width * 4 * (out->is_float ? sizeof(float) : 1));
    for (uint32_t i = 0; out->pixels && i < count; ++i)
        write_layer(&parts[i], out, i, out->height, false);
    return out->pixels != NULL;
}

bool image_tables(const struct image *parts, uint32_t count, struct image *out)
{
    *out = (struct image){0};
    find_size(parts, count, out);
    uint32_t side = out->width > out->height ? out->width : out->height;
    out->width = side;
    out->height = side * count;
    out->pixels =
        calloc((size_t)out->height, (size_t)side * 4 * (out->is_float ? sizeof(float) : 1));
    for (uint32_t i = 0; out->pixels && i < count; ++i)
        write_layer(&parts[i], out, count - 1 - i, side, true);
    return out->pixels != NULL;
}
