// SPDX-License-Identifier: Apache-2.0
/* The benchmarks that draw share these functions. */
#define _POSIX_C_SOURCE 200809L
#include "bench/frame_time.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

void bench_fail(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vfprintf(stderr, format, args);
    va_end(args);
    fputc('\n', stderr);
    exit(1);
}

double bench_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double bench_frame(struct draw_canvas *canvas, struct draw_program *const *programs, size_t count,
                   float *out_pixels)
{
    struct gpu *gpu = draw_gpu(canvas);
    double begin = bench_seconds(), seconds = 0;
    if (!draw_frame(canvas, programs, count, out_pixels))
        bench_fail("a frame fails: %s", gpu->reason);
    if (gpu_is_processor(gpu))
        return bench_seconds() - begin;
    if (!draw_frame_seconds(canvas, &seconds))
        bench_fail("the device has no clock");
    return seconds;
}

static int compare_numbers(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

struct bench_quartiles bench_quartiles(double *numbers, size_t count)
{
    qsort(numbers, count, sizeof *numbers, compare_numbers);
    return (struct bench_quartiles){numbers[count / 4], numbers[count / 2],
                                    numbers[count - 1 - count / 4]};
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
