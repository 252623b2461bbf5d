// SPDX-License-Identifier: Apache-2.0
#include "render/bake_surface.h"

#include "program/args.h"
#include "program/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_V = 100 /* of tiles */, GRID = 1024 };

/* ---- The surface ---- */

static void make_square(struct scene *scene)
{
    static const uint32_t corners[] = {0, 1, 3, 0, 3, 2};
    *scene = (struct scene){.studio = matrix_identity(),
                            .view = matrix_identity(),
                            .projection = matrix_identity(),
                            .environment = matrix_identity(),
                            .layer_sample = -1,
                            .near = SCENE_NEAR};
    scene->object.world = matrix_identity();
    scene->object.path = "the unit square";
    scene->object.names_texcoords = true;
    mesh_allocate(&scene->object.mesh, 4, 6);
    memcpy(scene->object.mesh.indices, corners, sizeof corners);
    for (uint32_t i = 0; i < 4; ++i)
        scene->object.mesh.vertices[i] = (struct vertex){.normal = {0, 0, 1}, .tangent = {1, 0, 0}};
}

static bool has_texcoords(const struct scene_object *object)
{
    for (size_t i = 0; scene_texcoords[i]; ++i)
        if (scene_primvar(object, scene_texcoords[i]))
            return true;
    return false;
}

static void open_shape(struct bake_surface *surface, const char *name)
{
    surface->objects = memory_alloc(sizeof *surface->objects);
    surface->num_objects = 1;
    surface->objects[0] =
        (struct scene_object){.world = matrix_identity(), .path = name, .names_texcoords = true};
    shape_make(name, 1, &surface->objects[0].mesh);
}

static bool open_file(struct bake_surface *surface, struct cli *cli, const char *path)
{
    if (!site_open(&surface->site, cli, path, NULL))
        return false;
    surface->num_objects = surface->site.num_objects;
    surface->objects = memory_alloc((surface->num_objects + 1) * sizeof *surface->objects);
    for (uint32_t i = 0; i < surface->num_objects; ++i) {
        surface->objects[i] = surface->site.objects[i].object;
        surface->objects[i].names_texcoords = true;
        if (has_texcoords(&surface->objects[i]))
            continue;
        report_error(&cli->report, "no-texcoords",
                     "'%s' of '%s' has no texture coordinates, so its surface has no place in an "
                     "image",
                     surface->objects[i].path, path);
        return false;
    }
    if (!surface->num_objects)
        report_error(&cli->report, "empty-mesh", "cannot use the mesh '%s': it has no triangles",
                     path);
    return surface->num_objects > 0;
}

/* ---- Tiles ---- */

/* A triangle belongs to the tile of its centre. false: that is no tile. */
static bool add_tile_of(struct bake_surface *surface, const struct mesh *mesh, const uint32_t *at)
{
    double centre[2] = {0};
    for (size_t k = 0; k < 3; ++k)
        for (size_t c = 0; c < 2; ++c)
            centre[c] += (double)mesh->vertices[at[k]].texcoord[c] / 3;
    if (!(centre[0] >= 0 && centre[0] < 10 && centre[1] >= 0 && centre[1] < MAX_V))
        return false;
    bake_tiles_add(&surface->tiles, (struct bake_tile){(int32_t)centre[0], (int32_t)centre[1]});
    return true;
}

