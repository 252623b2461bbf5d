// SPDX-License-Identifier: Apache-2.0
#include "render/bvh.h"

#include "render/matrix.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEAF_TRIANGLES = 4 };

struct item {
    float low[3], high[3], centre[3];
    uint32_t triangle; /* three corners in `corners` */
};

static struct item make_item(const struct bvh_corner *corners, uint32_t triangle)
{
    struct item item = {
        {INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, {0}, triangle};
    for (uint32_t k = 0; k < 3; ++k)
        for (size_t i = 0; i < 3; ++i) {
            float x = corners[3 * (size_t)triangle + k].position[i];
            item.low[i] = fminf(item.low[i], x);
            item.high[i] = fmaxf(item.high[i], x);
        }
    for (size_t i = 0; i < 3; ++i)
        item.centre[i] = 0.5f * (item.low[i] + item.high[i]);
    return item;
}

static void bound(const struct item *items, uint32_t count, struct bvh_node *out)
{
    for (size_t i = 0; i < 3; ++i) {
        out->low[i] = INFINITY;
        out->high[i] = -INFINITY;
        for (uint32_t k = 0; k < count; ++k) {
            out->low[i] = fminf(out->low[i], items[k].low[i]);
            out->high[i] = fmaxf(out->high[i], items[k].high[i]);
        }
    }
}

static int compare_axis(const void *a, const void *b, size_t axis)
{
    float x = ((const struct item *)a)->centre[axis], y = ((const struct item *)b)->centre[axis];
    return x < y ? -1 : x > y;
}

static int compare_x(const void *a, const void *b)
{
    return compare_axis(a, b, 0);
}

static int compare_y(const void *a, const void *b)
{
    return compare_axis(a, b, 1);
}

static int compare_z(const void *a, const void *b)
{
    return compare_axis(a, b, 2);
}

/*
 * Half of the triangles to each side of the longest axis: the tree's depth is the logarithm of
 * their number.
 */
static void split(struct bvh *bvh, uint32_t node, struct item *items, uint32_t first,
                  uint32_t count)
{
    static int (*const compare[3])(const void *, const void *) = {compare_x, compare_y, compare_z};
    bound(items + first, count, &bvh->nodes[node]);
    if (count <= LEAF_TRIANGLES) {
        bvh->nodes[node].first = first;
        bvh->nodes[node].count = count;
        return;
    }
    size_t axis = 0;
    for (size_t i = 1; i < 3; ++i)
        if (bvh->nodes[node].high[i] - bvh->nodes[node].low[i]
            > bvh->nodes[node].high[axis] - bvh->nodes[node].low[axis])
            axis = i;
    qsort(items + first, count, sizeof *items, compare[axis]);
    uint32_t children = bvh->num_nodes;
    bvh->num_nodes += 2;
    bvh->nodes[node].first = children;
    bvh->nodes[node].count = 0;
    split(bvh, children, items, first, count / 2);
    split(bvh, children + 1, items, first + count / 2, count - count / 2);
}

static void store_unit(double v[3], float out[3])
{
    vector_normalize(v);
    for (size_t i = 0; i < 3; ++i)
        out[i] = (float)v[i];
}

/* The vertex in the world. */
static struct bvh_corner make_corner(const struct vertex *vertex, const struct matrix *world,
                                     const struct matrix *normals)
{
    struct bvh_corner corner = {.s = vertex->texcoord[0], .t = vertex->texcoord[1]};
    double at[3], normal[3], tangent[3];
    for (size_t i = 0; i < 3; ++i) {
        at[i] = vertex->position[i];
        normal[i] = vertex->normal[i];
        tangent[i] = vertex->tangent[i];
    }
    matrix_point(*world, at, at);
    matrix_direction(*normals, normal, normal);
    matrix_direction(*world, tangent, tangent);
    for (size_t i = 0; i < 3; ++i)
        corner.position[i] = corner.rest[i] = (float)at[i];
    store_unit(normal, corner.normal);
    store_unit(tangent, corner.tangent);
    memcpy(corner.moved, corner.normal, sizeof corner.normal);
    return corner;
}

static void add_corners(const struct scene_object *object, uint32_t number,
                        struct bvh_corner *corners)
{
    const struct mesh *mesh = &object->mesh;
    struct matrix normals = matrix_transpose(matrix_inverse(object->world));
    for (uint32_t i = 0; i < mesh->num_indices; ++i) {
        corners[i] = make_corner(&mesh->vertices[mesh->indices[i]], &object->world, &normals);
        corners[i].object = number;
        corners[i].triangle = i / 3;
    }
}

bool bvh_build(const struct scene_object *const *objects, uint32_t num_objects, struct bvh *out)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < num_objects; ++i)
        count += objects[i]->mesh.num_indices / 3;
    *out = (struct bvh){malloc(2 * (size_t)count * sizeof *out->nodes),
                        malloc(3 * (size_t)count * sizeof *out->corners), 1, count};
    struct item *items = malloc(count * sizeof *items);
    struct bvh_corner *corners = malloc(3 * (size_t)count * sizeof *corners);
    bool good = items && corners && out->nodes && out->corners;
    size_t at = 0;
    for (uint32_t i = 0; good && i < num_objects; at += objects[i++]->mesh.num_indices)
        add_corners(objects[i], i, corners + at);
    for (uint32_t i = 0; good && i < count; ++i)
        items[i] = make_item(corners, i);
    if (good)
        split(out, 0, items, 0, count);
    for (size_t i = 0; good && i < 3 * (size_t)count; ++i)
        out->corners[i] = corners[3 * (size_t)items[i / 3].triangle + i % 3];
    free(items);
    free(corners);
    return good;
}

