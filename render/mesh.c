// SPDX-License-Identifier: Apache-2.0
#include "render/mesh.h"

#include "program/memory.h"
#include "render/matrix.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void mesh_allocate(struct mesh *mesh, uint32_t num_vertices, uint32_t num_indices)
{
    *mesh =
        (struct mesh){memory_alloc(num_vertices * sizeof *mesh->vertices),
                      memory_alloc(num_indices * sizeof *mesh->indices), num_vertices, num_indices};
}

void mesh_finish(struct mesh *mesh)
{
    free(mesh->vertices);
    free(mesh->indices);
    *mesh = (struct mesh){0};
}

/* ---- Triangles ---- */

static struct vertex *corner(const struct mesh *mesh, uint32_t index)
{
    return &mesh->vertices[mesh->indices[index]];
}

static void edge(const struct vertex *from, const struct vertex *to, double out[3])
{
    for (size_t i = 0; i < 3; ++i)
        out[i] = (double)to->position[i] - (double)from->position[i];
}

/* Its length is twice the area. */
static void face_normal(const struct mesh *mesh, uint32_t first, double out[3])
{
    double a[3], b[3];
    edge(corner(mesh, first), corner(mesh, first + 1), a);
    edge(corner(mesh, first), corner(mesh, first + 2), b);
    vector_cross(a, b, out);
}

double mesh_area(const struct mesh *mesh)
{
    double area = 0;
    for (uint32_t i = 0; i + 2 < mesh->num_indices; i += 3) {
        double normal[3];
        face_normal(mesh, i, normal);
        area += sqrt(vector_dot(normal, normal)) / 2;
    }
    return area;
}

/* ---- Parts ---- */

/* Stores a unit direction as floats; `otherwise` for a zero vector. */
static void store_unit(const double v[3], const float otherwise[3], float out[3])
{
    double length = sqrt(vector_dot(v, v));
    for (size_t i = 0; i < 3; ++i)
        out[i] = length > 1e-20 ? (float)(v[i] / length) : otherwise[i];
}

/* Adds v of each triangle to its corners. */
static void add_to_corners(const struct mesh *mesh, uint32_t first, const double v[3],
                           double (*sums)[3])
{
    for (uint32_t k = 0; k < 3; ++k)
        for (size_t i = 0; i < 3; ++i)
            sums[mesh->indices[first + k]][i] += v[i];
}

static void make_normals(struct mesh *mesh)
{
    double(*sums)[3] = memory_alloc(mesh->num_vertices * sizeof *sums);
    for (uint32_t i = 0; i + 2 < mesh->num_indices; i += 3) {
        double normal[3];
        face_normal(mesh, i, normal);
        add_to_corners(mesh, i, normal, sums);
    }
    for (uint32_t i = 0; i < mesh->num_vertices; ++i)
        store_unit(sums[i], (const float[3]){0, 1, 0}, mesh->vertices[i].normal);
    free(sums);
}

void mesh_split(struct mesh *mesh)
{
    struct vertex *vertices = memory_alloc(mesh->num_indices * sizeof *vertices);
    for (uint32_t i = 0; i < mesh->num_indices; ++i) {
        vertices[i] = *corner(mesh, i);
        mesh->indices[i] = i;
    }
    free(mesh->vertices);
    mesh->vertices = vertices;
    mesh->num_vertices = mesh->num_indices;
}

/* Adjacent triangles may be projected along different axes, so each has its own corners. */
static void make_texcoords(struct mesh *mesh)
{
    for (uint32_t first = 0; first + 2 < mesh->num_indices; first += 3) {
        double n[3];
        face_normal(mesh, first, n);
        size_t axis = fabs(n[0]) > fabs(n[1]) && fabs(n[0]) > fabs(n[2]) ? 0
                      : fabs(n[1]) > fabs(n[2])                          ? 1
                                                                         : 2;
        size_t across = axis == 0 ? 2 : 0, up = axis == 1 ? 2 : 1;
        double side = (n[axis] < 0) == (axis == 2) ? -1 : 1; /* images are not mirrored */
        for (uint32_t k = 0; k < 3; ++k) {
            struct vertex *vertex = corner(mesh, first + k);
            double s = vertex->position[across], t = vertex->position[up];
            vertex->texcoord[0] = (float)(0.5 - 0.5 * side * s);
            vertex->texcoord[1] = (float)(0.5 + 0.5 * (axis == 1 ? -t : t));
        }
    }
}

