// SPDX-License-Identifier: Apache-2.0
/* The options of `mxgen render`, which the program mxgen-render reads. */
#ifndef MXG_PROGRAM_RENDER_OPTIONS_H
#define MXG_PROGRAM_RENDER_OPTIONS_H

#include "program/cli.h"

struct render_options {
    const char *output, *copy, *element, *look, *size, *mesh, *camera, *scene, *background,
        *missing_texture, *baked, *occlusion, *stage, *purpose, *layer_sample, *translate;
    struct arg_list settings, environments, solo, mute;
    size_t samples, frame, frames, paths, bounces, picks;
    bool path_trace, as_drawn, list;
    const char *show; /* NULL: the materials */
};

#define RENDER_OPTIONS_DEFAULTS \
    { \
        .mesh = "ball", .scene = "studio", .background = "backdrop", .missing_texture = "error", \
        .samples = 32, .frame = 33, .paths = 256, .bounces = 32, .picks = 1 \
    }

enum { MAX_RENDER_ARGS = 34 };

/* Fills the table of options, which refers to the values; returns the number of options. */
size_t render_args(struct render_options *options, struct arg args[MAX_RENDER_ARGS]);

#endif
