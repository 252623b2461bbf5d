// SPDX-License-Identifier: Apache-2.0
#include "program/memory.h"
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

static void *copy_of(const void *data, size_t size)
{
    void *copy = memory_alloc(size);
    return size ? memcpy(copy, data, size) : copy;
}

struct primvar *object_add_primvar(struct scene_object *object, const char *name, const char *type,
                                   unsigned components)
{
    struct primvar made = {.components = components,
                           .type = type,
                           .type_len = (int)strlen(type),
                           .num = object->mesh.num_vertices};
    made.name = copy_of(name, strlen(name) + 1);
    made.values = memory_alloc((size_t)made.num * sizeof *made.values);
    MEMORY_PUSH(object->primvars, object->num_primvars, made);
    return &object->primvars[object->num_primvars - 1];
}

/* Values of vertices become those of corners. */
static void split_values(struct primvar *primvar, const struct mesh *mesh)
{
    float(*values)[4] = memory_alloc((size_t)mesh->num_indices * sizeof *values);
    for (uint32_t i = 0; i < mesh->num_indices; ++i)
        memcpy(values[i], primvar->values[mesh->indices[i]], sizeof *values);
    free(primvar->values);
    primvar->values = values;
    primvar->num = mesh->num_indices;
}

void object_complete(struct scene_object *object, unsigned missing, bool is_flat)
{
    if ((missing & MESH_TEXCOORDS) || is_flat) {
        for (uint32_t i = 0; i < object->num_primvars; ++i)
            if (object->primvars[i].num != 1)
                split_values(&object->primvars[i], &object->mesh);
        mesh_split(&object->mesh);
    }
    mesh_complete(&object->mesh, missing);
}

static void copy_object(const struct scene_object *from, struct scene_object *to)
{
    *to = (struct scene_object){
        .world = from->world, .path = from->path, .names_texcoords = from->names_texcoords};
    for (uint32_t i = 0; i < from->num_primvars; ++i) {
        struct primvar copy = from->primvars[i];
        copy.name = copy_of(copy.name, strlen(copy.name) + 1);
        copy.values = copy_of(copy.values, copy.num * sizeof *copy.values);
        MEMORY_PUSH(to->primvars, to->num_primvars, copy);
    }
    mesh_allocate(&to->mesh, from->mesh.num_vertices, from->mesh.num_indices);
    memcpy(to->mesh.vertices, from->mesh.vertices,
           from->mesh.num_vertices * sizeof *from->mesh.vertices);
    memcpy(to->mesh.indices, from->mesh.indices,
           from->mesh.num_indices * sizeof *from->mesh.indices);
}

static void quarter(struct scene_object *object)
{
    for (uint32_t i = 0; i < object->num_primvars; ++i) {
        struct primvar *primvar = &object->primvars[i];
        if (primvar->num == 1)
            continue;
        float(*fine)[4] = mesh_quarter_values(&object->mesh, primvar->values);
        free(primvar->values);
        primvar->values = fine;
        primvar->num = object->mesh.num_indices * 2;
    }
    mesh_quarter(&object->mesh);
}

void object_refine(const struct scene_object *object, uint32_t wanted, struct scene_object *out)
{
    copy_object(object, out);
    while (out->mesh.num_indices / 3 < wanted)
        quarter(out);
    mesh_weld(&out->mesh);
}
