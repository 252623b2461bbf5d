// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "render/texel_spool.h"

#include "program/files.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

const char *spool_open(struct spool *spool, const char *folder, uint32_t width, uint32_t height,
                       uint32_t channels)
{
    *spool = (struct spool){.width = width, .height = height, .channels = channels};
    for (size_t c = 0; c < 4; ++c) {
        spool->low[c] = INFINITY;
        spool->high[c] = -INFINITY;
    }
    spool->file = files_open_unnamed(folder);
    return spool->file < 0 ? strerror(errno) : NULL;
}

void spool_close(struct spool *spool)
{
    if (spool->channels && spool->file >= 0)
        close(spool->file);
    *spool = (struct spool){0};
}

static off_t place(const struct spool *spool, uint32_t x, uint32_t y)
{
    return (off_t)sizeof(float) * (off_t)spool->channels
           * ((off_t)y * (off_t)spool->width + (off_t)x);
}

static void measure(struct spool *spool, uint32_t count, const float *texels)
{
    for (uint32_t i = 0; i < count; ++i, texels += spool->channels) {
        if (isnan(texels[0]))
            continue;
        ++spool->count;
        for (uint32_t c = 0; c < spool->channels; ++c) {
            spool->sum[c] += (double)texels[c];
            spool->low[c] = fminf(spool->low[c], texels[c]);
            spool->high[c] = fmaxf(spool->high[c], texels[c]);
        }
    }
}

const char *spool_put(struct spool *spool, uint32_t x, uint32_t y, uint32_t count,
                      const float *texels)
{
    const char *from = (const char *)texels;
    size_t left = (size_t)count * spool->channels * sizeof *texels;
    off_t at = place(spool, x, y);
    measure(spool, count, texels);
    while (left) {
        ssize_t done = pwrite(spool->file, from, left, at);
        if (done < 0 && errno == EINTR)
            continue;
        if (done <= 0)
            return strerror(done ? errno : ENOSPC);
        left -= (size_t)done;
        from += done;
        at += done;
    }
    return NULL;
}

const char *spool_read(const struct spool *spool, uint32_t row, uint32_t count, float *out)
{
    char *to = (char *)out;
    size_t left = (size_t)count * spool->width * spool->channels * sizeof *out;
    off_t at = place(spool, 0, row);
    while (left) {
        ssize_t done = pread(spool->file, to, left, at);
        if (done < 0 && errno == EINTR)
            continue;
        if (done <= 0)
            return strerror(done ? errno : EIO);
        left -= (size_t)done;
        to += done;
        at += done;
    }
    return NULL;
}
