// SPDX-License-Identifier: Apache-2.0
/* Objects that share what they have at their vertices, as instances do. */
#ifndef MXG_RENDER_TWINS_H
#define MXG_RENDER_TWINS_H

#include "render/scene.h"

/*
 * For each object 1 + the first one with the same vertices and primvars, 0 if it is the first. The
 * caller frees the list.
 */
uint32_t *twins_find(const struct scene_object *objects, uint32_t num);

#endif
