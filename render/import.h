// SPDX-License-Identifier: Apache-2.0
/* Reads files through Assimp: import.c as one mesh, site_import.c as a stage. */
#ifndef MXG_RENDER_IMPORT_H
#define MXG_RENDER_IMPORT_H

#include "render/mesh.h"

#include <assimp/scene.h>

/*
 * Triangles; lines and points are dropped. Without nodes they are in the space of the scene.
 * aiReleaseImport frees it. NULL after a fault.
 */
const struct aiScene *import_read(const mxg_context *context, const char *path, bool keeps_nodes,
                                  struct mesh_fault *fault);
/* The parts that a mesh lacks: bits of enum mesh_part. */
unsigned import_missing(const struct aiMesh *mesh);
/* Copies what the mesh has. */
void import_vertices(const struct aiMesh *from, struct vertex *to);

#endif
