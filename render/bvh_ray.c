// SPDX-License-Identifier: Apache-2.0
#include "render/bvh.h"

#include <assert.h>
#include <math.h>

/* Möller and Trumbore 1997 */
bool bvh_cross(const struct bvh_corner corners[3], const double point[3], const double direction[3],
               struct bvh_crossing *out)
{
    double u[3], v[3], t[3], p[3], q[3];
    for (size_t i = 0; i < 3; ++i) {
        u[i] = (double)corners[1].position[i] - (double)corners[0].position[i];
        v[i] = (double)corners[2].position[i] - (double)corners[0].position[i];
        t[i] = point[i] - (double)corners[0].position[i];
    }
    vector_cross(direction, v, p);
    vector_cross(t, u, q);
    double determinant = vector_dot(u, p), a = vector_dot(t, p) / determinant,
           b = vector_dot(direction, q) / determinant;
    *out = (struct bvh_crossing){vector_dot(v, q) / determinant, determinant < 0};
    return a >= 0 && b >= 0 && a + b <= 1 && out->distance > 0;
}

/*
 * The slabs of a box; `inverse` of the direction. A ray in the plane of a side gives NaN there,
 * which no comparison takes.
 */
static bool meets_box(const struct bvh_node *node, const double point[3], const double inverse[3])
{
    double first = 0, last = INFINITY;
    for (size_t i = 0; i < 3; ++i) {
        double a = ((double)node->low[i] - point[i]) * inverse[i],
               b = ((double)node->high[i] - point[i]) * inverse[i], near = a < b ? a : b,
               far = a < b ? b : a;
        first = near > first ? near : first;
        last = far < last ? far : last;
    }
    return first <= last;
}

bool bvh_is_closed(const struct bvh *bvh, const double point[3], const double direction[3])
{
    enum { DEPTH = 128 }; /* bvh_build halves its triangles, so no tree comes near it */
    const double inverse[3] = {1 / direction[0], 1 / direction[1], 1 / direction[2]};
    uint32_t open[DEPTH], num = 0;
    struct bvh_crossing crossing;
    if (bvh->num_nodes)
        open[num++] = 0;
    while (num) {
        const struct bvh_node *node = &bvh->nodes[open[--num]];
        if (!meets_box(node, point, inverse))
            continue;
        for (uint32_t t = 0; t < node->count; ++t)
            if (bvh_cross(&bvh->corners[3 * ((size_t)node->first + t)], point, direction,
                          &crossing))
                return true;
        if (!node->count) {
            assert(num + 2 <= DEPTH);
            open[num++] = node->first;
            open[num++] = node->first + 1;
        }
    }
    return false;
}
