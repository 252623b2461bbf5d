// SPDX-License-Identifier: Apache-2.0
/*
 * Meshes of USD (UsdGeomMesh) as triangles. Faces become fans. A subdivision surface is drawn as
 * its cage with smooth normals.
 */
#include "render/site.h"

#include "program/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NO_SUBSET = 0, HOLE = -1, MAX_CORNERS = 1 << 27 };

struct usd_mesh {
    struct site *site;
    uint32_t primitive;
    double *points, *counts, *indices, *normals;
    size_t num_points, num_faces, num_corners, num_normals; /* points and normals: of three */
    char normals_of;  /* 'c'orner, 'f'ace, 'p'oint or 'w'hole mesh; 0: none */
    int32_t *subsets; /* by face: 1 + number of a subset, NO_SUBSET, or HOLE */
    bool is_flipped, is_flat;
};

/* ---- Reading ---- */

static bool fail_counts(struct usd_mesh *mesh)
{
    size_t corners = 0;
    for (size_t f = 0; f < mesh->num_faces; ++f) {
        if (!(mesh->counts[f] >= 0) || mesh->counts[f] > MAX_CORNERS)
            corners = SIZE_MAX / 2;
        else
            corners += (size_t)mesh->counts[f];
    }
    if (corners == mesh->num_corners)
        return false;
    site_fail(mesh->site, mesh->primitive, "faceVertexIndices",
              "has %zu numbers; faceVertexCounts asks for another number", mesh->num_corners);
    return true;
}

static bool fail_indices(struct usd_mesh *mesh)
{
    for (size_t i = 0; i < mesh->num_corners; ++i)
        if (!(mesh->indices[i] >= 0) || mesh->indices[i] >= (double)mesh->num_points) {
            site_fail(mesh->site, mesh->primitive, "faceVertexIndices",
                      "has %g as number %zu; there are %zu points", mesh->indices[i], i,
                      mesh->num_points);
            return true;
        }
    for (size_t i = 0; i < 3 * mesh->num_points; ++i)
        if (!isfinite(mesh->points[i])) {
            site_fail(mesh->site, mesh->primitive, "points",
                      "has numbers that are NaN or infinite");
            return true;
        }
    return false;
}

/* Normals with indices become one for each index. False: an index has no normal. */
static bool expand_normals(struct usd_mesh *mesh, const char *name)
{
    size_t num_indices;
    char *indices_name = cli_format("%s:indices", name);
    double *indices = usd_numbers(mesh->site, mesh->primitive, indices_name, &num_indices);
    free(indices_name);
    if (!indices)
        return true;
    double *expanded = memory_alloc(num_indices * 3 * sizeof *expanded + 1);
    bool good = true;
    for (size_t i = 0; good && i < num_indices; ++i) {
        good = indices[i] >= 0 && indices[i] < (double)mesh->num_normals;
        if (good)
            memcpy(&expanded[3 * i], &mesh->normals[3 * (size_t)indices[i]], 3 * sizeof *expanded);
    }
    free(indices);
    free(mesh->normals);
    mesh->normals = expanded;
    mesh->num_normals = num_indices;
    return good;
}

/* Notes whose normals they are, and how many are needed. */
static size_t place_normals(struct usd_mesh *mesh, const mxg_property *property, bool is_primvar)
{
    const char *of = usd_interpolation(property, is_primvar ? "constant" : "vertex");
    const char letter = !of                              ? 'p'
                        : strcmp(of, "faceVarying") == 0 ? 'c'
                        : strcmp(of, "uniform") == 0     ? 'f'
                        : strcmp(of, "constant") == 0    ? 'w'
                                                         : 'p';
    mesh->normals_of = letter;
    return letter == 'c'   ? mesh->num_corners
           : letter == 'f' ? mesh->num_faces
           : letter == 'w' ? 1
                           : mesh->num_points;
}

static void read_normals(struct usd_mesh *mesh)
{
    struct site *site = mesh->site;
    const char *name = "primvars:normals";
    mxg_property property = {sizeof property};
    uint32_t index = mxg_scene_find_property(site->scene, mesh->primitive, name);
    if (index == MXG_NONE) {
        name = "normals";
        index = mxg_scene_find_property(site->scene, mesh->primitive, name);
    }
    if (mxg_scene_property(site->scene, mesh->primitive, index, &property) != MXG_OK)
        return;
    mesh->normals = usd_numbers(site, mesh->primitive, name, &mesh->num_normals);
    mesh->num_normals /= 3;
    if (!expand_normals(mesh, name)) {
        site_fail(site, mesh->primitive, name, "has an index without a value");
        return;
    }
    size_t needed = place_normals(mesh, &property, strcmp(name, "normals") != 0);
    if (mesh->num_normals >= needed)
        return;
    if (mesh->num_normals)
        site_fail(site, mesh->primitive, name, "has %zu values; expected %zu", mesh->num_normals,
                  needed);
    mesh->normals_of = 0;
}

