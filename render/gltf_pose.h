// SPDX-License-Identifier: Apache-2.0
/* Where the nodes of a glTF file stand, and the skins that they move (glTF 2.0, 3.5 and 3.7.3). */
#ifndef MXG_RENDER_GLTF_POSE_H
#define MXG_RENDER_GLTF_POSE_H

#include "import/gltf_source.h"
#include "render/matrix.h"

struct gltf_skin {
    struct matrix *joints; /* from the skinned mesh to the world; NULL: not read yet */
    size_t num_joints;
};

struct gltf_pose {
    struct gltf_source *source;
    struct matrix *worlds; /* by node */
    bool *are_placed;      /* nodes of the scene */
    size_t num_nodes, num_skins;
    struct gltf_skin *skins;
};

void gltf_pose_begin(struct gltf_pose *pose, struct gltf_source *source);
void gltf_pose_finish(struct gltf_pose *pose);

/* Places a node below its parent, which has its place; SIZE_MAX: none. false after a fault. */
bool gltf_pose_place(struct gltf_pose *pose, size_t node, size_t parent);

/* A skin, after all nodes have their places. NULL after a fault. */
const struct gltf_skin *gltf_pose_skin(struct gltf_pose *pose, size_t index);

/* `num` numbers of a list in the JSON; keeps `out` where there is none. false after a fault. */
bool gltf_pose_numbers(struct gltf_source *source, const json_t *object, const char *key,
                       size_t num, double *out);
/* A turn is a quaternion x, y, z, w. */
struct matrix gltf_pose_matrix(const double shift[3], const double turn[4], const double scale[3]);

#endif
