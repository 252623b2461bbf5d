// SPDX-License-Identifier: Apache-2.0
/* The triangles of a primitive of a glTF mesh, as its morph targets and its skin move them. */
#ifndef MXG_RENDER_GLTF_GEOMETRY_H
#define MXG_RENDER_GLTF_GEOMETRY_H

#include "render/gltf_pose.h"
#include "render/scene.h"

struct gltf_shape {
    const json_t *primitive;
    const json_t *weights;        /* of its morph targets; NULL: 0 */
    const struct gltf_skin *skin; /* NULL: it has none */
};

/* Where the vertices of a primitive are in the mesh that is made of it; it serves many. */
struct gltf_numbering {
    struct gltf_number {
        uint32_t shape, vertex;
    } * items; /* by vertex of the file: its number in the last shape that uses it */
    size_t capacity;
    uint32_t num_shapes;
};

/*
 * Fills an object with the vertices that triangles use, and what they lack; *out_made are parts
 * that were made. false after a fault. Without triangles the object stays empty: it has points or
 * lines, or nothing.
 */
bool gltf_geometry_read(struct gltf_source *source, const struct gltf_shape *shape,
                        struct gltf_numbering *numbering, struct scene_object *object,
                        unsigned *out_made);

/* True if a primitive has triangles: no points or lines. */
bool gltf_geometry_has_triangles(const json_t *primitive);

#endif
