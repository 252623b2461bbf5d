// SPDX-License-Identifier: Apache-2.0
#define _XOPEN_SOURCE 700 /* realpath */
#include "render/import.h"

#include "program/files.h"
#include "program/memory.h"
#include "render/import_files.h"

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define TEXT_OF_VALUE(value) #value
#define TEXT_OF(macro) TEXT_OF_VALUE(macro)
#define CREASE_DEGREES 60.0f /* sharper edges stay edges where normals are made */
#define MAX_TRIANGLES (1u << 26)
#define MAX_DEPTH 1000   /* of nodes */
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

static bool are_finite(const struct aiVector3D *vectors, unsigned num)
{
    for (unsigned i = 0; vectors && i < num; ++i)
        if (!isfinite(vectors[i].x) || !isfinite(vectors[i].y) || !isfinite(vectors[i].z))
            return false;
    return true;
}

static bool is_finite(const struct aiMesh *mesh)
{
    bool good = are_finite(mesh->mVertices, mesh->mNumVertices)
                && are_finite(mesh->mNormals, mesh->mNumVertices)
                && are_finite(mesh->mTangents, mesh->mNumVertices)
                && are_finite(mesh->mBitangents, mesh->mNumVertices);
    for (unsigned k = 0; good && k < AI_MAX_NUMBER_OF_TEXTURECOORDS; ++k)
        good = are_finite(mesh->mTextureCoords[k], mesh->mNumVertices);
    for (unsigned k = 0; good && k < AI_MAX_NUMBER_OF_COLOR_SETS && mesh->mColors[k]; ++k)
        for (unsigned v = 0; good && v < mesh->mNumVertices; ++v) {
            const struct aiColor4D *c = &mesh->mColors[k][v];
            good = isfinite(c->r) && isfinite(c->g) && isfinite(c->b) && isfinite(c->a);
        }
    return good;
}

static bool is_finite_matrix(const struct aiMatrix4x4 *m)
{
    const ai_real numbers[] = {m->a1, m->a2, m->a3, m->a4, m->b1, m->b2, m->b3, m->b4,
                               m->c1, m->c2, m->c3, m->c4, m->d1, m->d2, m->d3, m->d4};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; ++i)
        if (!isfinite(numbers[i]))
            return false;
    return true;
}

/* The fault of the nodes, which Assimp and its releases visit by recursion; NULL: none. */
static const char *nodes_fault(const struct aiScene *scene)
{
    const struct aiNode *at = scene->mRootNode;
    unsigned depth = 0, child[MAX_DEPTH + 1] = {0};
    while (at) {
        if (!child[depth] && !is_finite_matrix(&at->mTransformation))
            return "a node has a matrix with numbers that are NaN or infinite";
        if (child[depth] < at->mNumChildren) {
            at = at->mChildren[child[depth]++];
            if (depth == MAX_DEPTH)
                return "its nodes are nested more than " TEXT_OF(MAX_DEPTH) " deep";
            child[++depth] = 0;
        } else {
            at = depth-- ? at->mParent : NULL;
        }
    }
    return NULL;
}

/* Why the scene cannot be used; NULL: it can. */
static const char *fault_of(const struct aiScene *scene)
{
    if (has_large_face(scene))
        return "it has a face of more than " TEXT_OF(MAX_CORNERS) " corners";
    for (unsigned i = 0; i < scene->mNumMeshes; ++i)
        if (!is_finite(scene->mMeshes[i]))
            return "it has corners with numbers that are NaN or infinite";
    return scene->mRootNode ? nodes_fault(scene) : "it has no nodes";
}

/* The reason that Assimp gives, with what to do where it knows no such files. */
static const char *reason_of_assimp(void)
{
    const char *reason = aiGetErrorString();
    return strstr(reason, "No suitable reader")
               ? "no reader knows this kind of file; a mesh may be OBJ, glTF, PLY or STL, and a "
                 "stage of USD is for --stage"
               : reason;
}

/* Reads a file, and makes triangles. NULL with a reason. */
static const struct aiScene *read_file(struct import_files *files, bool keeps_nodes,
                                       const char **out_reason)
{
    struct aiPropertyStore *properties = aiCreatePropertyStore();
    aiSetImportPropertyInteger(properties, AI_CONFIG_PP_SBP_REMOVE,
                               aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    aiSetImportPropertyFloat(properties, AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, CREASE_DEGREES);
    const struct aiScene *scene =
        aiImportFileExWithProperties(files->path, 0, &files->io, properties);
    aiReleasePropertyStore(properties);
    *out_reason = *files->fault ? files->fault : scene ? fault_of(scene) : reason_of_assimp();
    if (scene && *out_reason) {
        aiReleaseImport(scene);
        return NULL;
    }
    if (scene) /* this releases the scene if it fails */
        scene = aiApplyPostProcessing(
            scene, aiProcess_Triangulate | aiProcess_SortByPType
                       | (keeps_nodes ? 0u : (unsigned)aiProcess_PreTransformVertices));
    if (!scene && !*out_reason)
        *out_reason = reason_of_assimp();
    return scene;
}

const struct aiScene *import_read(const mxg_context *context, const char *path, bool keeps_nodes,
                                  struct mesh_fault *fault)
{
    if (!files_is_regular(path)) { /* a device or a pipe may never end */
        fail(fault, "bad-mesh", access(path, F_OK) == 0 ? "it is not a file" : strerror(errno));
        return NULL;
    }
    char *real = realpath(path, NULL); /* the sandbox does not hold for what the user names */
    const char *reason = real ? mxg_context_file_fault(context, real, real) : strerror(errno);
    free(real);
    struct import_files files;
    import_files_begin(&files, context, path);
    const struct aiScene *scene = reason ? NULL : read_file(&files, keeps_nodes, &reason);
    import_files_end(&files);
    if (!scene)
        fail(fault, "bad-mesh",
             strstr(reason, "bad_alloc") ? "it needs too much memory for its size" : reason);
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

static bool convert(const struct aiScene *scene, unsigned made, struct scene_object *object,
                    struct mesh_fault *fault)
{
    struct mesh *out = &object->mesh;
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
    uint32_t *origins = NULL;
    if (made & MESH_TEXCOORDS) { /* mesh_complete gives each corner a vertex of its own */
        origins = memory_alloc(indices * sizeof *origins);
        memcpy(origins, out->indices, indices * sizeof *origins);
    }
    bool good = mesh_complete(out, made & ~(unsigned)MESH_NORMALS);
    if (good)
        import_primvars(scene->mMeshes, scene->mNumMeshes, origins, object);
    free(origins);
    return good || fail(fault, "bad-mesh", "out of memory");
}

bool mesh_import(const mxg_context *context, const char *path, struct scene_object *out,
                 unsigned *out_made, struct mesh_fault *fault)
{
    *out = (struct scene_object){0};
    const struct aiScene *scene = import_read(context, path, false, fault);
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
        object_finish(out);
    return good;
}
