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

/* True for the number of a primitive that is not removed. */
static inline bool has_primitive(const mxg_scene *scene, uint32_t primitive)
{
    return primitive < mxg_scene_num_primitives(scene) && scene_has(&scene->scene, primitive + 1);
}

/* Inside, 0 is the root; the numbers of the interface leave it out. */
static inline uint32_t scene_number(prim_id prim)
{
    return prim ? prim - 1 : MXG_NONE;
}

struct mxg_bindings {
    struct object object; /* keeps the document alive */
    mxg_scene *scene;
    const mxg_document *document;
    struct bindings bindings, facts;
    uint32_t version; /* of the scene */
    bool is_resolved; /* a look was found */
};

#endif
