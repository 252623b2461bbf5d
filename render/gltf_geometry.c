// SPDX-License-Identifier: Apache-2.0
#include "render/gltf_geometry.h"

#include "import/gltf_accessor.h"
#include "program/memory.h"
#include "render/import_primvars.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_SETS = 8, MAX_VERTICES = 3 << 26, TRIANGLES = 4, STRIP = 5, FAN = 6 };

/* A primitive while it is read. */
struct reading {
    struct gltf_source *source;
    const struct gltf_shape *shape;
    const json_t *attributes, *targets;
    size_t num_vertices; /* in the file */
    uint32_t *used;      /* the vertices of the file that triangles use */
    uint32_t num_used;
    struct scene_object *object;
};

/* Numbers of each vertex that is used. */
struct numbers {
    float (*values)[4];
    unsigned width; /* 0: there are none */
};

/* ---- Triangles ---- */

static uint64_t mode_of(const json_t *primitive)
{
    return json_object_get(primitive, "mode") ? json_count_of(primitive, "mode") : TRIANGLES;
}

bool gltf_geometry_has_triangles(const json_t *primitive)
{
    uint64_t mode = mode_of(primitive);
    return mode == TRIANGLES || mode == STRIP || mode == FAN;
}

/* Corner k of triangle i as a number in the list of indices (glTF 2.0, 3.7.2.1). */
static size_t corner_of(uint64_t mode, size_t i, size_t k)
{
    static const size_t of_even[] = {0, 1, 2}, of_odd[] = {0, 2, 1};
    if (mode == TRIANGLES)
        return 3 * i + k;
    if (mode == STRIP)
        return i + (i % 2 ? of_odd : of_even)[k];
    return k == 2 ? 0 : i + 1 + k;
}

/* The number of a vertex in the mesh, which is new where no triangle before has it. */
static uint32_t number_of(struct reading *in, struct gltf_numbering *numbering, size_t vertex)
{
    struct gltf_number *number = &numbering->items[vertex];
    if (number->shape != numbering->num_shapes) {
        *number = (struct gltf_number){numbering->num_shapes, in->num_used};
        in->used[in->num_used++] = (uint32_t)vertex;
    }
    return number->vertex;
}

static void make_room(struct gltf_numbering *numbering, size_t num)
{
    if (num > numbering->capacity) {
        numbering->items = memory_resize(numbering->items, num * sizeof *numbering->items);
        memset(numbering->items + numbering->capacity, 0,
               (num - numbering->capacity) * sizeof *numbering->items);
        numbering->capacity = num;
    }
    ++numbering->num_shapes;
}

/* Corners as numbers of vertices of the mesh; `indices` NULL: they count up. */
static bool read_corners(struct reading *in, struct gltf_numbering *numbering,
                         const struct gltf_accessor *indices, size_t num_triangles, uint32_t *out)
{
    uint64_t mode = mode_of(in->shape->primitive);
    for (size_t i = 0; i < num_triangles; ++i)
        for (size_t k = 0; k < 3; ++k) {
            double number[GLTF_MAX_WIDTH];
            size_t corner = corner_of(mode, i, k);
            if (indices) {
                gltf_accessor_read(indices, corner, number);
                if (number[0] >= (double)in->num_vertices)
                    return gltf_source_fail(in->source,
                                            "element %zu of accessors[%zu] is the index %.0f; the "
                                            "primitive has %zu vertices",
                                            corner, indices->index, number[0], in->num_vertices);
                corner = (size_t)number[0];
            }
            *out++ = number_of(in, numbering, corner);
        }
    return true;
}

static bool read_triangles(struct reading *in, struct gltf_numbering *numbering)
{
    struct gltf_accessor indices;
    size_t index = gltf_index_of(in->shape->primitive, "indices"), count = in->num_vertices;
    bool has_indices = index != SIZE_MAX;
    if (has_indices && !gltf_accessor_open(in->source, index, 1, 1, &indices))
        return false;
    if (has_indices && !gltf_accessor_has_counts(&indices))
        return gltf_source_fail(in->source, "accessors[%zu] has no unsigned integers as indices",
                                index);
    count = has_indices ? indices.count : count;
    size_t num = mode_of(in->shape->primitive) == TRIANGLES ? count / 3
                 : count < 3                                ? 0
                                                            : count - 2,
           num_used = 3 * num < in->num_vertices ? 3 * num : in->num_vertices;
    if (num > MAX_VERTICES / 3)
        return gltf_source_fail(in->source, "a primitive has %zu triangles; the limit is %d", num,
                                MAX_VERTICES / 3);
    struct mesh *mesh = &in->object->mesh;
    if (!num || !gltf_source_spend(in->source, num * 3 * sizeof *mesh->indices))
        return num == 0;
    make_room(numbering, in->num_vertices);
    mesh->indices = memory_alloc(num * 3 * sizeof *mesh->indices);
    in->used = memory_alloc(num_used * sizeof *in->used);
    mesh->num_indices = (uint32_t)(3 * num);
    return read_corners(in, numbering, has_indices ? &indices : NULL, num, mesh->indices);
}

