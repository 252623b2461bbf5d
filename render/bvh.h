// SPDX-License-Identifier: Apache-2.0
/*
 * A tree of boxes around the triangles of objects in the world, for path.glsl; bvh_ray.c has rays
 * on the CPU.
 */
#ifndef MXG_RENDER_BVH_H
#define MXG_RENDER_BVH_H

#include "render/scene.h"

struct bvh_node {
    float low[3];
    uint32_t first; /* first triangle; of an inner node, the first of its two children */
    float high[3];
    uint32_t count; /* number of triangles; 0: an inner node */
};

struct bvh_corner {
    float position[3], s, normal[3], t, tangent[3];
    uint32_t object;
    float rest[3];     /* the position before displacement */
    uint32_t triangle; /* number in its object */
    float moved[4];    /* the normal after displacement */
};

struct bvh {
    struct bvh_node *nodes;
    struct bvh_corner *corners; /* three per triangle, in the order of the leaves */
    uint32_t num_nodes, num_triangles;
};

/* false: out of memory. Call bvh_finish in any case. */
bool bvh_build(const struct scene_object *const *objects, uint32_t num_objects, struct bvh *out);
/*
 * Moves the corners to `positions` (four floats each), and rotates their normals with the adjacent
 * triangles.
 */
bool bvh_move(struct bvh *bvh, const float *positions);
void bvh_finish(struct bvh *bvh);

/* Where a ray meets a triangle; leaves: from behind. */
struct bvh_crossing {
    double distance; /* in lengths of the direction, above 0 */
    bool leaves;
};
/* False: the ray from the point misses the triangle. */
bool bvh_cross(const struct bvh_corner corners[3], const double point[3], const double direction[3],
               struct bvh_crossing *out);
/* True if the ray meets any triangle. */
bool bvh_is_closed(const struct bvh *bvh, const double point[3], const double direction[3]);

#endif