/* Twice the area of a triangle, above 0 where it turns to the left. */
static double turn(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static bool has_area(const struct mesh *mesh, const uint32_t *at)
{
    double corners[3][2];
    for (size_t k = 0; k < 3; ++k)
        for (size_t c = 0; c < 2; ++c)
            corners[k][c] = (double)mesh->vertices[at[k]].texcoord[c];
    return turn(corners[0], corners[1], corners[2]) != 0;
}

/* False after an error: no triangle has an area in texture coordinates. */
static bool tell_flat(const struct scene_object *object, struct report *report)
{
    const struct mesh *mesh = &object->mesh;
    uint32_t num = mesh->num_indices / 3, num_flat = 0;
    for (uint32_t i = 0; i < num; ++i)
        num_flat += !has_area(mesh, mesh->indices + 3 * i);
    if (num_flat == num)
        report_error(report, "no-texcoords",
                     "no triangle of '%s' has an area in texture coordinates, so its surface has "
                     "no place in an image",
                     object->path);
    else if (num_flat)
        report_warning(report, "bake-degenerate",
                       "%u of the %u triangles of '%s' have no area in texture coordinates, so no "
                       "texel has their values",
                       num_flat, num, object->path);
    return num_flat < num;
}

static bool find_tiles(struct bake_surface *surface, struct report *report)
{
    for (uint32_t o = 0; o < surface->num_objects; ++o) {
        const struct mesh *mesh = &surface->objects[o].mesh;
        if (!tell_flat(&surface->objects[o], report))
            return false;
        for (uint32_t i = 0; i + 2 < mesh->num_indices; i += 3)
            if (!add_tile_of(surface, mesh, mesh->indices + i)) {
                report_error(report, "no-texcoords",
                             "'%s' has triangles at texture coordinates below 0, or above 10 in u "
                             "or %d in v, where no tile is",
                             surface->objects[o].path, MAX_V);
                return false;
            }
    }
    return true;
}

/* No larger than the tiles: interpolation over a large square is less exact. */
void bake_surface_cover(struct bake_surface *surface, const struct bake_tiles *tiles)
{
    int32_t ends[2] = {1, 1};
    for (uint32_t i = 0; i < tiles->num; ++i) {
        ends[0] = tiles->items[i].u < ends[0] ? ends[0] : tiles->items[i].u + 1;
        ends[1] = tiles->items[i].v < ends[1] ? ends[1] : tiles->items[i].v + 1;
    }
    for (uint32_t i = 0; i < 4; ++i) {
        struct vertex *vertex = &surface->square.object.mesh.vertices[i];
        vertex->texcoord[0] = (float)((int32_t)(i % 2) * ends[0]);
        vertex->texcoord[1] = (float)((int32_t)(i / 2) * ends[1]);
        memcpy(vertex->position, vertex->texcoord, sizeof vertex->texcoord);
    }
}

bool bake_surface_open(struct bake_surface *surface, struct cli *cli, const char *mesh)
{
    *surface = (struct bake_surface){0};
    make_square(&surface->square);
    if (!mesh)
        return true;
    if (args_is_one_of(mesh, shape_names()))
        open_shape(surface, mesh);
    else if (!open_file(surface, cli, mesh))
        return false;
    return find_tiles(surface, &cli->report);
}

void bake_surface_close(struct bake_surface *surface)
{
    if (surface->objects && !surface->site.objects)
        object_finish(&surface->objects[0]);
    free(surface->objects);
    free(surface->tiles.items);
    site_close(&surface->site);
    scene_finish(&surface->square);
}

/* ---- Overlaps ---- */

/* Counts the points of the grid that lie inside a triangle, off its edges. */
static void cover(double at[3][2], uint32_t size, uint8_t *counts)
{
    const double slack = 1e-3, area = turn(at[0], at[1], at[2]);
    const double low[2] = {fmin(at[0][0], fmin(at[1][0], at[2][0])),
                           fmin(at[0][1], fmin(at[1][1], at[2][1]))},
                 high[2] = {fmax(at[0][0], fmax(at[1][0], at[2][0])),
                            fmax(at[0][1], fmax(at[1][1], at[2][1]))};
    for (uint32_t y = (uint32_t)fmax(low[1], 0); y < size && y <= high[1]; ++y)
        for (uint32_t x = (uint32_t)fmax(low[0], 0); area != 0 && x < size && x <= high[0]; ++x) {
            const double point[2] = {x + 0.5, y + 0.5};
            bool is_inside = true;
            for (size_t k = 0; k < 3; ++k)
                is_inside = is_inside && turn(at[k], at[(k + 1) % 3], point) / area > slack;
            counts[(size_t)y * size + x] |= is_inside ? counts[(size_t)y * size + x] ? 2 : 1 : 0;
        }
}

double bake_surface_overlap(const struct bake_surface *surface, struct bake_tile tile,
                            uint32_t size)
{
    size = size < GRID ? size : GRID;
    size_t covered = 0, twice = 0, num = (size_t)size * size;
    uint8_t *counts = memory_alloc(num);
    for (uint32_t o = 0; o < surface->num_objects; ++o) {
        const struct mesh *mesh = &surface->objects[o].mesh;
        for (uint32_t i = 0; i + 2 < mesh->num_indices; i += 3) {
            double at[3][2];
            for (size_t k = 0; k < 3; ++k) {
                const float *place = mesh->vertices[mesh->indices[i + k]].texcoord;
                at[k][0] = ((double)place[0] - tile.u) * size;
                at[k][1] = ((double)place[1] - tile.v) * size;
            }
            cover(at, size, counts);
        }
    }
    for (size_t i = 0; i < num; ++i) {
        covered += counts[i] > 0;
        twice += counts[i] > 1;
    }
    free(counts);
    return covered ? (double)twice / (double)covered : 0;
}

struct matrix bake_surface_view(struct bake_tile tile, uint32_t size, uint32_t x, uint32_t y,
                                uint32_t width, uint32_t height)
{
    const double scale[2] = {2.0 * size / width, 2.0 * size / height},
                 left = tile.u + (double)x / size, top = tile.v + 1 - (double)y / size;
    return (struct matrix){{{scale[0], 0, 0, 0},
                            {0, scale[1], 0, 0},
                            {0, 0, 0, 0},
                            {-1 - left * scale[0], 1 - top * scale[1], 0.5, 1}}};
}
