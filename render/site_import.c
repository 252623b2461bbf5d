// SPDX-License-Identifier: Apache-2.0
/*
 * A site from a file that Assimp reads. Its nodes are primitives; a node with several meshes has a
 * primitive for each below it.
 */
#include "render/assimp.h"
#include "render/import_primvars.h"
#include "render/site.h"

#include "program/memory.h"
#include "program/node_path.h"

#include <assimp/cimport.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_BESIDE = 1 << 16 }; /* cameras, and lights: nodes of one name share theirs */

/* Finds things by the name of their node: 1 + index of the first, and of the next of the name. */
struct index {
    struct name_table first;
    uint32_t *next;
};

struct importer {
    struct site *site;
    const struct aiScene *scene;
    bool *lack_normals; /* meshes, in the file */
    bool good;
    struct name_table paths;
    struct index cameras, lights;
};

/* A node to visit, with the path and the matrix of its parent. */
struct visit {
    const struct aiNode *node;
    char *parent;
    struct matrix world;
};

/* Adds a primitive below a path. Its path; free. */
static char *add_primitive(struct importer *in, const char *parent, const char *name)
{
    char *path = node_path_add(&in->paths, parent, name);
    in->good = report_status(in->site->report,
                             mxg_scene_add_paths(in->site->scene, (const char *const *)&path, 1))
               && in->good;
    return path;
}

static struct matrix matrix_of(const struct aiMatrix4x4 *m)
{
    return (struct matrix){{{m->a1, m->b1, m->c1, m->d1},
                            {m->a2, m->b2, m->c2, m->d2},
                            {m->a3, m->b3, m->c3, m->d3},
                            {m->a4, m->b4, m->c4, m->d4}}};
}

static void store(const struct aiVector3D *from, float out[3])
{
    out[0] = from->x, out[1] = from->y, out[2] = from->z;
}

static void copy_mesh(const struct aiMesh *from, struct mesh *to)
{
    uint32_t index = 0;
    for (unsigned f = 0; f < from->mNumFaces; ++f)
        for (unsigned k = 0; from->mFaces[f].mNumIndices == 3 && k < 3; ++k)
            to->indices[index++] = from->mFaces[f].mIndices[k];
    to->num_indices = index;
    for (unsigned v = 0; v < from->mNumVertices; ++v) {
        struct vertex *vertex = &to->vertices[v];
        store(&from->mVertices[v], vertex->position);
        if (from->mNormals)
            store(&from->mNormals[v], vertex->normal);
        if (from->mTangents)
            store(&from->mTangents[v], vertex->tangent);
        if (from->mTextureCoords[0]) {
            vertex->texcoord[0] = from->mTextureCoords[0][v].x;
            vertex->texcoord[1] = from->mTextureCoords[0][v].y;
        }
    }
}

static void add_primvars(struct scene_object *object, const struct aiMesh *mesh)
{
    for (unsigned set = 0; set < AI_MAX_NUMBER_OF_TEXTURECOORDS; ++set) {
        float(*values)[4] =
            mesh->mTextureCoords[set] ? import_add_primvar(object, IMPORT_TEXCOORDS, set) : NULL;
        for (unsigned v = 0; values && v < mesh->mNumVertices; ++v)
            memcpy(values[v], &mesh->mTextureCoords[set][v], 2 * sizeof(float));
    }
    for (unsigned set = 0; set < AI_MAX_NUMBER_OF_COLOR_SETS; ++set) {
        float(*values)[4] =
            mesh->mColors[set] ? import_add_primvar(object, IMPORT_COLORS, set) : NULL;
        for (unsigned v = 0; values && v < mesh->mNumVertices; ++v)
            memcpy(values[v], &mesh->mColors[set][v], 4 * sizeof(float));
    }
}

static void add_object(struct importer *in, unsigned number, const char *path, struct matrix world)
{
    const struct aiMesh *mesh = in->scene->mMeshes[number];
    uint32_t primitive = mxg_scene_find_primitive(in->site->scene, path);
    struct mesh copy;
    if (!site_has_room(in->site, primitive, mesh->mNumFaces)) {
        in->good = false;
        return;
    }
    mesh_allocate(&copy, mesh->mNumVertices, 3 * mesh->mNumFaces);
    copy_mesh(mesh, &copy);
    if (!copy.num_indices) {
        mesh_finish(&copy);
        return;
    }
    struct scene_object *object = site_add(in->site, primitive, world);
    object->mesh = copy;
    add_primvars(object, mesh);
    unsigned made = (in->lack_normals[number] ? MESH_NORMALS : 0u)
                    | (mesh->mTextureCoords[0] ? 0u : MESH_TEXCOORDS)
                    | (mesh->mTangents && mesh->mTextureCoords[0] ? 0u : MESH_TANGENTS);
    object_complete(object, mesh->mNormals ? made & ~(unsigned)MESH_NORMALS : made, false);
    in->site->objects[in->site->num_objects - 1].made = made;
}

/* A node's meshes are its own, or several primitives below it. */
static void add_node(struct importer *in, const struct aiNode *node, const char *path,
                     struct matrix world)
{
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
        const struct aiMesh *mesh = in->scene->mMeshes[node->mMeshes[i]];
        char *below = node->mNumMeshes > 1 ? add_primitive(in, path, mesh->mName.data) : NULL;
        add_object(in, node->mMeshes[i], below ? below : path, world);
        free(below);
    }
}

/* ---- What has a place by the name of a node ---- */

static void add_name(struct index *index, uint32_t number, const char *name)
{
    bool is_new;
    struct name_entry *entry = names_add(&index->first, name, &is_new);
    index->next[number] = (uint32_t)entry->value;
    entry->value = number + 1;
}

