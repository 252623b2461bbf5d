// SPDX-License-Identifier: Apache-2.0
/* The objects of binding: scenes, and the layers of their primitives. */
#ifndef MXG_API_SCENE_H
#define MXG_API_SCENE_H

#include "api/api.h"
#include "bind/bind.h"

struct mxg_scene {
    struct object object;
    struct scene scene;
    uint32_t version; /* counts the changes; bindings of an earlier one say nothing any more */
};

struct mxg_bindings {
    struct object object; /* keeps the document alive */
    mxg_scene *scene;
    const mxg_document *document;
    struct bindings bindings, facts;
    uint32_t version; /* of the scene */
    bool is_resolved; /* a look was found */
};

#endif
