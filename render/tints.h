// SPDX-License-Identifier: Apache-2.0
/*
 * The tables of tints that stored materials name by number, as one texture: squares, one above the
 * other (docs/deferred.md).
 */
#ifndef MXG_RENDER_TINTS_H
#define MXG_RENDER_TINTS_H

#include "render/image.h"

#include <mxgen/mxgen.h>

enum { TINTS_MAX = 64 };

struct bind;

struct tints {
    struct image image; /* white where there is no table */
    struct image parts[TINTS_MAX];
    const char *names[TINTS_MAX]; /* files, as the shaders or the user name them */
    uint32_t count;
};

/* True for the number of a table. */
bool tints_is_number(const mxg_variable *variable);
/*
 * Reads the tables that the shaders name, and sets bind->tints. The shaders outlive the tables.
 * false: see the reason of the bind with an id.
 */
bool tints_open(struct tints *tints, struct bind *const *binds, size_t count);
/* The number of a table of tints_open; 0 where it could not be read. */
uint32_t tints_find(const struct tints *tints, const char *file);
void tints_close(struct tints *tints);

#endif
