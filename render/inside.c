// SPDX-License-Identifier: Apache-2.0
#include "render/inside.h"

#include "render/matrix.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void inside_boxes(const struct bvh *bvh, struct inside_box *out, uint32_t num_objects)
{
    for (uint32_t o = 0; o < num_objects; ++o)
        out[o] =
            (struct inside_box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t c = 0; c < 3 * (size_t)bvh->num_triangles; ++c) {
        struct inside_box *box = &out[bvh->corners[c].object];
        for (size_t i = 0; i < 3; ++i) {
            box->low[i] = fminf(box->low[i], bvh->corners[c].position[i]);
            box->high[i] = fmaxf(box->high[i], bvh->corners[c].position[i]);
        }
    }
}

/* Where a ray through the point leaves or enters an object first. */
struct crossing {
    struct bvh_crossing at;
    uint32_t object;
};

static int compare_farther_first(const void *a, const void *b)
{
    double x = ((const struct crossing *)a)->at.distance,
           y = ((const struct crossing *)b)->at.distance;
    return x < y ? 1 : x > y ? -1 : 0;
}

size_t inside_find(const struct bvh *bvh, const bool *marked, uint32_t num_objects,
                   const double point[3], uint32_t *out, size_t most)
{
    /* along no axis, edge or diagonal that meshes like to have */
    static const double direction[3] = {0.4913, 0.7231, 0.4855};
    struct crossing *first = malloc((num_objects + 1) * sizeof *first);
    struct bvh_crossing next;
    if (!first)
        return SIZE_MAX;
    for (uint32_t o = 0; o < num_objects; ++o)
        first[o] = (struct crossing){{INFINITY, false}, o};
    for (size_t t = 0; t < bvh->num_triangles; ++t) {
        const struct bvh_corner *corners = &bvh->corners[3 * t];
        if (marked[corners->object] && bvh_cross(corners, point, direction, &next)
            && next.distance < first[corners->object].at.distance)
            first[corners->object].at = next;
    }
    size_t num = 0;
    for (uint32_t o = 0; o < num_objects; ++o)
        if (first[o].at.leaves)
            first[num++] = first[o];
    qsort(first, num, sizeof *first, compare_farther_first);
    size_t skipped = num > most ? num - most : 0;
    for (size_t i = skipped; i < num; ++i)
        out[i - skipped] = first[i].object;
    free(first);
    return num - skipped;
}
