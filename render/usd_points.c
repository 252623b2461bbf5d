// SPDX-License-Identifier: Apache-2.0
/* Points of USD (UsdGeomPoints): a small sphere for each, of its width. */
#include "render/site.h"

#include "program/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

/* Meridians and parallels; the poles are rows of vertices, whose cells are triangles. */
enum {
    AROUND = 8,
    ALONG = 4,
    NUM_VERTICES = (AROUND + 1) * (ALONG + 1),
    NUM_INDICES = 6 * AROUND * (ALONG - 1)
};

struct points {
    double *centres, *widths;
    size_t num, num_widths;
};

/* Reads the arrays; false after an error, or if there are no points. */
static bool read_points(struct site *site, uint32_t primitive, struct points *out)
{
    *out = (struct points){0};
    out->centres = usd_numbers(site, primitive, "points", &out->num);
    out->widths = usd_numbers(site, primitive, "widths", &out->num_widths);
    out->num /= 3;
    if (out->num_widths > 1 && out->num_widths != out->num)
        site_fail(site, primitive, "widths", "has %zu numbers for %zu points", out->num_widths,
                  out->num);
    return out->num && site_has_room(site, primitive, (uint64_t)out->num * NUM_INDICES / 3);
}

/* A width is a diameter; without widths it is 1. */
static double radius_of(const struct points *points, size_t i)
{
    return (points->num_widths ? points->widths[points->num_widths > 1 ? i : 0] : 1) / 2;
}

static void add_vertices(const struct points *points, size_t number, struct vertex *out)
{
    double radius = radius_of(points, number);
    for (uint32_t y = 0; y <= ALONG; ++y)
        for (uint32_t x = 0; x <= AROUND; ++x, ++out) {
            double azimuth = 2 * PI * x / AROUND, height = PI * y / ALONG - PI / 2;
            const double normal[3] = {cos(height) * cos(azimuth), cos(height) * sin(azimuth),
                                      sin(height)};
            for (size_t i = 0; i < 3; ++i) {
                out->normal[i] = (float)normal[i];
                out->position[i] = (float)(points->centres[3 * number + i] + radius * normal[i]);
            }
            out->texcoord[0] = (float)x / AROUND;
            out->texcoord[1] = (float)y / ALONG;
        }
}

static void add_indices(uint32_t first, uint32_t *out)
{
    for (uint32_t y = 0; y < ALONG; ++y)
        for (uint32_t x = 0; x < AROUND; ++x) {
            uint32_t a = first + y * (AROUND + 1) + x, b = a + AROUND + 1;
            const uint32_t lower[] = {a, a + 1, b + 1}, upper[] = {a, b + 1, b};
            if (y > 0)
                out = (uint32_t *)memcpy(out, lower, sizeof lower) + 3;
            if (y + 1 < ALONG)
                out = (uint32_t *)memcpy(out, upper, sizeof upper) + 3;
        }
}

/* A vertex has the values of its point, and the whole is one face. */
static void add_primvars(struct site *site, uint32_t primitive, uint32_t num_vertices,
                         struct scene_object *object)
{
    uint32_t *faces = memory_alloc(2 * num_vertices * sizeof *faces),
             *numbers = faces + num_vertices;
    const struct usd_corners corners = {num_vertices, faces, numbers, numbers};
    for (uint32_t i = 0; i < num_vertices; ++i)
        numbers[i] = i / NUM_VERTICES;
    usd_add_primvars(site, primitive, &corners, object);
    free(faces);
}

void usd_add_points(struct site *site, uint32_t primitive, struct matrix world)
{
    struct points points;
    struct mesh mesh;
    if (read_points(site, primitive, &points)) {
        uint32_t num = (uint32_t)points.num;
        mesh_allocate(&mesh, num * NUM_VERTICES, num * NUM_INDICES);
        for (uint32_t i = 0; i < num; ++i) {
            add_vertices(&points, i, &mesh.vertices[i * NUM_VERTICES]);
            add_indices(i * NUM_VERTICES, &mesh.indices[i * NUM_INDICES]);
        }
        struct scene_object *object = site_add(site, primitive, world);
        object->mesh = mesh;
        mesh_complete(&object->mesh, MESH_TANGENTS);
        add_primvars(site, primitive, num * NUM_VERTICES, object);
    }
    free(points.centres);
    free(points.widths);
}
