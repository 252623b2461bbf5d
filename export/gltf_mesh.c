// SPDX-License-Identifier: Apache-2.0
/*
 * Geometry: the objects of the surface once, and a node with them for each material. glTF counts v
 * from the top of an image.
 */
#include "export/gltf.h"

#include "program/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FLOATS = 5126, UINTS = 5125, VERTICES = 34962, TRIANGLES = 34963 };

/* The ends of the surface along x. */
struct extent {
    float low, high;
};

/* Accessors of an object. */
struct accessors {
    size_t position, normal, tangent, texcoord, indices;
};

static json_t *numbers(const float *values, size_t num)
{
    json_t *array = json_array();
    for (size_t i = 0; i < num; ++i)
        json_array_append_new(array, json_real((double)values[i]));
    return array;
}

/* Appends rows of `width` floats as an accessor. */
static size_t add_floats(struct gltf *gltf, const float *values, size_t num, size_t width,
                         json_t *accessor)
{
    static const char *const types[] = {NULL, "SCALAR", "VEC2", "VEC3", "VEC4"};
    size_t view = gltf_add_view(gltf, values, num * width * sizeof *values, VERTICES);
    json_set(accessor, "bufferView", json_integer((json_int_t)view));
    json_set(accessor, "componentType", json_integer(FLOATS));
    json_set(accessor, "count", json_integer((json_int_t)num));
    json_set(accessor, "type", json_string(types[width]));
    return gltf_append(gltf_array(gltf->root, "accessors"), accessor);
}

static size_t add_positions(struct gltf *gltf, const struct scene_object *object,
                            struct matrix world, float *buffer, struct extent *extent)
{
    const struct mesh *mesh = &object->mesh;
    float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t i = 0; i < mesh->num_vertices; ++i) {
        const float *at = mesh->vertices[i].position;
        double point[3] = {(double)at[0], (double)at[1], (double)at[2]};
        matrix_point(world, point, point);
        for (size_t k = 0; k < 3; ++k) {
            buffer[i * 3 + k] = (float)point[k];
            low[k] = fminf(low[k], buffer[i * 3 + k]);
            high[k] = fmaxf(high[k], buffer[i * 3 + k]);
        }
    }
    extent->low = fminf(extent->low, low[0]);
    extent->high = fmaxf(extent->high, high[0]);
    json_t *accessor = json_object();
    json_set(accessor, "min", numbers(low, 3));
    json_set(accessor, "max", numbers(high, 3));
    return add_floats(gltf, buffer, mesh->num_vertices, 3, accessor);
}

/* A unit direction in the world; `otherwise` for one of no length. */
static void turn(struct matrix world, const float from[3], const double otherwise[3], float out[3])
{
    double v[3] = {(double)from[0], (double)from[1], (double)from[2]};
    matrix_direction(world, v, v);
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (size_t k = 0; k < 3; ++k)
        out[k] = (float)(length > 1e-20 ? v[k] / length : otherwise[k]);
}

static size_t add_normals(struct gltf *gltf, const struct scene_object *object, struct matrix world,
                          float *buffer)
{
    const double up[3] = {0, 0, 1};
    world = matrix_transpose(matrix_inverse(world));
    for (uint32_t i = 0; i < object->mesh.num_vertices; ++i)
        turn(world, object->mesh.vertices[i].normal, up, buffer + (size_t)i * 3);
    return add_floats(gltf, buffer, object->mesh.num_vertices, 3, json_object());
}

/* Their bitangent is the one of pictures: normal x tangent. */
static size_t add_tangents(struct gltf *gltf, const struct scene_object *object,
                           struct matrix world, float *buffer)
{
    const double right[3] = {1, 0, 0};
    for (uint32_t i = 0; i < object->mesh.num_vertices; ++i) {
        turn(world, object->mesh.vertices[i].tangent, right, buffer + (size_t)i * 4);
        buffer[(size_t)i * 4 + 3] = 1;
    }
    return add_floats(gltf, buffer, object->mesh.num_vertices, 4, json_object());
}

static size_t add_texcoords(struct gltf *gltf, const struct scene_object *object, float *buffer)
{
    for (uint32_t i = 0; i < object->mesh.num_vertices; ++i) {
        buffer[i * 2] = object->mesh.vertices[i].texcoord[0];
        buffer[i * 2 + 1] = 1 - object->mesh.vertices[i].texcoord[1];
    }
    return add_floats(gltf, buffer, object->mesh.num_vertices, 2, json_object());
}

/* True if a matrix turns triangles around, as mirrors do. */
static bool is_mirror(struct matrix world)
{
    double normal[3];
    vector_cross(world.m[0], world.m[1], normal);
    return normal[0] * world.m[2][0] + normal[1] * world.m[2][1] + normal[2] * world.m[2][2] < 0;
}