/*
 * Lengyel 2001, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh": dP/ds of each
 * triangle.
 */
static void face_tangent(const struct mesh *mesh, uint32_t first, double out[3])
{
    const struct vertex *v[3] = {corner(mesh, first), corner(mesh, first + 1),
                                 corner(mesh, first + 2)};
    double a[3], b[3];
    edge(v[0], v[1], a);
    edge(v[0], v[2], b);
    double s1 = (double)v[1]->texcoord[0] - v[0]->texcoord[0],
           t1 = (double)v[1]->texcoord[1] - v[0]->texcoord[1];
    double s2 = (double)v[2]->texcoord[0] - v[0]->texcoord[0],
           t2 = (double)v[2]->texcoord[1] - v[0]->texcoord[1];
    double sign = s1 * t2 - s2 * t1 < 0 ? -1 : 1;
    for (size_t i = 0; i < 3; ++i)
        out[i] = sign * (a[i] * t2 - b[i] * t1);
}

static void any_tangent(const float normal[3], float out[3])
{
    const double n[3] = {normal[0], normal[1], normal[2]}, up[3] = {0, 1, 0}, right[3] = {1, 0, 0};
    double across[3];
    vector_cross(fabs(n[1]) < 0.9 ? up : right, n, across);
    store_unit(across, (const float[3]){1, 0, 0}, out);
}

/* The tangent of the vertex becomes this direction in the plane of its normal. */
static void flatten_tangent(struct vertex *vertex, const double direction[3])
{
    const double n[3] = {vertex->normal[0], vertex->normal[1], vertex->normal[2]};
    double along = vector_dot(direction, n);
    const double flat[3] = {direction[0] - along * n[0], direction[1] - along * n[1],
                            direction[2] - along * n[2]};
    float otherwise[3];
    any_tangent(vertex->normal, otherwise);
    store_unit(flat, otherwise, vertex->tangent);
}

/* ---- Equal vertices ---- */

/* A vertex with what makes it the same point as another one. */
struct twin {
    float at[8]; /* position; of points of a smooth surface also normal and texcoord, or else 0 */
    uint32_t vertex;
};

/* A total order: NaN comes last, and is equal to itself. */
static int compare_twins(const void *a, const void *b)
{
    const struct twin *x = a, *y = b;
    for (size_t i = 0; i < 8; ++i) {
        bool is_nan = isnan(x->at[i]), is_other_nan = isnan(y->at[i]);
        if (is_nan != is_other_nan)
            return is_nan ? 1 : -1;
        if (!is_nan && x->at[i] != y->at[i])
            return x->at[i] < y->at[i] ? -1 : 1;
    }
    return 0;
}

/* All vertices, equal ones beside each other. The caller frees them. */
static struct twin *sort_twins(const struct mesh *mesh, bool is_smooth)
{
    struct twin *twins = memory_alloc(mesh->num_vertices * sizeof *twins);
    for (uint32_t i = 0; i < mesh->num_vertices; ++i) {
        const struct vertex *v = &mesh->vertices[i];
        memcpy(twins[i].at, v->position, sizeof v->position);
        if (is_smooth) {
            memcpy(twins[i].at + 3, v->normal, sizeof v->normal);
            memcpy(twins[i].at + 6, v->texcoord, sizeof v->texcoord);
        }
        twins[i].vertex = i;
    }
    qsort(twins, mesh->num_vertices, sizeof *twins, compare_twins);
    return twins;
}

/* Behind the last vertex that is equal to number `first`. */
static uint32_t end_of_twins(const struct mesh *mesh, const struct twin *twins, uint32_t first)
{
    uint32_t end = first + 1;
    while (end < mesh->num_vertices && !compare_twins(twins + first, twins + end))
        ++end;
    return end;
}

