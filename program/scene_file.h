// SPDX-License-Identifier: Apache-2.0
/*
 * The file of `--stage`. The library reads lists of paths and text files of USD. The program
 * mxgen-render reads all others: glTF, and what Assimp knows.
 */
#ifndef MXG_PROGRAM_SCENE_FILE_H
#define MXG_PROGRAM_SCENE_FILE_H

#include "program/cli.h"

/* By the ending of the name; a list ends in ".txt", or has no ending. */
enum scene_file_kind { SCENE_FILE_LIST, SCENE_FILE_USD, SCENE_FILE_OTHER };
enum scene_file_kind scene_file_kind(const char *path);

/*
 * Loads a stage, as mxg_scene_load does, and reports its diagnostics; files of other kinds become
 * scenes without properties. A stage of USD with arcs, or in binary, goes through usdcat of OpenUSD
 * where there is one (usdcat.h). The caller destroys the scene. NULL after a message.
 */
mxg_scene *scene_file_load(struct cli *cli, const char *path, const char *purpose);

/*
 * A copy of a document, which may be NULL, with the materials of a stage that it lacks. Reports
 * what is new in it. The caller destroys it. NULL after a message.
 */
mxg_document *scene_file_document(struct cli *cli, const mxg_document *own, const mxg_scene *scene);

struct scene_place {
    const char *file, *look, *purpose; /* look and purpose may be NULL */
};

/* A stage with the layers of its primitives. */
struct bound_scene {
    mxg_scene *scene;
    mxg_document *document;
    mxg_bindings *bindings;
};

/* Binds a stage, and reports diagnostics. The caller finishes it in any case. False: it has none.
 */
bool scene_file_bind(struct cli *cli, const struct scene_place *place, const mxg_document *own,
                     struct bound_scene *out);
void scene_file_unbind(struct bound_scene *stage);

/* The path of a primitive, which the caller frees. */
char *scene_file_path(const mxg_scene *scene, uint32_t primitive);
/* Tells that a stage has no such primitive, with the nearest path. */
void scene_file_report_unknown(struct report *report, const mxg_scene *scene, const char *path);

#endif
