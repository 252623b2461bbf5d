// SPDX-License-Identifier: Apache-2.0
/* The options of `mxgen bake`, which the program mxgen-render reads. */
#ifndef MXG_PROGRAM_BAKE_OPTIONS_H
#define MXG_PROGRAM_BAKE_OPTIONS_H

#include "program/cli.h"

struct bake_options {
    const char *output, *element, *mesh, *format, *missing_texture;
    size_t size, samples, depth, padding, frame; /* size and depth 0: by content */
    bool copy;
};

#define BAKE_OPTIONS_DEFAULTS \
    { \
        .missing_texture = "error", .samples = 1, .padding = 16, .frame = 33 \
    }

enum { MAX_BAKE_ARGS = 12, BAKE_MIN_SIZE = 2, BAKE_MAX_SIZE = 16384 };

/* Fills the table of options, which refers to the values; returns the number of options. */
size_t bake_args(struct bake_options *options, struct arg args[MAX_BAKE_ARGS]);

#endif