static bool read_mesh(struct usd_mesh *mesh)
{
    struct site *site = mesh->site;
    mesh->points = usd_numbers(site, mesh->primitive, "points", &mesh->num_points);
    mesh->counts = usd_numbers(site, mesh->primitive, "faceVertexCounts", &mesh->num_faces);
    mesh->indices = usd_numbers(site, mesh->primitive, "faceVertexIndices", &mesh->num_corners);
    mesh->num_points /= 3;
    mesh->is_flipped = usd_is(site, mesh->primitive, "orientation", "leftHanded");
    mesh->is_flat = usd_is(site, mesh->primitive, "subdivisionScheme", "none");
    if (!mesh->points || !mesh->counts || !mesh->indices || fail_counts(mesh) || fail_indices(mesh))
        return false;
    read_normals(mesh);
    return true;
}

/* ---- Normals ---- */

static const double *point(const struct usd_mesh *mesh, size_t corner)
{
    return &mesh->points[3 * (size_t)mesh->indices[corner]];
}

/* Newell's method: the sum over the edges; its length is twice the area. */
static void face_normal(const struct usd_mesh *mesh, size_t first, size_t count, double out[3])
{
    memset(out, 0, 3 * sizeof *out);
    for (size_t i = 0; i < count; ++i) {
        const double *a = point(mesh, first + i), *b = point(mesh, first + (i + 1) % count);
        for (size_t k = 0; k < 3; ++k) {
            size_t u = (k + 1) % 3, v = (k + 2) % 3;
            out[k] += (a[u] - b[u]) * (a[v] + b[v]);
        }
    }
    for (size_t k = 0; k < 3 && mesh->is_flipped; ++k)
        out[k] = -out[k];
}

/* Normals where the file has none: of faces, or smooth ones of points. */
static void make_normals(struct usd_mesh *mesh)
{
    free(mesh->normals);
    mesh->normals_of = mesh->is_flat ? 'f' : 'p';
    mesh->num_normals = mesh->is_flat ? mesh->num_faces : mesh->num_points;
    mesh->normals = memory_alloc(3 * mesh->num_normals * sizeof *mesh->normals + 1);
    size_t first = 0;
    for (size_t f = 0; f < mesh->num_faces; ++f) {
        size_t count = (size_t)mesh->counts[f];
        double normal[3];
        face_normal(mesh, first, count, normal);
        for (size_t i = 0; i < (mesh->is_flat ? 1 : count); ++i) {
            size_t at = mesh->is_flat ? f : (size_t)mesh->indices[first + i];
            for (size_t k = 0; k < 3; ++k)
                mesh->normals[3 * at + k] += normal[k];
        }
        first += count;
    }
}

/* ---- Triangles ---- */

/* The corners of an object's triangles. */
struct corner_list {
    uint32_t *faces, *points, *numbers;
    uint32_t count;
};

static void add_corner(const struct usd_mesh *mesh, struct corner_list *list, size_t face,
                       size_t corner)
{
    list->faces[list->count] = (uint32_t)face;
    list->numbers[list->count] = (uint32_t)corner;
    list->points[list->count++] = (uint32_t)mesh->indices[corner];
}

/* The triangles of the faces in a subset. */
static void add_faces(const struct usd_mesh *mesh, int32_t subset, struct corner_list *list)
{
    size_t room = 3 * mesh->num_corners + 1, first = 0;
    list->faces = memory_alloc(room * sizeof *list->faces);
    list->points = memory_alloc(room * sizeof *list->points);
    list->numbers = memory_alloc(room * sizeof *list->numbers);
    for (size_t f = 0; f < mesh->num_faces; first += (size_t)mesh->counts[f++])
        for (size_t i = 1; mesh->subsets[f] == subset && i + 1 < (size_t)mesh->counts[f]; ++i) {
            add_corner(mesh, list, f, first);
            add_corner(mesh, list, f, first + i + (mesh->is_flipped ? 1 : 0));
            add_corner(mesh, list, f, first + i + (mesh->is_flipped ? 0 : 1));
        }
}

