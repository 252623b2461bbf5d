// SPDX-License-Identifier: Apache-2.0
/* The objects of binding: scenes, and the layers of their primitives. */
#ifndef MXG_API_SCENE_H
#define MXG_API_SCENE_H

#include "api/api.h"
#include "bind/bind.h"

struct mxg_scene {
    struct object object;
    struct scene scene;
    bool is_bound; /* bindings refer to it, so it must not change */
};

struct mxg_bindings {
    struct object object; /* keeps the document alive */
    mxg_scene *scene;
    const mxg_document *document;
    struct bindings bindings, facts;
    bool is_resolved; /* a look was found */
};

#endif
