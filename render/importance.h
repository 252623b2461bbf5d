// SPDX-License-Identifier: Apache-2.0
/* Sums of an environment map's light, by which path.glsl draws directions from it. */
#ifndef MXG_RENDER_IMPORTANCE_H
#define MXG_RENDER_IMPORTANCE_H

#include "render/image.h"

/*
 * (height + 1) sums over rows, which rise from 0 to 1, then (width + 1) for each row over its
 * texels. malloc; NULL: there is no memory. Every texel has a share: its light, that of its
 * neighbours, which reaches into it when the map is filtered, and a little of the mean.
 */
float *importance_of_map(const struct image *map, size_t *out_count);

#endif
