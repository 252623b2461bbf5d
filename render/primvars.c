// SPDX-License-Identifier: Apache-2.0
#include "render/scene.h"

#include <stdlib.h>
#include <string.h>

const struct primvar *object_primvar(const struct scene_object *object, const char *name)
{
    for (uint32_t i = 0; i < object->num_primvars; ++i)
        if (strcmp(object->primvars[i].name, name) == 0)
            return &object->primvars[i];
    return NULL;
}

void object_finish_primvars(struct scene_object *object, uint32_t num)
{
    for (uint32_t i = object->num_primvars - num; i < object->num_primvars; ++i) {
        free(object->primvars[i].name);
        free(object->primvars[i].values);
    }
    if (num)
        free(object->primvars);
}

void object_finish(struct scene_object *object)
{
    object_finish_primvars(object, object->num_primvars);
    mesh_finish(&object->mesh);
}

struct primvar *object_add_primvar(struct scene_object *object, const char *name, const char *type,
                                   unsigned components)
{
    struct primvar *primvars =
        realloc(object->primvars, (object->num_primvars + 1) * sizeof *primvars);
    struct primvar made = {.components = components,
                           .type = type,
                           .type_len = (int)strlen(type),
                           .num = object->mesh.num_vertices};
    object->primvars = primvars ? primvars : object->primvars;
    made.name = malloc(strlen(name) + 1);
    made.values = calloc((size_t)made.num + 1, sizeof *made.values);
    if (!primvars || !made.name || !made.values) {
        free(made.name);
        free(made.values);
        return NULL;
    }
    memcpy(made.name, name, strlen(name) + 1);
    primvars[object->num_primvars] = made;
    return &primvars[object->num_primvars++];
}

/* Values of vertices become those of corners. */
static bool split_values(struct primvar *primvar, const struct mesh *mesh)
{
    float(*values)[4] = malloc((size_t)mesh->num_indices * sizeof *values + 1);
    for (uint32_t i = 0; values && i < mesh->num_indices; ++i)
        memcpy(values[i], primvar->values[mesh->indices[i]], sizeof *values);
    if (!values)
        return false;
    free(primvar->values);
    primvar->values = values;
    primvar->num = mesh->num_indices;
    return true;
}

bool object_complete(struct scene_object *object, unsigned missing, bool is_flat)
{
    bool good = true;
    if ((missing & MESH_TEXCOORDS) || is_flat) {
        for (uint32_t i = 0; good && i < object->num_primvars; ++i)
            good =
                object->primvars[i].num == 1 || split_values(&object->primvars[i], &object->mesh);
        good = good && mesh_split(&object->mesh);
    }
    return good && mesh_complete(&object->mesh, missing);
}

/* malloc; NULL: out of memory. */
static void *copy_of(const void *data, size_t size)
{
    void *copy = malloc(size + 1);
    return copy && size ? memcpy(copy, data, size) : copy;
}

static bool copy_primvar(const struct primvar *from, struct primvar *to)
{
    *to = *from;
    to->name = copy_of(from->name, strlen(from->name) + 1);
    to->values = copy_of(from->values, from->num * sizeof *from->values);
    if (to->name && to->values)
        return true;
    free(to->name);
    free(to->values);
    return false;
}

static bool copy_object(const struct scene_object *from, struct scene_object *to)
{
    *to = (struct scene_object){
        .world = from->world, .path = from->path, .names_texcoords = from->names_texcoords};
    to->primvars = calloc(from->num_primvars + 1, sizeof *to->primvars);
    bool good =
        to->primvars && mesh_allocate(&to->mesh, from->mesh.num_vertices, from->mesh.num_indices);
    for (uint32_t i = 0; good && i < from->num_primvars; ++i, ++to->num_primvars)
        good = copy_primvar(&from->primvars[i], &to->primvars[i]);
    if (!good)
        return false;
    memcpy(to->mesh.vertices, from->mesh.vertices,
           from->mesh.num_vertices * sizeof *from->mesh.vertices);
    memcpy(to->mesh.indices, from->mesh.indices,
           from->mesh.num_indices * sizeof *from->mesh.indices);
    return true;
}

static bool quarter(struct scene_object *object)
{
    for (uint32_t i = 0; i < object->num_primvars; ++i) {
        struct primvar *primvar = &object->primvars[i];
        if (primvar->num == 1)
            continue;
        float(*fine)[4] = mesh_quarter_values(&object->mesh, primvar->values);
        if (!fine)
            return false;
        free(primvar->values);
        primvar->values = fine;
        primvar->num = object->mesh.num_indices * 2;
    }
    return mesh_quarter(&object->mesh);
}

bool object_refine(const struct scene_object *object, uint32_t wanted, struct scene_object *out)
{
    bool good = copy_object(object, out);
    while (good && out->mesh.num_indices / 3 < wanted)
        good = quarter(out);
    return good && mesh_weld(&out->mesh);
}
