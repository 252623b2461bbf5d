// SPDX-License-Identifier: Apache-2.0
/* The subjects of a site: its objects, grouped by the stack and the tokens that a look gives them.
 */
#ifndef MXG_RENDER_SITE_PICTURE_H
#define MXG_RENDER_SITE_PICTURE_H

#include "render/picture.h"
#include "render/site.h"
#include "render/site_facts.h"

struct site_subjects {
    struct subject *items; /* their element is allocated */
    size_t len;
    struct scene_object *objects; /* of all subjects; refers to the site and the facts */
    struct site_facts facts;
    mxg_bindings *bindings;
};

/*
 * Binds a look to the site, and groups its objects. false after reporting an error. Call
 * site_subjects_finish in any case.
 */
bool site_subjects_make(struct painter *painter, const struct site *site,
                        const mxg_document *document, const char *path,
                        const mxg_bindings_desc *desc, struct site_subjects *out);
void site_subjects_finish(struct site_subjects *subjects);

/* True if the look lets the camera see a primitive. What only some geometry sees, it may see. */
bool site_is_visible(const mxg_bindings *bindings, uint32_t primitive);

#endif
