// SPDX-License-Identifier: Apache-2.0
#include "render/dilate.h"

#include "program/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FAR UINT32_MAX

void dilation_begin(struct dilation *dilation, const struct spool *spool, uint32_t padding)
{
    size_t texels = (size_t)spool->width * (DILATION_BAND + 2 * (size_t)padding);
    bool is_full = spool->count == (uint64_t)spool->width * spool->height;
    *dilation = (struct dilation){.spool = spool, .padding = is_full ? 0 : padding};
    if (is_full)
        return;
    dilation->rows = memory_alloc(texels * spool->channels * sizeof *dilation->rows);
    dilation->above = memory_alloc(texels * sizeof *dilation->above);
}

void dilation_end(struct dilation *dilation)
{
    free(dilation->rows);
    free(dilation->above);
}

static bool is_empty(const struct dilation *dilation, size_t texel)
{
    return isnan(dilation->rows[texel * dilation->spool->channels]);
}

/* The distance in rows to the nearest texel with a value in the same column. */
static void measure(struct dilation *dilation, uint32_t height)
{
    uint32_t width = dilation->spool->width;
    for (size_t at = 0; at < (size_t)width * height; ++at) {
        uint32_t before = at < width ? FAR : dilation->above[at - width];
        dilation->above[at] = !is_empty(dilation, at) ? 0 : before == FAR ? FAR : before + 1;
    }
    for (size_t at = (size_t)width * (height - 1); at-- > 0;) {
        uint32_t below = dilation->above[at + width];
        if (below != FAR && below + 1 < dilation->above[at])
            dilation->above[at] = below + 1;
    }
}

/* The nearest texel with a value within the padding; FAR: there is none. */
static size_t nearest(const struct dilation *dilation, uint32_t x, uint32_t y, uint32_t height)
{
    uint32_t width = dilation->spool->width, reach = dilation->padding;
    uint64_t best = (uint64_t)reach * reach + 1;
    size_t found = FAR;
    uint32_t first = x > reach ? x - reach : 0, last = x + reach < width ? x + reach : width - 1;
    for (uint32_t k = first; k <= last; ++k) {
        uint64_t dx = k > x ? k - x : x - k, dy = dilation->above[(size_t)y * width + k];
        if (dy == FAR || dx * dx + dy * dy >= best)
            continue;
        bool is_up = dy <= y && !is_empty(dilation, (size_t)(y - dy) * width + k);
        uint64_t row = is_up ? y - dy : y + dy;
        if (row >= height)
            continue;
        best = dx * dx + dy * dy;
        found = (size_t)row * width + k;
    }
    return found;
}

static void fill(const struct dilation *dilation, uint32_t x, uint32_t y, uint32_t height,
                 float *out)
{
    const struct spool *spool = dilation->spool;
    size_t at = (size_t)y * spool->width + x;
    size_t from = is_empty(dilation, at) ? nearest(dilation, x, y, height) : at;
    for (uint32_t c = 0; c < spool->channels; ++c)
        out[c] = from != FAR    ? dilation->rows[from * spool->channels + c]
                 : spool->count ? (float)(spool->sum[c] / (double)spool->count)
                                : 0.0f;
}

const char *dilation_read(struct dilation *dilation, uint32_t row, uint32_t count, float *out)
{
    const struct spool *spool = dilation->spool;
    if (!dilation->rows)
        return spool_read(spool, row, count, out);
    uint32_t first = row > dilation->padding ? row - dilation->padding : 0,
             end = row + count + dilation->padding;
    uint32_t height = (end < spool->height ? end : spool->height) - first;
    const char *reason = spool_read(spool, first, height, dilation->rows);
    if (reason)
        return reason;
    measure(dilation, height);
    for (uint32_t y = row - first; y < row - first + count; ++y)
        for (uint32_t x = 0; x < spool->width; ++x, out += spool->channels)
            fill(dilation, x, y, height, out);
    return NULL;
}