/* Vertices that differ in nothing get the sum of their tangents: triangles need not share them. */
static void share_tangents(const struct mesh *mesh, double (*sums)[3])
{
    struct twin *twins = sort_twins(mesh, true);
    for (uint32_t first = 0, end; first < mesh->num_vertices; first = end) {
        double sum[3] = {0};
        end = end_of_twins(mesh, twins, first);
        for (uint32_t k = first; k < end; ++k)
            for (size_t i = 0; i < 3; ++i)
                sum[i] += sums[twins[k].vertex][i];
        for (uint32_t k = first; k < end; ++k)
            memcpy(sums[twins[k].vertex], sum, sizeof sum);
    }
    free(twins);
}

/* Gives all of these vertices the mean normal, unless that is none, and the tangent of the first.
 */
static void weld(const struct mesh *mesh, const struct twin *twins, uint32_t num)
{
    double sum[3] = {0};
    for (uint32_t k = 0; k < num; ++k)
        for (size_t i = 0; i < 3; ++i)
            sum[i] += (double)mesh->vertices[twins[k].vertex].normal[i];
    if (vector_dot(sum, sum) < 1e-4)
        return;
    struct vertex *first = &mesh->vertices[twins[0].vertex];
    store_unit(sum, first->normal, first->normal);
    flatten_tangent(first,
                    (const double[3]){first->tangent[0], first->tangent[1], first->tangent[2]});
    for (uint32_t k = 1; k < num; ++k) {
        struct vertex *vertex = &mesh->vertices[twins[k].vertex];
        memcpy(vertex->normal, first->normal, sizeof first->normal);
        memcpy(vertex->tangent, first->tangent, sizeof first->tangent);
    }
}

void mesh_weld(struct mesh *mesh)
{
    struct twin *twins = sort_twins(mesh, false);
    for (uint32_t first = 0, end; first < mesh->num_vertices; first = end) {
        end = end_of_twins(mesh, twins, first);
        weld(mesh, twins + first, end - first);
    }
    free(twins);
}

static void make_tangents(struct mesh *mesh)
{
    double(*sums)[3] = memory_alloc(mesh->num_vertices * sizeof *sums);
    for (uint32_t i = 0; i + 2 < mesh->num_indices; i += 3) {
        double tangent[3];
        face_tangent(mesh, i, tangent);
        add_to_corners(mesh, i, tangent, sums);
    }
    share_tangents(mesh, sums);
    for (uint32_t i = 0; i < mesh->num_vertices; ++i)
        flatten_tangent(&mesh->vertices[i], sums[i]);
    free(sums);
}

void mesh_complete(struct mesh *mesh, unsigned missing)
{
    if (missing & MESH_NORMALS)
        make_normals(mesh);
    if (missing & MESH_TEXCOORDS) {
        mesh_split(mesh);
        make_texcoords(mesh);
    }
    if (missing & MESH_TANGENTS)
        make_tangents(mesh);
    for (uint32_t i = 0; i < mesh->num_vertices; ++i)
        memcpy(mesh->vertices[i].parameter, mesh->vertices[i].texcoord,
               sizeof mesh->vertices[i].parameter);
}

void mesh_project(struct mesh *mesh)
{
    make_texcoords(mesh);
    mesh_complete(mesh, MESH_TANGENTS);
}

/* ---- Changes of the whole ---- */

void mesh_centre(const struct mesh *mesh, double out[3])
{
    memset(out, 0, 3 * sizeof *out);
    for (uint32_t v = 0; v < mesh->num_vertices; ++v)
        for (size_t i = 0; i < 3; ++i)
            out[i] += (double)mesh->vertices[v].position[i] / mesh->num_vertices;
}

void mesh_fit(struct mesh *mesh)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY},
           radius = 0;
    for (uint32_t v = 0; v < mesh->num_vertices; ++v)
        for (size_t i = 0; i < 3; ++i) {
            low[i] = fmin(low[i], mesh->vertices[v].position[i]);
            high[i] = fmax(high[i], mesh->vertices[v].position[i]);
        }
    for (uint32_t v = 0; v < mesh->num_vertices; ++v) {
        double square = 0;
        for (size_t i = 0; i < 3; ++i)
            square += pow(mesh->vertices[v].position[i] - (low[i] + high[i]) / 2, 2);
        radius = fmax(radius, sqrt(square));
    }
    for (uint32_t v = 0; radius > 0 && v < mesh->num_vertices; ++v)
        for (size_t i = 0; i < 3; ++i) {
            float *x = &mesh->vertices[v].position[i];
            *x = (float)((*x - (low[i] + high[i]) / 2) / radius);
        }
}