/* ---- Attributes ---- */

/* Opens an accessor with an element for each vertex. false after a fault. */
static bool open_attribute(struct reading *in, size_t index, unsigned least, unsigned most,
                           struct gltf_accessor *out)
{
    if (!gltf_accessor_open(in->source, index, least, most, out)
        || !gltf_source_spend(in->source, in->num_used * sizeof(float[4])))
        return false;
    if (out->count != in->num_vertices)
        return gltf_source_fail(in->source,
                                "accessors[%zu] has %zu elements; its primitive has %zu vertices",
                                index, out->count, in->num_vertices);
    return true;
}

/* Adds the differences of a morph target times its weight. */
static bool add_target(struct reading *in, const json_t *target, const char *name, double weight,
                       struct numbers *out)
{
    struct gltf_accessor accessor;
    size_t index = gltf_index_of(target, name);
    unsigned most = out->width;
    if (index == SIZE_MAX || weight == 0)
        return true;
    /* the sign of a tangent does not change */
    if (!open_attribute(in, index, most == 4 ? 3 : most, most, &accessor))
        return false;
    for (uint32_t i = 0; i < in->num_used; ++i) {
        float change[GLTF_MAX_WIDTH];
        if (!gltf_accessor_floats(in->source, &accessor, in->used[i], change))
            return false;
        for (unsigned k = 0; k < accessor.width; ++k)
            out->values[i][k] += (float)(weight * (double)change[k]);
    }
    return true;
}

/* Reads an attribute if the primitive has it, as its targets change it. false after a fault. */
static bool read_attribute(struct reading *in, const char *name, unsigned least, unsigned most,
                           struct numbers *out)
{
    struct gltf_accessor accessor;
    size_t index = gltf_index_of(in->attributes, name);
    *out = (struct numbers){0};
    if (index == SIZE_MAX)
        return true;
    if (!open_attribute(in, index, least, most, &accessor))
        return false;
    out->width = accessor.width;
    out->values = memory_alloc(in->num_used * sizeof *out->values + 1);
    for (uint32_t i = 0; i < in->num_used; ++i) {
        float numbers[GLTF_MAX_WIDTH];
        if (!gltf_accessor_floats(in->source, &accessor, in->used[i], numbers))
            return false;
        memcpy(out->values[i], numbers, accessor.width * sizeof *numbers);
    }
    for (size_t t = 0; t < json_array_size(in->shape->weights); ++t) {
        double weight = json_number_value(json_array_get(in->shape->weights, t));
        if (!add_target(in, json_array_get(in->targets, t), name, weight, out))
            return false;
    }
    return true;
}

/* Copies three numbers of each vertex to a member of its struct. Frees them. */
static void copy_numbers(struct reading *in, struct numbers *from, size_t offset)
{
    for (uint32_t i = 0; from->width && i < in->num_used; ++i)
        memcpy((char *)&in->object->mesh.vertices[i] + offset, from->values[i], 3 * sizeof(float));
    free(from->values);
}

static bool read_vertices(struct reading *in, unsigned *out_made)
{
    struct numbers positions, normals = {0}, tangents = {0};
    bool good = read_attribute(in, "POSITION", 3, 3, &positions)
                && read_attribute(in, "NORMAL", 3, 3, &normals)
                && read_attribute(in, "TANGENT", 4, 4, &tangents);
    /* glTF 2.0, 3.7.2.1: tangents without normals do not count */
    *out_made |= normals.width ? 0 : MESH_NORMALS;
    *out_made |= normals.width && tangents.width ? 0 : MESH_TANGENTS;
    copy_numbers(in, &positions, offsetof(struct vertex, position));
    copy_numbers(in, &normals, offsetof(struct vertex, normal));
    copy_numbers(in, &tangents, offsetof(struct vertex, tangent));
    return good;
}

