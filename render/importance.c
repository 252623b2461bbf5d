// SPDX-License-Identifier: Apache-2.0
#include "render/importance.h"

#include <math.h>

#define PI 3.14159265358979323846
#define FLOOR 0.02 /* of the mean: what is dark is drawn at times, too */

/* Light of the texel as a number; rows end at the poles, and go round. */
static double brightness(const struct image *map, int64_t x, int64_t y)
{
    y = y < 0 ? 0 : y >= map->height ? map->height - 1 : y;
    x = (x + map->width) % map->width;
    const float *texel = (const float *)map->pixels + (y * map->width + x) * 4;
    double sum = (double)texel[0] + (double)texel[1] + (double)texel[2];
    return sum > 0 && isfinite(sum) ? sum : 0;
}

static double around(const struct image *map, int64_t x, int64_t y)
{
    double sum = 0;
    for (int64_t j = -1; j <= 1; ++j)
        for (int64_t i = -1; i <= 1; ++i)
            sum += brightness(map, x + i, y + j) / 9;
    return sum;
}

/*
 * Into sums from 0 to 1, of which the first is 0; even steps where there is nothing. Returns what
 * the last was.
 */
static double accumulate(float *sums, const double *shares, uint32_t count)
{
    double total = 0, sum = 0;
    for (uint32_t i = 0; i < count; ++i)
        total += shares[i];
    for (uint32_t i = 0; i < count; ++i) {
        sums[i] = (float)(total > 0 ? sum / total : (double)i / count);
        sum += shares[i];
    }
    sums[count] = 1;
    return total;
}

float *importance_of_map(const struct image *map, size_t *out_count)
{
    uint32_t width = map->width, height = map->height;
    *out_count = height + 1 + (size_t)height * (width + 1);
    float *sums = malloc(*out_count * sizeof *sums);
    double *rows = malloc(height * sizeof *rows), *texels = malloc(width * sizeof *texels),
           mean = 0;
    bool good = sums && rows && texels;
    for (uint32_t y = 0; good && y < height; ++y)
        for (uint32_t x = 0; x < width; ++x)
            mean += brightness(map, x, y) / ((double)width * height);
    for (uint32_t y = 0; good && y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x)
            texels[x] = around(map, x, y) + FLOOR * mean;
        rows[y] = accumulate(sums + height + 1 + (size_t)y * (width + 1), texels, width)
                  * sin(PI * (y + 0.5) / height);
    }
    if (good)
        accumulate(sums, rows, height);
    else
        free(sums);
    free(rows);
    free(texels);
    return good ? sums : NULL;
}
