// SPDX-License-Identifier: Apache-2.0
/* Cumulative sums of an environment map's light, from which path.glsl samples directions. */
#ifndef MXG_RENDER_IMPORTANCE_H
#define MXG_RENDER_IMPORTANCE_H

#include "render/image.h"

/*
 * (height + 1) sums over rows, which rise from 0 to 1, then (width + 1) for each row over its
 * texels. malloc; NULL: out of memory. Every texel has a share: its light, the light of adjacent
 * texels, which filtering mixes in, and a little of the mean.
 */
float *importance_of_map(const struct image *map, size_t *out_count);

#endif
