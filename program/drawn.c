// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "program/drawn.h"
#include "program/files.h"
#include "program/memory.h"
#include "program/scratch.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define BALL 0.36 /* of the height: its radius, without the edge, which neighbours soften */

/* ---- Difference ---- */

struct picture {
    int width, height;
    const unsigned char *pixels;
};

/* P6, 8 bits, sRGB. */
static bool read_picture(const struct drawn_picture *drawn, struct picture *out)
{
    int most = 0, head = 0;
    const char *ppm = drawn->ppm;
    if (!ppm || sscanf(ppm, "P6 %d %d %d%n", &out->width, &out->height, &most, &head) != 3)
        return false;
    out->pixels = (const unsigned char *)ppm + head + 1;
    return most == 255 && out->width > 0 && out->height > 0
           && drawn->ppm_size >= (size_t)head + 1 + 3 * (size_t)out->width * (size_t)out->height;
}

static void linear_of(const unsigned char *srgb, float out[3])
{
    for (size_t c = 0; c < 3; ++c) {
        double v = srgb[c] / 255.0;
        out[c] = (float)(v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4));
    }
}

/* Below 0: they are no pictures of one size. */
static double difference(const struct drawn_picture *a, const struct drawn_picture *b)
{
    struct picture p, q;
    double sum = 0;
    size_t count = 0;
    if (!read_picture(a, &p) || !read_picture(b, &q) || p.width != q.width || p.height != q.height)
        return -1;
    for (int i = 0; i < p.width * p.height; ++i) {
        float one[3], other[3];
        double x = i % p.width + 0.5 - p.width / 2.0, y = i / p.width + 0.5 - p.height / 2.0;
        if (hypot(x, y) >= BALL * p.height)
            continue;
        linear_of(p.pixels + (size_t)i * 3, one);
        linear_of(q.pixels + (size_t)i * 3, other);
        sum += mxg_color_difference(one, other);
        ++count;
    }
    return count ? sum / (double)count : -1;
}

/* ---- Pictures ---- */

/* So many steps of a budget a picture shows. */
enum { NO_STEPS = 0, ALL_STEPS = -1 };

/* False: the renderer cannot start, dies or fails. */
static bool run(const struct drawn_subject *subject, const char *log, int steps)
{
    struct arg_list args = {0};
    int status = -1;
    args_append(&args, cli_program("mxgen-render"));
    args_append(&args, cli_format("%s", subject->file));
    if (subject->element)
        args_append(&args, cli_format("--element=%s", subject->element));
    args_append(&args, cli_format("--output=%s/picture.png", subject->folder));
    args_append(&args, cli_format("--copy=%s/picture.ppm", subject->folder));
    args_append(&args, cli_format("--missing-texture=checker"));
    for (const char *const *option = subject->look; *option; ++option)
        args_append(&args, cli_format("%s", *option));
    if (steps == NO_STEPS)
        cli_forward_full(subject->cli, &args);
    else
        cli_forward(subject->cli, &args);
    if (steps != ALL_STEPS)
        args_append(&args, cli_format("--max-steps=%d", steps));
    args_append(&args, NULL);
    bool is_started = !cli_run_logged((char *const *)(uintptr_t)args.items, log, &status);
    args_free(&args);
    return is_started && status == 0;
}

static char *take_file(const struct drawn_subject *subject, const char *name, size_t *out_size)
{
    char *path = cli_format("%s/%s", subject->folder, name), *data = files_read(path, out_size);
    unlink(path);
    free(path);
    return data;
}

static void drop(struct drawn_picture *picture)
{
    free(picture->png);
    free(picture->ppm);
    free(picture->log);
    *picture = (struct drawn_picture){0};
}

static struct drawn_picture draw(const struct drawn_subject *subject, int steps)
{
    struct drawn_picture out = {0};
    char *log = cli_format("%s/log", subject->folder);
    if (subject->begin)
        subject->begin(subject->user_data);
    bool good = run(subject, log, steps);
    out.png = take_file(subject, "picture.png", &out.png_size);
    out.ppm = take_file(subject, "picture.ppm", &out.ppm_size);
    out.log = take_file(subject, "log", &(size_t){0});
    if (!good || !out.png || !out.ppm) {
        free(out.png);
        free(out.ppm);
        out.png = out.ppm = NULL;
    }
    free(log);
    return out;
}

static bool fail(struct drawn_comparison *comparison, const struct drawn_picture *picture)
{
    const char *log = picture->log && *picture->log ? picture->log : NULL;
    if (!comparison->fault)
        comparison->fault =
            log ? cli_copy(log, strcspn(log, "\n"))
                : cli_format("mxgen-render left no message: it could not be started, died, or had "
                             "no room in '%s'",
                             scratch_root());
    return false;
}

bool drawn_begin(const struct drawn_subject *subject, struct drawn_comparison *out)
{
    *out = (struct drawn_comparison){.error = -1};
    out->cheapest = draw(subject, ALL_STEPS);
    return out->cheapest.ppm || fail(out, &out->cheapest);
}

bool drawn_compare(const struct drawn_subject *subject, size_t num_steps,
                   struct drawn_comparison *comparison)
{
    comparison->full = draw(subject, NO_STEPS);
    comparison->error = difference(&comparison->full, &comparison->cheapest);
    if (comparison->error < 0)
        return fail(comparison, &comparison->full);
    comparison->num_steps = num_steps;
    comparison->errors = memory_alloc((num_steps + 1) * sizeof *comparison->errors);
    for (size_t i = 0; i + 1 < num_steps; ++i) {
        struct drawn_picture cheaper = draw(subject, (int)i + 1);
        comparison->errors[i] = difference(&comparison->full, &cheaper);
        if (comparison->errors[i] < 0)
            fail(comparison, &cheaper);
        drop(&cheaper);
    }
    if (num_steps)
        comparison->errors[num_steps - 1] = comparison->error;
    return !comparison->fault;
}

double drawn_difference(const struct drawn_subject *one, const struct drawn_subject *other,
                        char **out_fault)
{
    struct drawn_comparison pair = {.full = draw(one, NO_STEPS)};
    if (pair.full.ppm)
        pair.cheapest = draw(other, NO_STEPS);
    double error = difference(&pair.full, &pair.cheapest);
    if (error < 0)
        fail(&pair, pair.full.ppm ? &pair.cheapest : &pair.full);
    *out_fault = pair.fault;
    pair.fault = NULL;
    drawn_finish(&pair);
    return error;
}

void drawn_finish(struct drawn_comparison *comparison)
{
    drop(&comparison->full);
    drop(&comparison->cheapest);
    free(comparison->errors);
    free(comparison->fault);
    *comparison = (struct drawn_comparison){0};
}
