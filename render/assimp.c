// SPDX-License-Identifier: Apache-2.0
#include "render/assimp.h"

#include "program/memory.h"
#include "render/import_files.h"

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#define TEXT_OF_VALUE(value) #value
#define TEXT_OF(macro) TEXT_OF_VALUE(macro)
#define CREASE_DEGREES 60.0f /* sharper edges stay edges where normals are made */
#define MAX_DEPTH 1000       /* of nodes */
#define MAX_CORNERS 4096     /* of a face: the time of triangulation grows with the square */

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
               ? "no reader knows this kind of file; it may be USD, glTF, OBJ, PLY or STL"
               : reason;
}

/* Makes normals where meshes lack them, except at sharp edges. NULL: it cannot. */
static const struct aiScene *make_normals(const struct aiScene *scene, bool **out_lack_normals)
{
    bool lacks = false;
    bool *lack_normals = *out_lack_normals = memory_alloc(scene->mNumMeshes + 1);
    for (unsigned i = 0; i < scene->mNumMeshes; ++i)
        lacks |= lack_normals[i] = !scene->mMeshes[i]->mNormals;
    return lacks ? aiApplyPostProcessing(scene, aiProcess_GenSmoothNormals
                                                    | aiProcess_JoinIdenticalVertices)
                 : scene;
}

/* Reads a file, and makes triangles with normals. NULL with a reason. */
static const struct aiScene *read_file(struct import_files *files, bool **out_lack_normals,
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
        scene = aiApplyPostProcessing(scene, aiProcess_Triangulate | aiProcess_SortByPType);
    if (scene)
        scene = make_normals(scene, out_lack_normals);
    if (!scene && !*out_reason)
        *out_reason = reason_of_assimp();
    return scene;
}

const struct aiScene *import_read(const mxg_context *context, const char *path, uint64_t *out_size,
                                  bool **out_lack_normals, char reason[IMPORT_MAX_REASON])
{
    const char *why = NULL;
    *out_lack_normals = NULL;
    struct import_files files;
    import_files_begin(&files, context, path);
    const struct aiScene *scene = read_file(&files, out_lack_normals, &why);
    import_files_end(&files);
    *out_size = files.size;
    if (!scene)
        snprintf(reason, IMPORT_MAX_REASON, "%s",
                 strstr(why, "bad_alloc") ? "it needs too much memory for its size" : why);
    return scene;
}