/* The first of a name is found first. */
static void index_names(struct importer *in)
{
    const struct aiScene *scene = in->scene;
    in->cameras.next = memory_alloc(scene->mNumCameras * sizeof(uint32_t));
    in->lights.next = memory_alloc(scene->mNumLights * sizeof(uint32_t));
    for (unsigned i = scene->mNumCameras; i-- > 0;)
        add_name(&in->cameras, i, scene->mCameras[i]->mName.data);
    for (unsigned i = scene->mNumLights; i-- > 0;)
        add_name(&in->lights, i, scene->mLights[i]->mName.data);
}

/* 1 + the first thing of a node; 0: there is none, or there are too many. */
static uint32_t first_of(struct importer *in, const struct index *index, const struct aiNode *node)
{
    const struct name_entry *entry = names_find(&index->first, node->mName.data);
    bool is_full = in->site->num_cameras >= MAX_BESIDE || in->site->num_lights >= MAX_BESIDE;
    if (entry && is_full && in->good) {
        report_error(in->site->report, "bad-geometry",
                     "'%s' and others are more than %d cameras or lights", node->mName.data,
                     MAX_BESIDE);
        in->good = false;
    }
    return entry && !is_full ? (uint32_t)entry->value : 0;
}

static void finish_indices(struct importer *in)
{
    names_finish(&in->paths);
    names_finish(&in->cameras.first);
    names_finish(&in->lights.first);
    free(in->cameras.next);
    free(in->lights.next);
}

/* ---- Cameras ---- */

static void add_camera(struct importer *in, const struct aiNode *node, const char *path,
                       struct matrix world)
{
    for (uint32_t i = first_of(in, &in->cameras, node); i; i = in->cameras.next[i - 1]) {
        const struct aiCamera *camera = in->scene->mCameras[i - 1];
        if (!(camera->mHorizontalFOV > 0.0f))
            continue;
        double width = tan((double)camera->mHorizontalFOV / 2), aspect = (double)camera->mAspect;
        site_add_camera(in->site, (struct site_camera){.world = world,
                                                       .width = width,
                                                       .height = aspect > 0 ? width / aspect : 0,
                                                       .path = cli_format("%s", path)});
    }
}

/* ---- Lights ---- */

static void add_light(struct importer *in, const struct aiNode *node, const char *path,
                      struct matrix world)
{
    struct site *site = in->site;
    for (uint32_t i = first_of(in, &in->lights, node); i; i = in->lights.next[i - 1]) {
        const struct aiLight *light = in->scene->mLights[i - 1];
        bool is_far = light->mType == aiLightSource_DIRECTIONAL,
             is_spot = light->mType == aiLightSource_SPOT;
        if (!is_far && !is_spot && light->mType != aiLightSource_POINT) {
            site->is_lit = true;
            report_warning(site->report, "light-left-out",
                           "'%s' is a light without a direction and a place, which mxgen does not "
                           "draw",
                           path);
            continue;
        }
        struct scene_light added = {
            .type = is_far ? LIGHT_DIRECTIONAL : LIGHT_POINT,
            .color = {(double)light->mColorDiffuse.r, (double)light->mColorDiffuse.g,
                      (double)light->mColorDiffuse.b},
            .inner = is_spot ? cos((double)light->mAngleInnerCone) : NO_CONE,
            .outer = is_spot ? cos((double)light->mAngleOuterCone) : NO_CONE};
        const double along[3] = {(double)light->mDirection.x, (double)light->mDirection.y,
                                 is_far || is_spot ? (double)light->mDirection.z : -1},
                     at[3] = {(double)light->mPosition.x, (double)light->mPosition.y,
                              (double)light->mPosition.z};
        matrix_direction(world, along, added.direction);
        matrix_point(world, at, added.position);
        site_add_lamp(site, added);
    }
}

/* ---- The walk ---- */

/* True if the root is the scene itself, and no node of the file. */
static bool is_made_root(const struct importer *in, const struct aiNode *node)
{
    return node == in->scene->mRootNode && !node->mNumMeshes;
}

/* Adds what a node has. Its path; free. */
static char *visit_node(struct importer *in, const struct visit *at, struct matrix world)
{
    char *path = is_made_root(in, at->node) ? cli_format("%s", "")
                                            : add_primitive(in, at->parent, at->node->mName.data);
    add_node(in, at->node, path, world);
    add_camera(in, at->node, path, world);
    add_light(in, at->node, path, world);
    return path;
}

static void walk(struct importer *in)
{
    size_t num = 0;
    struct visit *visits = NULL;
    MEMORY_PUSH(visits, num,
                (struct visit){in->scene->mRootNode, cli_format("%s", ""), matrix_identity()});
    while (num) {
        struct visit at = visits[--num];
        if (!in->good) {
            free(at.parent);
            continue;
        }
        struct matrix world = matrix_multiply(at.world, matrix_of(&at.node->mTransformation));
        char *path = visit_node(in, &at, world);
        for (unsigned i = at.node->mNumChildren; i-- > 0;)
            MEMORY_PUSH(visits, num,
                        (struct visit){at.node->mChildren[i], cli_format("%s", path), world});
        free(path);
        free(at.parent);
    }
    free(visits);
}

bool site_import(struct site *site)
{
    char reason[IMPORT_MAX_REASON];
    struct importer in = {.site = site, .good = true};
    in.scene = import_read(site->context, site->file, &site->file_size, &in.lack_normals, reason);
    if (in.scene) {
        index_names(&in);
        walk(&in);
        finish_indices(&in);
        aiReleaseImport(in.scene);
    } else {
        report_error(site->report, "bad-mesh", "cannot use the mesh '%s': %s", site->file, reason);
    }
    free(in.lack_normals);
    return in.scene && in.good;
}
