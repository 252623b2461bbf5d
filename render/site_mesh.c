// SPDX-License-Identifier: Apache-2.0
/* A site as one mesh: each object where it stands, with the parts that it has by itself. */
#include "render/site.h"

#include "program/limit.h"
#include "program/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Places ---- */

static void load(const float from[3], double to[3])
{
    for (size_t i = 0; i < 3; ++i)
        to[i] = (double)from[i];
}

static void store_unit(const double from[3], float to[3])
{
    double square = vector_dot(from, from);
    for (size_t i = 0; i < 3; ++i)
        to[i] = square > 0 ? (float)(from[i] / sqrt(square)) : 0;
}

static void place_vertex(struct vertex *vertex, struct matrix world)
{
    double position[3], normal[3], tangent[3];
    load(vertex->position, position);
    load(vertex->normal, normal);
    load(vertex->tangent, tangent);
    matrix_point(world, position, position);
    matrix_normal(world, normal, normal);
    matrix_direction(world, tangent, tangent);
    for (size_t i = 0; i < 3; ++i)
        vertex->position[i] = (float)position[i];
    store_unit(normal, vertex->normal);
    store_unit(tangent, vertex->tangent);
}

/* Copies an object behind others. Its indices count from its own first vertex. */
static void place_object(const struct scene_object *object, struct matrix world,
                         struct vertex *vertices, uint32_t *indices)
{
    const struct mesh *mesh = &object->mesh;
    bool is_mirrored = matrix_determinant(world) < 0;
    memcpy(vertices, mesh->vertices, mesh->num_vertices * sizeof *vertices);
    memcpy(indices, mesh->indices, mesh->num_indices * sizeof *indices);
    for (uint32_t v = 0; v < mesh->num_vertices; ++v)
        place_vertex(&vertices[v], world);
    for (uint32_t i = 0; is_mirrored && i + 2 < mesh->num_indices; i += 3) {
        uint32_t second = indices[i + 1];
        indices[i + 1] = indices[i + 2];
        indices[i + 2] = second;
    }
}

/* ---- Primvars ---- */

/* Values of an object, whose texture coordinates are its st; a primvar that it lacks is 0. */
static void copy_values(const struct scene_object *object, const struct primvar *to, uint32_t first)
{
    const struct primvar *from = object_primvar(object, to->name);
    bool is_texcoord = strcmp(to->name, "st") == 0;
    for (uint32_t v = 0; v < object->mesh.num_vertices; ++v) {
        if (from)
            memcpy(to->values[first + v], from->values[from->num == 1 ? 0 : v], sizeof *to->values);
        else if (is_texcoord)
            memcpy(to->values[first + v], object->mesh.vertices[v].texcoord, 2 * sizeof(float));
    }
}

static void add_primvar(struct scene_object *out, const struct primvar *like)
{
    static const char *const types[] = {NULL, "float", "float2", "float3", "float4"};
    struct primvar *added =
        object_add_primvar(out, like->name, types[like->components], like->components);
    added->is_integer = like->is_integer;
}

/* Adds the primvars that any of the objects has; texts have no values. */
static void join_primvars(const struct site *site, struct scene_object *out)
{
    uint32_t first = 0;
    for (uint32_t o = 0; o < site->num_objects; ++o) {
        const struct scene_object *object = &site->objects[o].object;
        for (uint32_t i = 0; i < object->num_primvars; ++i)
            if (object->primvars[i].components && !object_primvar(out, object->primvars[i].name))
                add_primvar(out, &object->primvars[i]);
    }
    for (uint32_t o = 0; o < site->num_objects; ++o) {
        const struct scene_object *object = &site->objects[o].object;
        for (uint32_t i = 0; i < out->num_primvars; ++i)
            copy_values(object, &out->primvars[i], first);
        first += object->mesh.num_vertices;
    }
}

/* ---- Joining ---- */

static bool fail(const struct site *site, const char *id, const char *why)
{
    report_error(site->report, id, "cannot use the mesh '%s': %s", site->file, why);
    return false;
}

/* Makes room for all vertices. false after an error: instances may be many. */
static bool allocate(const struct site *site, struct mesh *out)
{
    uint64_t vertices = 0, indices = 0, size = 0;
    for (uint32_t o = 0; o < site->num_objects; ++o) {
        const struct scene_object *object = &site->objects[o].object;
        vertices += object->mesh.num_vertices;
        indices += object->mesh.num_indices;
        size += object->mesh.num_vertices
                    * (sizeof *out->vertices + object->num_primvars * sizeof(float[4]))
                + object->mesh.num_indices * sizeof *out->indices;
    }
    if (size > limit_of_file(site->file_size) || vertices > UINT32_MAX || indices > UINT32_MAX)
        return fail(site, "bad-mesh", "it needs too much memory for its size");
    mesh_allocate(out, (uint32_t)vertices, (uint32_t)indices);
    return true;
}

/*
 * Places all objects, and fits them into the unit sphere. Texture coordinates that were made follow
 * the place and the size.
 */
static void join_meshes(const struct site *site, struct mesh *out)
{
    uint32_t vertex = 0, index = 0;
    struct matrix up = site_upright(site);
    for (uint32_t o = 0; o < site->num_objects; ++o) {
        const struct scene_object *object = &site->objects[o].object;
        place_object(object, matrix_multiply(up, object->world), out->vertices + vertex,
                     out->indices + index);
        vertex += object->mesh.num_vertices;
        index += object->mesh.num_indices;
    }
    mesh_fit(out);
    vertex = index = 0;
    for (uint32_t o = 0; o < site->num_objects; ++o) {
        const struct mesh *from = &site->objects[o].object.mesh;
        struct mesh part = {out->vertices + vertex, out->indices + index, from->num_vertices,
                            from->num_indices};
        if (site->objects[o].made & MESH_TEXCOORDS)
            mesh_project(&part);
        for (uint32_t i = 0; i < part.num_indices; ++i)
            part.indices[i] += vertex;
        vertex += part.num_vertices;
        index += part.num_indices;
    }
}

static bool join(const struct site *site, struct scene_object *out, struct mesh_parts *out_made)
{
    if (!allocate(site, &out->mesh))
        return false;
    join_meshes(site, &out->mesh);
    if (!(mesh_area(&out->mesh) > 1e-12))
        return fail(site, "empty-mesh", "its triangles have no area");
    out_made->all = ~0u;
    for (uint32_t o = 0; o < site->num_objects; ++o) {
        out_made->some |= site->objects[o].made;
        out_made->all &= site->objects[o].made;
    }
    join_primvars(site, out);
    return true;
}

bool site_open_mesh(struct cli *cli, const char *path, struct scene_object *out,
                    struct mesh_parts *out_made)
{
    struct site site;
    *out = (struct scene_object){0};
    *out_made = (struct mesh_parts){0};
    bool good = site_open(&site, cli, path, NULL) && join(&site, out, out_made);
    site_close(&site);
    return good;
}
