// SPDX-License-Identifier: Apache-2.0
/*
 * What hosts of prefiltered environments bind: made from a map, or read from a folder where it was
 * kept.
 */
#ifndef MXG_RENDER_BAKE_H
#define MXG_RENDER_BAKE_H

#include "render/image.h"

struct baked {
    /* a latitude-longitude map; each level is filtered for a higher roughness */
    struct image radiance;
    struct image irradiance; /* the cosine-weighted average around each direction */
    /* of GGX, by cosine (to the right) and roughness² (downwards): red scales F0, green F90 */
    struct image albedo;
};

/* False: out of memory. baked_finish must follow in any case. */
bool bake_environment(const struct image *map, struct baked *out);
/*
 * radiance.exr, irradiance.exr and albedo.exr in a folder that is there. On failure false, with
 * why.
 */
bool baked_write(const struct baked *baked, const char *folder, char *reason, size_t capacity);
bool baked_read(const char *folder, struct baked *out, char *reason, size_t capacity);
void baked_finish(struct baked *baked);

/* The table alone. False: out of memory. */
bool bake_albedo_table(struct image *out);

/* The directional albedo of GGX at a cosine and a roughness squared: A scales F0, B scales F90. */
void bake_albedo(double cosine, double alpha, double *out_a, double *out_b);

#endif
