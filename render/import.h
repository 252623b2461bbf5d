// SPDX-License-Identifier: Apache-2.0
/* Reads files through Assimp, for site_import.c. */
#ifndef MXG_RENDER_IMPORT_H
#define MXG_RENDER_IMPORT_H

#include <mxgen/mxgen.h>

#include <assimp/scene.h>

#include <stdint.h>

enum { IMPORT_MAX_REASON = 256 };

/*
 * Triangles in nodes; lines and points are dropped. *out_size are the bytes of the files.
 * aiReleaseImport frees it. NULL with a reason.
 */
const struct aiScene *import_read(const mxg_context *context, const char *path, uint64_t *out_size,
                                  char reason[IMPORT_MAX_REASON]);

#endif