/* ---- Displacement ---- */

/* Twice a triangle's area, along its normal. */
static void facet_of(const struct bvh_corner *corners, bool at_rest, double out[3])
{
    double edges[2][3];
    for (size_t k = 0; k < 2; ++k)
        for (size_t i = 0; i < 3; ++i) {
            const float *to = at_rest ? corners[k + 1].rest : corners[k + 1].position,
                        *from = at_rest ? corners[0].rest : corners[0].position;
            edges[k][i] = (double)to[i] - (double)from[i];
        }
    vector_cross(edges[0], edges[1], out);
}

/* By place, then by normal; what differs by rounding alone is equal. */
static int compare_corners(const void *a, const void *b)
{
    const struct bvh_corner *x = *(const struct bvh_corner *const *)a,
                            *y = *(const struct bvh_corner *const *)b;
    for (size_t i = 0; i < 6; ++i) {
        const float *u = i < 3 ? x->rest : x->normal, *v = i < 3 ? y->rest : y->normal;
        long p = lrintf(u[i % 3] * 65536.0f), q = lrintf(v[i % 3] * 65536.0f);
        if (p != q)
            return p < q ? -1 : 1;
    }
    return 0;
}

/*
 * Corners at one vertex: of one place and normal, whatever their texture coordinates. N' = N + g' -
 * g, as a drawn surface has it.
 */
static void bend(const struct bvh *bvh, struct bvh_corner **group, uint32_t count)
{
    double before[3] = {0}, after[3] = {0}, normal[3];
    for (uint32_t k = 0; k < count; ++k) {
        const struct bvh_corner *triangle = bvh->corners + (group[k] - bvh->corners) / 3 * 3;
        double facet[2][3];
        facet_of(triangle, true, facet[0]);
        facet_of(triangle, false, facet[1]);
        for (size_t i = 0; i < 3; ++i) {
            before[i] += facet[0][i];
            after[i] += facet[1][i];
        }
    }
    vector_normalize(before);
    vector_normalize(after);
    for (size_t i = 0; i < 3; ++i)
        normal[i] = (double)group[0]->normal[i] + after[i] - before[i];
    vector_normalize(normal);
    for (uint32_t k = 0; k < count; ++k)
        for (size_t i = 0; i < 3; ++i)
            group[k]->moved[i] = (float)normal[i];
}

/* The boxes around what moved: children stand behind their parents. */
static void refit(struct bvh *bvh)
{
    for (uint32_t n = bvh->num_nodes; n-- > 0;) {
        struct bvh_node *node = &bvh->nodes[n];
        uint32_t parts = node->count ? 3 * node->count : 2;
        for (size_t i = 0; i < 3; ++i) {
            node->low[i] = INFINITY;
            node->high[i] = -INFINITY;
            for (uint32_t k = 0; k < parts; ++k) {
                const float *corner =
                    bvh->corners[3 * node->first + (node->count ? k : 0)].position;
                const struct bvh_node *child = node->count ? NULL : &bvh->nodes[node->first + k];
                node->low[i] = fminf(node->low[i], child ? child->low[i] : corner[i]);
                node->high[i] = fmaxf(node->high[i], child ? child->high[i] : corner[i]);
            }
        }
    }
}

bool bvh_move(struct bvh *bvh, const float *positions)
{
    uint32_t count = 3 * bvh->num_triangles;
    struct bvh_corner **sorted = malloc(count * sizeof *sorted);
    for (uint32_t i = 0; sorted && i < count; ++i) {
        memcpy(bvh->corners[i].position, positions + 4 * (size_t)i,
               sizeof bvh->corners[i].position);
        sorted[i] = &bvh->corners[i];
    }
    if (!sorted)
        return false;
    qsort(sorted, count, sizeof *sorted, compare_corners);
    for (uint32_t first = 0, end = 0; first < count; first = end) {
        while (end < count && compare_corners(&sorted[first], &sorted[end]) == 0)
            ++end;
        bend(bvh, sorted + first, end - first);
    }
    free(sorted);
    refit(bvh);
    return true;
}

void bvh_finish(struct bvh *bvh)
{
    free(bvh->nodes);
    free(bvh->corners);
}