static size_t add_indices(struct gltf *gltf, const struct mesh *mesh, bool is_mirrored)
{
    json_t *accessor = json_object();
    uint32_t *indices = memory_alloc((mesh->num_indices + (size_t)1) * sizeof *indices);
    for (uint32_t i = 0; i < mesh->num_indices; ++i) {
        uint32_t corner = is_mirrored ? 2 - i % 3 : i % 3;
        indices[i] = mesh->indices[i - i % 3 + corner];
    }
    size_t view = gltf_add_view(gltf, indices, mesh->num_indices * sizeof *indices, TRIANGLES);
    free(indices);
    json_set(accessor, "bufferView", json_integer((json_int_t)view));
    json_set(accessor, "componentType", json_integer(UINTS));
    json_set(accessor, "count", json_integer((json_int_t)mesh->num_indices));
    json_set(accessor, "type", json_string("SCALAR"));
    return gltf_append(gltf_array(gltf->root, "accessors"), accessor);
}

static struct accessors add_object(struct gltf *gltf, const struct scene_object *object,
                                   bool has_tangents, struct extent *extent)
{
    float *buffer = memory_alloc(((size_t)object->mesh.num_vertices + 1) * 4 * sizeof *buffer);
    const struct matrix world = write_world(gltf->writing, object);
    struct accessors out = {.position = add_positions(gltf, object, world, buffer, extent)};
    out.normal = add_normals(gltf, object, world, buffer);
    out.texcoord = add_texcoords(gltf, object, buffer);
    if (has_tangents)
        out.tangent = add_tangents(gltf, object, world, buffer);
    out.indices = add_indices(gltf, &object->mesh, is_mirror(world));
    free(buffer);
    return out;
}

static json_t *make_primitive(const struct accessors *accessors, bool has_tangents)
{
    json_t *primitive = json_object(), *attributes = json_object();
    json_set(attributes, "POSITION", json_integer((json_int_t)accessors->position));
    json_set(attributes, "NORMAL", json_integer((json_int_t)accessors->normal));
    json_set(attributes, "TEXCOORD_0", json_integer((json_int_t)accessors->texcoord));
    if (has_tangents)
        json_set(attributes, "TANGENT", json_integer((json_int_t)accessors->tangent));
    json_set(primitive, "attributes", attributes);
    json_set(primitive, "indices", json_integer((json_int_t)accessors->indices));
    return primitive;
}

void gltf_add_root(struct gltf *gltf, size_t node)
{
    json_t *scenes = gltf_array(gltf->root, "scenes");
    if (!json_array_size(scenes))
        json_array_append_new(scenes, json_object());
    json_array_append_new(gltf_array(json_array_get(scenes, 0), "nodes"),
                          json_integer((json_int_t)node));
}

static void add_node(struct gltf *gltf, const char *name, json_t *primitives, double x)
{
    json_t *mesh = json_object(), *node = json_object();
    json_set(mesh, "primitives", primitives);
    json_set_text(node, "name", name);
    json_set(node, "mesh",
             json_integer((json_int_t)gltf_append(gltf_array(gltf->root, "meshes"), mesh)));
    if (x != 0)
        json_set(node, "translation", json_pack("[f, i, i]", x, 0, 0));
    gltf_add_root(gltf, gltf_append(gltf_array(gltf->root, "nodes"), node));
}

/* The objects of the surface once, and nodes of all materials with them. */
static void add_samples(struct gltf *gltf, const bool *tangents)
{
    const double step = 1.1; /* widths from one material to the next */
    const uint32_t num = write_num_objects(gltf->writing);
    struct extent extent = {INFINITY, -INFINITY};
    bool has_tangents = false;
    struct accessors *accessors = memory_alloc(((size_t)num + 1) * sizeof *accessors);
    for (size_t i = 0; i < gltf->flat->num_materials; ++i)
        has_tangents = has_tangents || tangents[i];
    for (uint32_t i = 0; i < num; ++i)
        accessors[i] = add_object(gltf, write_object(gltf->writing, i), has_tangents, &extent);
    for (size_t m = 0; m < gltf->flat->num_materials; ++m) {
        json_t *primitives = json_array();
        for (uint32_t i = 0; i < num; ++i) {
            json_t *primitive = make_primitive(&accessors[i], tangents[m]);
            json_set(primitive, "material", json_integer((json_int_t)m));
            json_array_append_new(primitives, primitive);
        }
        add_node(gltf, gltf->flat->materials[m].name, primitives,
                 (double)m * step * (double)(extent.high - extent.low));
    }
    free(accessors);
}

json_t *gltf_make_primitive(struct gltf *gltf, const struct scene_object *object, bool has_tangents)
{
    struct extent extent = {INFINITY, -INFINITY};
    const struct accessors accessors = add_object(gltf, object, has_tangents, &extent);
    return make_primitive(&accessors, has_tangents);
}

void gltf_add_nodes(struct gltf *gltf, const bool *tangents)
{
    (gltf->writing->stage ? gltf_add_stage : add_samples)(gltf, tangents);
    json_set(gltf->root, "scene", json_integer(0));
}
