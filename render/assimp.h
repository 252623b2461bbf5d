// SPDX-License-Identifier: Apache-2.0
/* Reads files through Assimp, for site_import.c. */
#ifndef MXG_RENDER_ASSIMP_H
#define MXG_RENDER_ASSIMP_H

#include <mxgen/mxgen.h>

#include <assimp/scene.h>

#include <stdbool.h>
#include <stdint.h>

enum { IMPORT_MAX_REASON = 256 };

/*
 * Triangles in nodes, with normals; lines and points are dropped. *out_size are the bytes of the
 * files; *out_lack_normals, by mesh, are those whose normals were made, which the caller frees in
 * any case. aiReleaseImport frees the scene. NULL with a reason.
 */
const struct aiScene *import_read(const mxg_context *context, const char *path, uint64_t *out_size,
                                  bool **out_lack_normals, char reason[IMPORT_MAX_REASON]);

#endif
