// SPDX-License-Identifier: Apache-2.0
/* Tiles of texture coordinates, in the order of their numbers. */
#ifndef MXG_RENDER_BAKE_TILES_H
#define MXG_RENDER_BAKE_TILES_H

#include <stdbool.h>
#include <stdint.h>

/* A unit square of texture coordinates, from (u, v). */
struct bake_tile {
    int32_t u, v;
};

struct bake_tiles {
    struct bake_tile *items; /* by v and u */
    uint32_t num;
    bool is_set; /* each has a file with its number, also if it is the only one */
};

/* Adds a tile if it is new. */
void bake_tiles_add(struct bake_tiles *tiles, struct bake_tile tile);
bool bake_tiles_are_equal(const struct bake_tiles *a, const struct bake_tiles *b);

#endif
