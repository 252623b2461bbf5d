// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "render/import.h"

#include "program/files.h"

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define TEXT_OF_VALUE(value) #value
#define TEXT_OF(macro) TEXT_OF_VALUE(macro)
#define CREASE_DEGREES 60.0f /* sharper edges stay edges where normals are made */
#define MAX_TRIANGLES (1u << 26)
#define MAX_CORNERS 4096 /* of a face: the time of triangulation grows with the square */

static bool fail(struct mesh_fault *fault, const char *id, const char *text)
{
    fault->id = id;
    snprintf(fault->text, sizeof fault->text, "%s", text);
    return false;
}

static bool has_large_face(const struct aiScene *scene)
{
    for (unsigned i = 0; i < scene->mNumMeshes; ++i)
        for (unsigned f = 0; f < scene->mMeshes[i]->mNumFaces; ++f)
            if (scene->mMeshes[i]->mFaces[f].mNumIndices > MAX_CORNERS)
                return true;
    return false;
}

static bool is_finite(const struct aiScene *scene)
{
    for (unsigned i = 0; i < scene->mNumMeshes; ++i)
        for (unsigned v = 0; v < scene->mMeshes[i]->mNumVertices; ++v) {
            const struct aiVector3D *at = &scene->mMeshes[i]->mVertices[v];
            if (!isfinite(at->x) || !isfinite(at->y) || !isfinite(at->z))
                return false;
        }
    return true;
}

const struct aiScene *import_read(const char *path, bool keeps_nodes, struct mesh_fault *fault)
{
    if (!files_is_regular(path)) { /* a device or a pipe may never end */
        fail(fault, "bad-mesh", access(path, F_OK) == 0 ? "it is not a file" : strerror(errno));
        return NULL;
    }
    struct aiPropertyStore *properties = aiCreatePropertyStore();
    aiSetImportPropertyInteger(properties, AI_CONFIG_PP_SBP_REMOVE,
                               aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    aiSetImportPropertyFloat(properties, AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, CREASE_DEGREES);
    const struct aiScene *scene = aiImportFileExWithProperties(path, 0, NULL, properties);
    aiReleasePropertyStore(properties);
    const char *reason = NULL;
    if (scene && has_large_face(scene))
        reason = "it has a face of more than " TEXT_OF(MAX_CORNERS) " corners";
    else if (scene && !is_finite(scene))
        reason = "it has corners whose coordinates are NaN or infinite";
    if (reason) {
        aiReleaseImport(scene);
        fail(fault, "bad-mesh", reason);
        return NULL;
    }
    if (scene) /* this releases the scene if it fails */
        scene = aiApplyPostProcessing(
            scene, aiProcess_Triangulate | aiProcess_SortByPType
                       | (keeps_nodes ? 0u : (unsigned)aiProcess_PreTransformVertices));
    if (!scene)
        fail(fault, "bad-mesh", aiGetErrorString());
    return scene;
}

unsigned import_missing(const struct aiMesh *mesh)
{
    return (mesh->mNormals ? 0u : MESH_NORMALS) | (mesh->mTextureCoords[0] ? 0u : MESH_TEXCOORDS)
           | (mesh->mTangents && mesh->mTextureCoords[0] ? 0u : MESH_TANGENTS);
}

/* Returns what any of the scene's meshes lacks. */
static unsigned missing_parts(const struct aiScene *scene)
{
    unsigned missing = 0;
    for (unsigned i = 0; i < scene->mNumMeshes; ++i)
        missing |= import_missing(scene->mMeshes[i]);
    return missing;
}

static bool count(const struct aiScene *scene, uint32_t *out_vertices, uint32_t *out_indices)
{
    uint64_t vertices = 0, triangles = 0;
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
        vertices += scene->mMeshes[i]->mNumVertices;
        triangles += scene->mMeshes[i]->mNumFaces;
    }
    *out_vertices = (uint32_t)vertices;
    *out_indices = (uint32_t)triangles * 3;
    return triangles <= MAX_TRIANGLES && vertices <= 3ull * MAX_TRIANGLES;
}

static void store(const struct aiVector3D *from, float out[3])
{
    out[0] = from->x, out[1] = from->y, out[2] = from->z;
}

void import_vertices(const struct aiMesh *from, struct vertex *to)
{
    for (unsigned v = 0; v < from->mNumVertices; ++v) {
        store(&from->mVertices[v], to[v].position);
        if (from->mNormals)
            store(&from->mNormals[v], to[v].normal);
        if (from->mTangents)
            store(&from->mTangents[v], to[v].tangent);
        if (from->mTextureCoords[0]) {
            to[v].texcoord[0] = from->mTextureCoords[0][v].x;
            to[v].texcoord[1] = from->mTextureCoords[0][v].y;
        }
    }
}

static void copy_scene(const struct aiScene *scene, struct mesh *out)
{
    uint32_t vertex = 0, index = 0;
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
        const struct aiMesh *mesh = scene->mMeshes[i];
        import_vertices(mesh, out->vertices + vertex);
        for (unsigned f = 0; f < mesh->mNumFaces; ++f)
            for (unsigned k = 0; mesh->mFaces[f].mNumIndices == 3 && k < 3; ++k)
                out->indices[index++] = vertex + mesh->mFaces[f].mIndices[k];
        vertex += mesh->mNumVertices;
    }
    out->num_indices = index;
}

static bool convert(const struct aiScene *scene, unsigned made, struct mesh *out,
                    struct mesh_fault *fault)
{
    uint32_t vertices, indices;
    if (!count(scene, &vertices, &indices))
        return fail(fault, "bad-mesh", "it has too many triangles");
    if (!indices)
        return fail(fault, "empty-mesh", "it has no triangles");
    if (!mesh_allocate(out, vertices, indices))
        return fail(fault, "bad-mesh", "out of memory");
    copy_scene(scene, out);
    mesh_fit(out);
    if (!(mesh_area(out) > 1e-12))
        return fail(fault, "empty-mesh", "its triangles have no area");
    return mesh_complete(out, made & ~(unsigned)MESH_NORMALS)
           || fail(fault, "bad-mesh", "out of memory");
}

bool mesh_import(const char *path, struct mesh *out, unsigned *out_made, struct mesh_fault *fault)
{
    *out = (struct mesh){0};
    const struct aiScene *scene = import_read(path, false, fault);
    if (!scene)
        return false;
    *out_made = missing_parts(scene);
    if (*out_made & MESH_NORMALS)
        scene = aiApplyPostProcessing(scene,
                                      aiProcess_GenSmoothNormals | aiProcess_JoinIdenticalVertices);
    if (!scene)
        return fail(fault, "bad-mesh", aiGetErrorString());
    bool good = convert(scene, *out_made, out, fault);
    aiReleaseImport(scene);
    if (!good)
        mesh_finish(out);
    return good;
}
