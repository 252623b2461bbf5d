// SPDX-License-Identifier: Apache-2.0
/* Colours and texture coordinates of meshes that Assimp reads, under the names that USD gives them.
 */
#include "render/import.h"

#include "program/cli.h"
#include "program/memory.h"

#include <assimp/mesh.h>

#include <stdlib.h>
#include <string.h>

/* A family of attributes, and the numbers of a mesh for set `set`; NULL: it lacks them. */
struct family {
    const char *name, *type;
    unsigned components, num_sets;
    size_t stride;
    const void *(*values)(const struct aiMesh *mesh, unsigned set);
};

static const void *texcoords(const struct aiMesh *mesh, unsigned set)
{
    return mesh->mTextureCoords[set];
}

static const void *colors(const struct aiMesh *mesh, unsigned set)
{
    return mesh->mColors[set];
}

static const struct family families[] = {
    {"st", "float2", 2, AI_MAX_NUMBER_OF_TEXTURECOORDS, sizeof(struct aiVector3D), texcoords},
    {"displayColor", "float4", 4, AI_MAX_NUMBER_OF_COLOR_SETS, sizeof(struct aiColor4D), colors},
};

/* The values of all meshes, one after the other: 0 where a mesh lacks the set. NULL: all do. */
static float (*read_set(const struct family *family, unsigned set, struct aiMesh *const *meshes,
                        unsigned num_meshes))[4]
{
    size_t num = 0, at = 0;
    bool has_some = false;
    for (unsigned m = 0; m < num_meshes; ++m) {
        num += meshes[m]->mNumVertices;
        has_some |= family->values(meshes[m], set) != NULL;
    }
    if (!has_some)
        return NULL;
    float(*values)[4] = memory_alloc(num * sizeof *values + 1);
    memset(values, 0, num * sizeof *values);
    for (unsigned m = 0; m < num_meshes; at += meshes[m++]->mNumVertices) {
        const char *from = family->values(meshes[m], set);
        for (unsigned v = 0; from && v < meshes[m]->mNumVertices; ++v)
            memcpy(values[at + v], from + v * family->stride, family->components * sizeof(float));
    }
    return values;
}

static void add_primvar(struct scene_object *object, const struct family *family, unsigned set,
                        const uint32_t *origins, float (*values)[4])
{
    struct primvar made = {.name = set ? cli_format("%s%u", family->name, set)
                                       : cli_format("%s", family->name),
                           .components = family->components,
                           .type = family->type,
                           .type_len = (int)strlen(family->type),
                           .num = object->mesh.num_vertices,
                           .values = values};
    if (origins) {
        made.values = memory_alloc(made.num * sizeof *made.values + 1);
        for (uint32_t i = 0; i < made.num; ++i)
            memcpy(made.values[i], values[origins[i]], sizeof *values);
        free(values);
    }
    object->primvars =
        memory_resize(object->primvars, (object->num_primvars + 1) * sizeof *object->primvars);
    object->primvars[object->num_primvars++] = made;
}

void import_primvars(struct aiMesh *const *meshes, unsigned num_meshes, const uint32_t *origins,
                     struct scene_object *object)
{
    for (size_t f = 0; f < sizeof families / sizeof *families; ++f)
        for (unsigned set = 0; set < families[f].num_sets; ++set) {
            float(*values)[4] = read_set(&families[f], set, meshes, num_meshes);
            if (values)
                add_primvar(object, &families[f], set, origins, values);
        }
}
