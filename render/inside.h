// SPDX-License-Identifier: Apache-2.0
/* Points inside of meshes, and boxes around them, by triangles in the world. */
#ifndef MXG_RENDER_INSIDE_H
#define MXG_RENDER_INSIDE_H

#include "render/bvh.h"

struct inside_box {
    float low[3], high[3]; /* low above high: there is no triangle */
};

/* The boxes around all objects. */
void inside_boxes(const struct bvh *bvh, struct inside_box *out, uint32_t num_objects);

/*
 * The objects among those marked whose closed meshes have the point inside, from the outermost: by
 * how far they are left. Of more than `most` these are the innermost. Returns their number;
 * SIZE_MAX: out of memory.
 */
size_t inside_find(const struct bvh *bvh, const bool *marked, uint32_t num_objects,
                   const double point[3], uint32_t *out, size_t most);

#endif
