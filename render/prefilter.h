// SPDX-License-Identifier: Apache-2.0
/* Prefiltered environment maps for hosts: computed from a map, or read from a folder. */
#ifndef MXG_RENDER_PREFILTER_H
#define MXG_RENDER_PREFILTER_H

#include "render/image.h"

struct baked {
    /* a latitude-longitude map; higher levels are filtered for higher roughness */
    struct image radiance;
    struct image irradiance; /* the cosine-weighted average around each direction */
    /* of GGX, by cosine (x) and roughness² (y): red scales F0, green F90 */
    struct image albedo;
};

/* false: out of memory. Call baked_finish in any case. */
bool bake_environment(const struct image *map, struct baked *out);
/*
 * Writes radiance.exr, irradiance.exr and albedo.exr to an existing folder. On failure returns
 * false and the reason.
 */
bool baked_write(const struct baked *baked, const char *folder, char *reason, size_t capacity);
bool baked_read(const char *folder, struct baked *out, char *reason, size_t capacity);
void baked_finish(struct baked *baked);

/* Makes only the table. false: out of memory. */
bool bake_albedo_table(struct image *out);

/* The directional albedo of GGX at a cosine and a roughness squared: A scales F0, B scales F90. */
void bake_albedo(double cosine, double alpha, double *out_a, double *out_b);

#endif