static void fill_vertex(const struct usd_mesh *mesh, const struct corner_list *list, uint32_t i,
                        struct vertex *out)
{
    size_t at = mesh->normals_of == 'c'   ? list->numbers[i]
                : mesh->normals_of == 'f' ? list->faces[i]
                : mesh->normals_of == 'w' ? 0
                                          : list->points[i];
    double normal[3];
    memcpy(normal, &mesh->normals[3 * at], sizeof normal);
    vector_normalize(normal);
    for (size_t k = 0; k < 3; ++k) {
        out->position[k] = (float)mesh->points[3 * (size_t)list->points[i] + k];
        out->normal[k] = isfinite(normal[k]) ? (float)normal[k] : k == 1;
    }
}

/* Texture coordinates are the primvar st, or the first of this kind. */
static const struct primvar *find_texcoords(const struct scene_object *object)
{
    const struct primvar *found = NULL;
    for (uint32_t i = 0; i < object->num_primvars; ++i) {
        const struct primvar *primvar = &object->primvars[i];
        if (primvar->num == 1 || primvar->components != 2)
            continue;
        if (strcmp(primvar->name, "st") == 0)
            return primvar;
        found = found ? found : primvar;
    }
    return found;
}

static void add_object(struct usd_mesh *mesh, int32_t subset, uint32_t primitive,
                       struct matrix world)
{
    struct corner_list list = {0};
    add_faces(mesh, subset, &list);
    if (list.count && site_has_room(mesh->site, primitive, list.count / 3)) {
        struct scene_object *object = site_add(mesh->site, primitive, world);
        const struct usd_corners corners = {list.count, list.faces, list.points, list.numbers};
        mesh_allocate(&object->mesh, list.count, list.count);
        for (uint32_t i = 0; i < list.count; ++i) {
            fill_vertex(mesh, &list, i, &object->mesh.vertices[i]);
            object->mesh.indices[i] = i;
        }
        usd_add_primvars(mesh->site, mesh->primitive, &corners, object);
        const struct primvar *texcoords = find_texcoords(object);
        for (uint32_t i = 0; texcoords && i < list.count; ++i)
            memcpy(object->mesh.vertices[i].texcoord, texcoords->values[i], 2 * sizeof(float));
        unsigned made = MESH_TANGENTS | (texcoords ? 0u : MESH_TEXCOORDS);
        mesh_complete(&object->mesh, made);
        mesh->site->objects[mesh->site->num_objects - 1].made = made;
    }
    free(list.faces);
    free(list.points);
    free(list.numbers);
}

/* Marks the faces that a property lists. */
static void mark_faces(struct usd_mesh *mesh, uint32_t primitive, const char *property,
                       int32_t mark)
{
    size_t count;
    double *faces = usd_numbers(mesh->site, primitive, property, &count);
    for (size_t i = 0; i < count; ++i) {
        if (!(faces[i] >= 0) || faces[i] >= (double)mesh->num_faces) {
            site_fail(mesh->site, primitive, property, "has %g; the mesh has %zu faces", faces[i],
                      mesh->num_faces);
            break;
        }
        mesh->subsets[(size_t)faces[i]] = mark;
    }
    free(faces);
}

/* Calls for each subset of the mesh; returns their number. */
static uint32_t each_subset(struct usd_mesh *mesh, struct matrix world, bool draws)
{
    mxg_primitive at = {sizeof at};
    uint32_t number = 0;
    mxg_scene_primitive(mesh->site->scene, mesh->primitive, &at);
    for (uint32_t child = at.first_child; child != UINT32_MAX; child = at.next_sibling) {
        mxg_scene_primitive(mesh->site->scene, child, &at);
        if (at.type_len != strlen("GeomSubset") || memcmp(at.type, "GeomSubset", at.type_len) != 0)
            continue;
        ++number;
        if (draws)
            add_object(mesh, (int32_t)number, child, world);
        else
            mark_faces(mesh, child, "indices", (int32_t)number);
    }
    return number;
}

void usd_add_mesh(struct site *site, uint32_t primitive, struct matrix world)
{
    struct usd_mesh mesh = {.site = site, .primitive = primitive};
    if (read_mesh(&mesh)) {
        mesh.subsets = memory_alloc(mesh.num_faces * sizeof *mesh.subsets + 1);
        if (!mesh.normals_of)
            make_normals(&mesh);
        each_subset(&mesh, world, false);
        if (!mesh.is_flat) /* polygons have no holes */
            mark_faces(&mesh, primitive, "holeIndices", HOLE);
        add_object(&mesh, NO_SUBSET, primitive, world);
        each_subset(&mesh, world, true);
    }
    free(mesh.points);
    free(mesh.counts);
    free(mesh.indices);
    free(mesh.normals);
    free(mesh.subsets);
}