/* Both triangles of an edge compute the same midpoint, so the mesh stays closed. */
static struct vertex middle(const struct vertex *a, const struct vertex *b)
{
    struct vertex out;
    const float *x = (const float *)a, *y = (const float *)b;
    float *m = (float *)&out;
    for (size_t i = 0; i < sizeof out / sizeof *m; ++i)
        m[i] = 0.5f * (x[i] + y[i]);
    float *units[] = {out.normal, out.tangent};
    for (size_t k = 0; k < 2; ++k) {
        const double v[3] = {units[k][0], units[k][1], units[k][2]};
        store_unit(v, (const float[3]){0, 1, 0}, units[k]);
    }
    return out;
}

void mesh_quarter(struct mesh *mesh)
{
    struct mesh fine;
    mesh_allocate(&fine, mesh->num_indices * 2, mesh->num_indices * 4);
    for (uint32_t first = 0; first + 2 < mesh->num_indices; first += 3) {
        static const uint32_t pattern[12] = {0, 3, 5, 3, 1, 4, 5, 4, 2, 3, 4, 5};
        struct vertex *v = &fine.vertices[first * 2];
        for (uint32_t k = 0; k < 3; ++k)
            v[k] = *corner(mesh, first + k);
        for (uint32_t k = 0; k < 3; ++k)
            v[3 + k] = middle(&v[k], &v[(k + 1) % 3]);
        for (uint32_t k = 0; k < 12; ++k)
            fine.indices[first * 4 + k] = first * 2 + pattern[k];
    }
    mesh_finish(mesh);
    *mesh = fine;
}

float (*mesh_quarter_values(const struct mesh *mesh, float (*values)[4]))[4]
{
    float(*out)[4] = memory_alloc((size_t)mesh->num_indices * 2 * sizeof *out);
    for (uint32_t first = 0; first + 2 < mesh->num_indices; first += 3)
        for (uint32_t k = 0; k < 3; ++k)
            for (size_t c = 0; c < 4; ++c) {
                float from = values[mesh->indices[first + k]][c],
                      to = values[mesh->indices[first + (k + 1) % 3]][c];
                out[first * 2 + k][c] = from;
                out[first * 2 + 3 + k][c] = 0.5f * (from + to);
            }
    return out;
}

void mesh_subdivide(struct mesh *mesh, uint32_t wanted)
{
    while (mesh->num_indices / 3 < wanted)
        mesh_quarter(mesh);
}

/* ---- Order ---- */

struct distant {
    double distance;
    uint32_t first;
};

static int compare_distance(const void *a, const void *b)
{
    const struct distant *x = a, *y = b;
    if (x->distance != y->distance)
        return x->distance < y->distance ? 1 : -1;
    return x->first < y->first ? -1 : x->first > y->first;
}

uint32_t *mesh_sorted(const struct mesh *mesh, const double eye[3])
{
    uint32_t count = mesh->num_indices / 3;
    struct distant *order = memory_alloc(count * sizeof *order);
    uint32_t *out = memory_alloc(mesh->num_indices * sizeof *out);
    for (uint32_t t = 0; t < count; ++t) {
        double square = 0;
        for (size_t i = 0; i < 3; ++i) {
            double sum = 0;
            for (uint32_t k = 0; k < 3; ++k)
                sum += corner(mesh, t * 3 + k)->position[i];
            square += pow(sum / 3 - eye[i], 2);
        }
        order[t] = (struct distant){square, t * 3};
    }
    qsort(order, count, sizeof *order, compare_distance);
    for (uint32_t t = 0; t < count; ++t)
        memcpy(out + t * 3, mesh->indices + order[t].first, 3 * sizeof *out);
    free(order);
    return out;
}
