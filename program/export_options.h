// SPDX-License-Identifier: Apache-2.0
/* The options of `mxgen export`, which the program mxgen-render reads. */
#ifndef MXG_PROGRAM_EXPORT_OPTIONS_H
#define MXG_PROGRAM_EXPORT_OPTIONS_H

#include "program/bake_options.h"

struct export_options {
    const char *output, *stage, *look;
    struct bake_options bake; /* how what varies is drawn */
};

#define EXPORT_OPTIONS_DEFAULTS \
    { \
        .bake = BAKE_OPTIONS_DEFAULTS \
    }

enum { MAX_EXPORT_ARGS = 10 };

/* Fills the table of options, which refers to the values; returns the number of options. */
size_t export_args(struct export_options *options, struct arg args[MAX_EXPORT_ARGS]);

#endif
