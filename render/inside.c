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
    double distance;
    bool leaves;
    uint32_t object;
};

/* Möller and Trumbore 1997; false: the ray misses the triangle. */
static bool cross_triangle(const struct bvh_corner *corners, const double point[3],
                           const double direction[3], struct crossing *out)
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
    *out = (struct crossing){vector_dot(v, q) / determinant, determinant < 0, corners->object};
    return a >= 0 && b >= 0 && a + b <= 1 && out->distance > 0;
}

static int compare_farther_first(const void *a, const void *b)
{
    double x = ((const struct crossing *)a)->distance, y = ((const struct crossing *)b)->distance;
    return x < y ? 1 : x > y ? -1 : 0;
}

size_t inside_find(const struct bvh *bvh, const bool *marked, uint32_t num_objects,
                   const double point[3], uint32_t *out, size_t most)
{
    /* along no axis, edge or diagonal that meshes like to have */
    static const double direction[3] = {0.4913, 0.7231, 0.4855};
    struct crossing *first = malloc((num_objects + 1) * sizeof *first), next;
    if (!first)
        return SIZE_MAX;
    for (uint32_t o = 0; o < num_objects; ++o)
        first[o] = (struct crossing){INFINITY, false, o};
    for (size_t t = 0; t < bvh->num_triangles; ++t) {
        const struct bvh_corner *corners = &bvh->corners[3 * t];
        if (marked[corners->object] && cross_triangle(corners, point, direction, &next)
            && next.distance < first[corners->object].distance)
            first[corners->object] = next;
    }
    size_t num = 0;
    for (uint32_t o = 0; o < num_objects; ++o)
        if (first[o].leaves)
            first[num++] = first[o];
    qsort(first, num, sizeof *first, compare_farther_first);
    size_t skipped = num > most ? num - most : 0;
    for (size_t i = skipped; i < num; ++i)
        out[i - skipped] = first[i].object;
    free(first);
    return num - skipped;
}
