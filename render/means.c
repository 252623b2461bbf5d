// SPDX-License-Identifier: Apache-2.0
/* mxgen-render --texels FILE LAYER SIZE: the means of an image's parts, for program/texel_reader.c.
 */
#include "render/means.h"
#include "render/image.h"

#include <stdio.h>

/* The first texel of part `at`; small images have texels that are in several parts. */
static uint32_t begin_of(uint32_t at, uint32_t size, uint32_t texels)
{
    return (uint32_t)((uint64_t)at * texels / size);
}

static uint32_t end_of(uint32_t at, uint32_t size, uint32_t texels)
{
    return (uint32_t)(((uint64_t)(at + 1) * texels + size - 1) / size);
}

static void mean_of(const struct image *image, uint32_t column, uint32_t row, uint32_t size,
                    float out[4])
{
    double sum[4] = {0};
    uint32_t left = begin_of(column, size, image->width),
             right = end_of(column, size, image->width), top = begin_of(row, size, image->height),
             bottom = end_of(row, size, image->height);
    for (uint32_t y = top; y < bottom; ++y)
        for (uint32_t x = left; x < right; ++x)
            for (size_t c = 0; c < 4; ++c)
                sum[c] += (double)image_channel(image, ((size_t)y * image->width + x) * 4 + c);
    for (size_t c = 0; c < 4; ++c)
        out[c] = (float)(sum[c] / ((double)(right - left) * (double)(bottom - top)));
}

int means_print(const char *file, const char *layer, uint32_t size)
{
    struct image image = {0};
    char reason[256];
    if (!image_read(file, layer, &image, reason, sizeof reason)) {
        fprintf(stderr, "%s: %s\n", file, reason);
        return EXIT_FAILURE;
    }
    for (uint32_t row = 0; row < size; ++row)
        for (uint32_t column = 0; column < size; ++column) {
            float mean[4];
            mean_of(&image, column, row, size, mean);
            fwrite(mean, sizeof mean, 1, stdout);
        }
    image_finish(&image);
    return fflush(stdout) ? EXIT_FAILURE : EXIT_SUCCESS;
}
