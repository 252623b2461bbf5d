// SPDX-License-Identifier: Apache-2.0
/*
 * The file of `--stage`. The library reads lists of paths and text files of USD. Assimp reads all
 * others, in the program mxgen-render.
 */
#ifndef MXG_CLI_STAGE_H
#define MXG_CLI_STAGE_H

#include "cli/report.h"

#include <mxgen/mxgen.h>

/* By the ending of the name; a list ends in ".txt", or has no ending. */
enum stage_kind { STAGE_LIST, STAGE_USD, STAGE_OTHER };
enum stage_kind stage_kind(const char *path);

/*
 * Loads a stage, as mxg_scene_load does, and reports its diagnostics; files of other kinds become
 * scenes without properties. The caller destroys the scene. NULL after a message.
 */
mxg_scene *stage_load(mxg_context *context, struct report *report, const char *path,
                      const char *purpose);

/*
 * A copy of a document, which may be NULL, with the materials of a stage that it lacks. Reports
 * what is new in it. The caller destroys it. NULL after a message.
 */
mxg_document *stage_document(mxg_context *context, mxg_library *library, struct report *report,
                             const mxg_document *own, const mxg_scene *scene);

#endif
