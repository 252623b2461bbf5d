// SPDX-License-Identifier: Apache-2.0
/* The benchmarks that draw share these functions. */
#ifndef MXG_BENCH_FRAME_TIME_H
#define MXG_BENCH_FRAME_TIME_H

#include "render/draw.h"
#include "render/scene.h"

enum { BENCH_COPIES = 4 };

/* Prints a line to stderr, and ends the program with 1. */
_Noreturn void bench_fail(const char *format, ...);

/* Processor time of this program, in seconds: other programs do not count. */
double bench_seconds(void);

/*
 * Draws a frame; returns its seconds: of a processor, those of this program; of another device,
 * those of its own clock, without the copy of the picture. Fails with what the device says.
 */
double bench_frame(struct draw_canvas *canvas, struct draw_program *const *programs, size_t count,
                   float *out_pixels);

struct bench_quartiles {
    double lower, median, upper;
};
/* Sorts the numbers. */
struct bench_quartiles bench_quartiles(double *numbers, size_t count);

/* Copies of the ball, one around the other, the innermost first: the whole picture is overdrawn. */
void bench_place_copies(const struct scene *scene, struct scene_object copies[BENCH_COPIES]);

#endif