/* v counts from the top of an image. */
static void add_texcoords(struct reading *in, unsigned set, const struct numbers *from)
{
    float(*values)[4] = import_add_primvar(in->object, IMPORT_TEXCOORDS, set);
    for (uint32_t i = 0; i < in->num_used; ++i) {
        values[i][0] = from->values[i][0];
        values[i][1] = 1 - from->values[i][1];
        if (set == 0)
            memcpy(in->object->mesh.vertices[i].texcoord, values[i], 2 * sizeof(float));
    }
}

/* glTF 2.0, 3.7.2.1: colours of three components have the alpha 1. */
static void add_colors(struct reading *in, unsigned set, const struct numbers *from)
{
    float(*values)[4] = import_add_primvar(in->object, IMPORT_COLORS, set);
    for (uint32_t i = 0; i < in->num_used; ++i) {
        memcpy(values[i], from->values[i], sizeof *values);
        if (from->width == 3)
            values[i][3] = 1;
    }
}

static bool read_primvars(struct reading *in, unsigned *out_made)
{
    bool good = true;
    *out_made |= MESH_TEXCOORDS;
    for (unsigned set = 0; good && set < MAX_SETS; ++set) {
        char name[32];
        struct numbers numbers;
        snprintf(name, sizeof name, "TEXCOORD_%u", set);
        good = read_attribute(in, name, 2, 2, &numbers);
        if (good && numbers.width)
            add_texcoords(in, set, &numbers);
        if (good && numbers.width && set == 0)
            *out_made &= ~(unsigned)MESH_TEXCOORDS;
        free(numbers.values);
        if (!good)
            break;
        snprintf(name, sizeof name, "COLOR_%u", set);
        good = read_attribute(in, name, 3, 4, &numbers);
        if (good && numbers.width)
            add_colors(in, set, &numbers);
        free(numbers.values);
    }
    *out_made |= *out_made & MESH_TEXCOORDS ? MESH_TANGENTS : 0;
    return good;
}

/* ---- Skins ---- */

/* Joints and weights of up to four joints of a vertex. */
struct influences {
    struct gltf_accessor joints, weights;
};

/* False after a fault, or where the primitive has no such set. */
static bool open_influences(struct reading *in, unsigned set, struct influences *out)
{
    char joints[32], weights[32];
    snprintf(joints, sizeof joints, "JOINTS_%u", set);
    snprintf(weights, sizeof weights, "WEIGHTS_%u", set);
    size_t of_joints = gltf_index_of(in->attributes, joints),
           of_weights = gltf_index_of(in->attributes, weights);
    if (of_joints == SIZE_MAX || of_weights == SIZE_MAX)
        return set == 0
               && gltf_source_fail(in->source,
                                   "a node has a skin, and a primitive of its mesh has no JOINTS_0 "
                                   "and WEIGHTS_0");
    return open_attribute(in, of_joints, 4, 4, &out->joints)
           && open_attribute(in, of_weights, 4, 4, &out->weights);
}

/* Adds the matrices of one set; *total are the weights. false after a fault. */
static bool add_joints(struct reading *in, const struct influences *set, size_t vertex,
                       struct matrix *sum, double *total)
{
    double joints[GLTF_MAX_WIDTH];
    float weights[GLTF_MAX_WIDTH];
    const struct gltf_skin *skin = in->shape->skin;
    gltf_accessor_read(&set->joints, vertex, joints);
    if (!gltf_accessor_floats(in->source, &set->weights, vertex, weights))
        return false;
    for (size_t k = 0; k < 4; ++k) {
        double weight = (double)weights[k];
        if (weight == 0)
            continue;
        if (!(joints[k] >= 0 && joints[k] < (double)skin->num_joints))
            return gltf_source_fail(in->source,
                                    "element %zu of accessors[%zu] is the joint %g; the skin has "
                                    "%zu joints",
                                    vertex, set->joints.index, joints[k], skin->num_joints);
        const struct matrix *joint = &skin->joints[(size_t)joints[k]];
        for (size_t i = 0; i < 16; ++i)
            sum->m[i / 4][i % 4] += weight * joint->m[i / 4][i % 4];
        *total += weight;
    }
    return true;
}

static void store(const double from[3], float to[3])
{
    for (size_t i = 0; i < 3; ++i)
        to[i] = (float)from[i];
}

