// SPDX-License-Identifier: Apache-2.0
/*
 * The nodes of the default scene of a glTF file, with the paths that they have on a stage: the
 * same for meshes and for the looks of materials.
 */
#ifndef MXG_IMPORT_GLTF_NODES_H
#define MXG_IMPORT_GLTF_NODES_H

#include "import/gltf_source.h"
#include "program/name_table.h"

struct gltf_node {
    size_t index, parent; /* parent SIZE_MAX: it is a root */
    const json_t *json;
    const char *path; /* valid until gltf_nodes_finish */
};

struct gltf_nodes {
    struct gltf_source *source;
    struct name_table known; /* paths */
    char **paths;            /* of nodes and primitives */
    size_t num_paths;
};

/*
 * Visits each node after its parent, in the order of the file. A node that is missing, or stands a
 * second time, is left out: a fault that does not end the walk. false: `visit` returned false, or
 * after a fault that ends it, because nodes are nested too deep, or their paths are too long.
 */
bool gltf_nodes_walk(struct gltf_nodes *nodes, struct gltf_source *source,
                     bool (*visit)(void *user_data, const struct gltf_node *node), void *user_data);
void gltf_nodes_finish(struct gltf_nodes *nodes);

/*
 * The path of a primitive of the node's mesh: that of the node, or of meshes with several ones a
 * path below it. NULL after a fault.
 */
const char *gltf_nodes_add_part(struct gltf_nodes *nodes, const struct gltf_node *node,
                                size_t primitive);

#endif
