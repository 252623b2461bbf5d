// SPDX-License-Identifier: Apache-2.0
#include "render/bvh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEAF_TRIANGLES = 4 };

struct item {
    float low[3], high[3], centre[3];
    uint32_t triangle;
};

static struct item make_item(const struct mesh *mesh, uint32_t triangle)
{
    struct item item = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, {0}, triangle};
    for (uint32_t k = 0; k < 3; ++k)
        for (size_t i = 0; i < 3; ++i) {
            float x = mesh->vertices[mesh->indices[triangle * 3 + k]].position[i];
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

/* Half of the triangles to each side of the longest axis: the tree's depth is the logarithm of their number. */
static void split(struct bvh *bvh, uint32_t node, struct item *items, uint32_t first, uint32_t count)
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
        if (bvh->nodes[node].high[i] - bvh->nodes[node].low[i] > bvh->nodes[node].high[axis] - bvh->nodes[node].low[axis])
            axis = i;
    qsort(items + first, count, sizeof *items, compare[axis]);
    uint32_t children = bvh->num_nodes;
    bvh->num_nodes += 2;
    bvh->nodes[node].first = children;
    bvh->nodes[node].count = 0;
    split(bvh, children, items, first, count / 2);
    split(bvh, children + 1, items, first + count / 2, count - count / 2);
}

static struct bvh_corner make_corner(const struct vertex *vertex)
{
    struct bvh_corner corner = {.s = vertex->texcoord[0], .t = vertex->texcoord[1]};
    memcpy(corner.position, vertex->position, sizeof corner.position);
    memcpy(corner.normal, vertex->normal, sizeof corner.normal);
    memcpy(corner.tangent, vertex->tangent, sizeof vertex->tangent);
    return corner;
}

bool bvh_build(const struct mesh *mesh, struct bvh *out)
{
    uint32_t count = mesh->num_indices / 3;
    *out = (struct bvh){malloc(2 * (size_t)count * sizeof *out->nodes), malloc(3 * (size_t)count * sizeof *out->corners), 1, count};
    struct item *items = malloc(count * sizeof *items);
    bool good = items && out->nodes && out->corners;
    for (uint32_t i = 0; good && i < count; ++i)
        items[i] = make_item(mesh, i);
    if (good)
        split(out, 0, items, 0, count);
    for (uint32_t i = 0; good && i < 3 * count; ++i)
        out->corners[i] = make_corner(&mesh->vertices[mesh->indices[items[i / 3].triangle * 3 + i % 3]]);
    free(items);
    return good;
}

void bvh_finish(struct bvh *bvh)
{
    free(bvh->nodes);
    free(bvh->corners);
}