static void move_vertex(struct vertex *vertex, struct matrix sum, double total)
{
    double position[3], normal[3], tangent[3];
    for (size_t i = 0; i < 3; ++i) {
        position[i] = (double)vertex->position[i];
        normal[i] = (double)vertex->normal[i];
        tangent[i] = (double)vertex->tangent[i];
    }
    matrix_point(sum, position, position);
    for (size_t i = 0; i < 3; ++i)
        position[i] /= total;
    matrix_normal(sum, normal, normal);
    matrix_direction(sum, tangent, tangent);
    store(position, vertex->position);
    store(normal, vertex->normal);
    store(tangent, vertex->tangent);
}

/* Moves the vertices by the joints of a skin: Σ w M p, glTF 2.0, 3.7.3.3. */
static bool apply_skin(struct reading *in)
{
    struct influences sets[MAX_SETS];
    unsigned num_sets = 0;
    *in->source->fault = '\0';
    while (num_sets < MAX_SETS && open_influences(in, num_sets, &sets[num_sets]))
        ++num_sets;
    if (*in->source->fault)
        return false;
    for (uint32_t i = 0; i < in->num_used; ++i) {
        struct matrix sum = {0};
        double total = 0;
        for (unsigned s = 0; s < num_sets; ++s)
            if (!add_joints(in, &sets[s], in->used[i], &sum, &total))
                return false;
        if (total > 0)
            move_vertex(&in->object->mesh.vertices[i], sum, total);
    }
    return true;
}

/* ---- All ---- */

/* Targets and joints change the lengths of directions. False: a number is not finite. */
static bool finish_vertices(struct reading *in)
{
    for (uint32_t i = 0; i < in->num_used; ++i) {
        struct vertex *vertex = &in->object->mesh.vertices[i];
        float *directions[] = {vertex->normal, vertex->tangent};
        for (size_t d = 0; d < 2; ++d) {
            double v[3] = {(double)directions[d][0], (double)directions[d][1],
                           (double)directions[d][2]};
            double square = vector_dot(v, v);
            for (size_t k = 0; square > 0 && k < 3; ++k)
                directions[d][k] = (float)(v[k] / sqrt(square));
        }
        for (size_t k = 0; k < 3; ++k)
            if (!isfinite(vertex->position[k]))
                return gltf_source_fail(in->source,
                                        "a primitive has corners with numbers that are NaN or "
                                        "infinite");
    }
    return true;
}

static bool read_object(struct reading *in, struct gltf_numbering *numbering, unsigned *out_made)
{
    struct mesh *mesh = &in->object->mesh;
    if (!read_triangles(in, numbering))
        return false;
    if (!mesh->num_indices)
        return true;
    /* what is made has a vertex for each corner */
    if (!gltf_source_spend(in->source, (uint64_t)mesh->num_indices * sizeof *mesh->vertices))
        return false;
    mesh->vertices = memory_alloc(in->num_used * sizeof *mesh->vertices);
    mesh->num_vertices = in->num_used;
    if (!read_vertices(in, out_made) || !read_primvars(in, out_made)
        || (in->shape->skin && !apply_skin(in)) || !finish_vertices(in))
        return false;
    object_complete(in->object, *out_made, *out_made & MESH_NORMALS);
    return true;
}

bool gltf_geometry_read(struct gltf_source *source, const struct gltf_shape *shape,
                        struct gltf_numbering *numbering, struct scene_object *object,
                        unsigned *out_made)
{
    struct reading in = {.source = source,
                         .shape = shape,
                         .attributes = json_object_get(shape->primitive, "attributes"),
                         .targets = json_object_get(shape->primitive, "targets"),
                         .object = object};
    size_t positions = gltf_index_of(in.attributes, "POSITION");
    struct gltf_accessor accessor;
    *out_made = 0;
    if (positions == SIZE_MAX || !gltf_geometry_has_triangles(shape->primitive))
        return true;
    if (!gltf_accessor_open(source, positions, 3, 3, &accessor))
        return false;
    if (accessor.count > MAX_VERTICES)
        return gltf_source_fail(source, "accessors[%zu] has %zu vertices; the limit is %d",
                                positions, accessor.count, MAX_VERTICES);
    in.num_vertices = accessor.count;
    bool good = read_object(&in, numbering, out_made);
    free(in.used);
    return good;
}
