// SPDX-License-Identifier: Apache-2.0
/* What the benchmarks that draw share. */
#include "bench/drawn.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

void bench_fail(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vfprintf(stderr, format, args);
    va_end(args);
    fputc('\n', stderr);
    exit(1);
}

void bench_place_copies(const struct scene *scene, struct scene_object copies[BENCH_COPIES])
{
    static const double scales[BENCH_COPIES] = {0.94, 0.96, 0.98, 1.0};
    for (int i = 0; i < BENCH_COPIES; ++i) {
        copies[i] = scene->object;
        copies[i].world =
            matrix_multiply(scene->object.world, matrix_scale(scales[i], scales[i], scales[i]));
    }
}
