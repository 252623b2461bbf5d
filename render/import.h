// SPDX-License-Identifier: Apache-2.0
/* Reads files through Assimp: import.c as one mesh, site_import.c as a stage. */
#ifndef MXG_RENDER_IMPORT_H
#define MXG_RENDER_IMPORT_H

#include "render/scene.h"

#include <assimp/scene.h>

/*
 * Triangles; lines and points are dropped. Without nodes they are in the space of the scene.
 * aiReleaseImport frees it. NULL after a fault.
 */
const struct aiScene *import_read(const mxg_context *context, const char *path, bool keeps_nodes,
                                  struct mesh_fault *fault);
/*
 * Reads a file in OBJ, glTF or another format as one object with primvars. *out_made are the parts
 * that it added. `context` says which files it may refer to.
 */
bool mesh_import(const mxg_context *context, const char *path, struct scene_object *out,
                 unsigned *out_made, struct mesh_fault *fault);
/* The parts that a mesh lacks: bits of enum mesh_part. */
unsigned import_missing(const struct aiMesh *mesh);
/* Copies what the mesh has. */
void import_vertices(const struct aiMesh *from, struct vertex *to);
/*
 * import_primvars.c: gives an object of these meshes, one after the other, their colours and
 * texture coordinates as primvars. `origins` has the vertex of the file of each vertex of the
 * object; NULL: its own number.
 */
void import_primvars(struct aiMesh *const *meshes, unsigned num_meshes, const uint32_t *origins,
                     struct scene_object *object);

#endif
