// SPDX-License-Identifier: Apache-2.0
/* The surface of a bake: a square of texture coordinates, or a mesh. */
#ifndef MXG_RENDER_BAKE_SURFACE_H
#define MXG_RENDER_BAKE_SURFACE_H

#include "render/bake_tiles.h"
#include "render/site.h"

struct bake_surface {
    struct scene square;          /* of texture coordinates, in the place of a surface */
    struct site site;             /* of a file */
    struct scene_object *objects; /* of the mesh; NULL: there is none */
    uint32_t num_objects;
    struct bake_tiles tiles; /* that the mesh covers */
};

/* `mesh` NULL: none. false after reporting an error. Call bake_surface_close in any case. */
bool bake_surface_open(struct bake_surface *surface, struct cli *cli, const char *mesh);
void bake_surface_close(struct bake_surface *surface);
/* Makes the square cover these tiles. */
void bake_surface_cover(struct bake_surface *surface, const struct bake_tiles *tiles);

/*
 * The part of the tile's texels, of `size` in each direction, that triangles cover more than once,
 * from 0 to 1, on a grid of at most 1024 x 1024.
 */
double bake_surface_overlap(const struct bake_surface *surface, struct bake_tile tile,
                            uint32_t size);

/*
 * From texture coordinates to the clip space of a picture that shows texels from (x, y), counted
 * from the top left, of a tile that has `size` in each direction.
 */
struct matrix bake_surface_view(struct bake_tile tile, uint32_t size, uint32_t x, uint32_t y,
                                uint32_t width, uint32_t height);

#endif
