// SPDX-License-Identifier: Apache-2.0
/* Combinations of options: an option that another one makes useless is an error. */
#ifndef MXG_RENDER_APPLIES_H
#define MXG_RENDER_APPLIES_H

#include "program/args.h"

/* Facts about a command line; an option applies if one of the facts that it needs is true. */
enum render_fact {
    FACT_STUDIO = 1 << 0,      /* the scene is the studio */
    FACT_NO_MAP = 1 << 1,      /* --environment names no map, only modes */
    FACT_PICTURE = 1 << 2,     /* a picture is written, no values of a grid */
    FACT_DISPLAY = 1 << 3,     /* a picture has display values */
    FACT_ONE_FILE = 1 << 4,    /* one document and no look */
    FACT_ONE_PICTURE = 1 << 5, /* no sheet and no turntable */
    FACT_STILL = 1 << 6,       /* no turntable */
    FACT_TRACED = 1 << 7,      /* --path-trace */
    FACT_RASTER = 1 << 8,      /* no --path-trace */
    FACT_SAMPLED = 1 << 9,     /* a raster that samples the environment */
    FACT_NO_LOOK = 1 << 10,
    FACT_STAGE = 1 << 11, /* --stage */
    FACT_NO_STAGE = 1 << 12,
    FACT_SHOWN = 1 << 14,    /* --show has what it draws */
    FACT_CHANNELS = 1 << 13, /* a file is EXR, with channels for AOVs */
    FACT_DRAWN = 1 << 15,    /* a raster draws the role of --role */
    FACT_NOT_PREFILTERED = 1 << 16,
};

/* False after a message about the first option that does not apply. */
bool applies_all(const struct arg_parser *parser, unsigned facts);

/*
 * As applies_all, for an option that draws nothing: it takes the others of its list, which NULL
 * ends, and those of all commands only.
 */
bool applies_alone(const struct arg_parser *parser, const char *const *used);

#endif
