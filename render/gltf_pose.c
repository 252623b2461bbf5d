// SPDX-License-Identifier: Apache-2.0
#include "render/gltf_pose.h"

#include "import/gltf_accessor.h"
#include "program/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void gltf_pose_begin(struct gltf_pose *pose, struct gltf_source *source)
{
    *pose = (struct gltf_pose){
        .source = source,
        .num_nodes = json_array_size(json_object_get(source->root, "nodes")),
        .num_skins = json_array_size(json_object_get(source->root, "skins")),
    };
    pose->worlds = memory_alloc((pose->num_nodes + 1) * sizeof *pose->worlds);
    pose->are_placed = memory_alloc(pose->num_nodes + 1);
    pose->skins = memory_alloc((pose->num_skins + 1) * sizeof *pose->skins);
}

void gltf_pose_finish(struct gltf_pose *pose)
{
    for (size_t i = 0; i < pose->num_skins; ++i)
        free(pose->skins[i].joints);
    free(pose->skins);
    free(pose->are_placed);
    free(pose->worlds);
}

/* ---- Nodes ---- */

bool gltf_pose_numbers(struct gltf_source *source, const json_t *object, const char *key,
                       size_t num, double *out)
{
    const json_t *list = json_object_get(object, key);
    size_t count = json_array_size(list);
    if (list && count != num)
        return gltf_source_fail(source, "a '%s' has %zu numbers; expected %zu", key, count, num);
    for (size_t i = 0; i < count; ++i) {
        if (!json_is_number(json_array_get(list, i)))
            return gltf_source_fail(source, "number %zu of a '%s' is no number", i, key);
        out[i] = json_number_value(json_array_get(list, i));
    }
    return true;
}

struct matrix gltf_pose_matrix(const double shift[3], const double turn[4], const double scale[3])
{
    const double orientation[4] = {turn[3], turn[0], turn[1], turn[2]};
    return matrix_multiply(matrix_translation(shift[0], shift[1], shift[2]),
                           matrix_multiply(matrix_orientation(orientation),
                                           matrix_scale(scale[0], scale[1], scale[2])));
}

static bool is_finite(const struct matrix *m)
{
    for (size_t i = 0; i < 16; ++i)
        if (!isfinite(m->m[i / 4][i % 4]))
            return false;
    return true;
}

bool gltf_pose_place(struct gltf_pose *pose, size_t node, size_t parent)
{
    struct gltf_source *source = pose->source;
    const json_t *json = gltf_source_item(source, "nodes", node);
    struct matrix local;
    double columns[16] = {0}, shift[3] = {0}, turn[4] = {0, 0, 0, 1}, scale[3] = {1, 1, 1};
    if (!gltf_pose_numbers(source, json, "matrix", 16, columns)
        || !gltf_pose_numbers(source, json, "translation", 3, shift)
        || !gltf_pose_numbers(source, json, "rotation", 4, turn)
        || !gltf_pose_numbers(source, json, "scale", 3, scale))
        return false;
    if (json_object_get(json, "matrix"))
        memcpy(&local, columns, sizeof local);
    else
        local = gltf_pose_matrix(shift, turn, scale);
    pose->worlds[node] = parent == SIZE_MAX ? local : matrix_multiply(pose->worlds[parent], local);
    pose->are_placed[node] = true;
    return is_finite(&pose->worlds[node])
           || gltf_source_fail(
               source, "nodes[%zu] has a matrix with numbers that are NaN or infinite", node);
}

/* ---- Skins ---- */

/* The matrix of a joint for a mesh in the pose in which it was bound: M = joint · bind⁻¹. */
static bool read_joint(struct gltf_pose *pose, const json_t *joint,
                       const struct gltf_accessor *binds, size_t at, struct matrix *out)
{
    struct matrix inverse = matrix_identity();
    double columns[GLTF_MAX_WIDTH];
    size_t node = json_is_integer(joint) ? (size_t)json_integer_value(joint) : SIZE_MAX;
    if (node >= pose->num_nodes || !pose->are_placed[node])
        return gltf_source_fail(pose->source, "joint %zu of a skin is no node of the scene", at);
    if (binds) {
        gltf_accessor_read(binds, at, columns);
        memcpy(&inverse, columns, sizeof inverse);
    }
    *out = matrix_multiply(pose->worlds[node], inverse);
    return is_finite(out)
           || gltf_source_fail(pose->source,
                               "joint %zu of a skin has a matrix with numbers that are NaN or "
                               "infinite",
                               at);
}

const struct gltf_skin *gltf_pose_skin(struct gltf_pose *pose, size_t index)
{
    struct gltf_source *source = pose->source;
    const json_t *json = gltf_source_item(source, "skins", index),
                 *joints = json_object_get(json, "joints");
    size_t num = json_array_size(joints), accessor = gltf_index_of(json, "inverseBindMatrices");
    struct gltf_accessor binds = {0};
    if (index >= pose->num_skins || !num) {
        gltf_source_fail(source, "there are no skins[%zu] with joints", index);
        return NULL;
    }
    struct gltf_skin *skin = &pose->skins[index];
    if (skin->joints)
        return skin;
    if (!gltf_source_spend(source, num * sizeof *skin->joints))
        return NULL;
    if (accessor != SIZE_MAX && !gltf_accessor_open(source, accessor, 16, 16, &binds))
        return NULL;
    if (accessor != SIZE_MAX && binds.count < num) {
        gltf_source_fail(source, "accessors[%zu] has %zu matrices for the %zu joints of skins[%zu]",
                         accessor, binds.count, num, index);
        return NULL;
    }
    skin->joints = memory_alloc(num * sizeof *skin->joints);
    skin->num_joints = num;
    for (size_t i = 0; i < num; ++i)
        if (!read_joint(pose, json_array_get(joints, i), accessor == SIZE_MAX ? NULL : &binds, i,
                        &skin->joints[i]))
            return NULL;
    return skin;
}
