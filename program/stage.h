// SPDX-License-Identifier: Apache-2.0
/*
 * The file of `--stage`. The library reads lists of paths and text files of USD. Assimp reads all
 * others, in the program mxgen-render.
 */
#ifndef MXG_PROGRAM_STAGE_H
#define MXG_PROGRAM_STAGE_H

#include "program/report.h"

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

struct stage_place {
    const char *file, *look, *purpose; /* look and purpose may be NULL */
};

/* A stage with the layers of its primitives. */
struct bound_stage {
    mxg_scene *scene;
    mxg_document *document;
    mxg_bindings *bindings;
};

/* Binds a stage, and reports diagnostics. The caller finishes it in any case. False: it has none.
 */
bool stage_bind(mxg_context *context, mxg_library *library, struct report *report,
                const struct stage_place *place, const mxg_document *own, struct bound_stage *out);
void stage_unbind(struct bound_stage *stage);

/* Tells that a stage has no such primitive, with the nearest path. */
void stage_report_unknown(struct report *report, const mxg_scene *scene, const char *path);

#endif
