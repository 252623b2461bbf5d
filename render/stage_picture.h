// SPDX-License-Identifier: Apache-2.0
/* The subjects of a stage: its objects, grouped by the stack that a look gives them. */
#ifndef MXG_RENDER_STAGE_PICTURE_H
#define MXG_RENDER_STAGE_PICTURE_H

#include "render/picture.h"
#include "render/stage.h"

struct stage_subjects {
    struct subject *items; /* their element is allocated */
    size_t len;
    struct scene_object *objects; /* of all subjects; refers to the stage */
    mxg_bindings *bindings;
};

/*
 * Binds a look (NULL: as for mxg_bindings_create) to the stage, and groups its objects. false after
 * reporting an error. Call stage_subjects_finish in any case.
 */
bool stage_subjects_make(struct painter *painter, const struct stage *stage,
                         const mxg_document *document, const char *path, const char *look,
                         struct stage_subjects *out);
void stage_subjects_finish(struct stage_subjects *subjects);

#endif
