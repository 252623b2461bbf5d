// SPDX-License-Identifier: Apache-2.0
/*
 * Pictures of one element by mxgen-render, full and with a budget of slabs, and how much they
 * differ.
 */
#ifndef MXG_PROGRAM_DRAWN_H
#define MXG_PROGRAM_DRAWN_H

#include "program/cli.h"

struct drawn_subject {
    struct cli *cli;
    const char *file, *element;     /* element NULL: the first one */
    const char *const *look;        /* options of the renderer, which NULL ends */
    const char *folder;             /* for files that do not outlive a picture */
    void (*begin)(void *user_data); /* before each picture; NULL: nothing is to do */
    void *user_data;
};

/* A picture that the renderer made; PNG and PPM are NULL after a failure. */
struct drawn_picture {
    char *png, *ppm, *log; /* log: what it wrote; NULL: it could not start */
    size_t png_size, ppm_size;
};

struct drawn_comparison {
    struct drawn_picture full, cheapest; /* without the budget; after all its steps */
    size_t num_steps;
    double *errors; /* by step; below 0: a picture failed */
    double error;   /* of all steps; below 0: a picture failed */
    char *fault;    /* why the first picture failed that did; NULL: none did */
};

/* Draws the element with the whole budget. False: `fault` has the reason. */
bool drawn_begin(const struct drawn_subject *subject, struct drawn_comparison *out);
/*
 * After drawn_begin: draws the element full and after each step of the budget. An error is the mean
 * CIEDE2000 over a ball that fills the middle. False: a picture failed, and `fault` has the reason.
 */
bool drawn_compare(const struct drawn_subject *subject, size_t num_steps,
                   struct drawn_comparison *comparison);
/*
 * How far two subjects look from each other: the mean CIEDE2000 over the ball, without budgets.
 * Below 0: *out_fault has the reason, which the caller frees.
 */
double drawn_difference(const struct drawn_subject *one, const struct drawn_subject *other,
                        char **out_fault);

void drawn_finish(struct drawn_comparison *comparison);

#endif
