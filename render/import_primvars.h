// SPDX-License-Identifier: Apache-2.0
/* Texture coordinates and colours of files other than USD, under the names that USD gives them. */
#ifndef MXG_RENDER_IMPORT_PRIMVARS_H
#define MXG_RENDER_IMPORT_PRIMVARS_H

#include "render/scene.h"

enum import_family { IMPORT_TEXCOORDS, IMPORT_COLORS };

/* Adds set 0, 1… to an object: "st", "st1"…. Returns its values, zeros, one for each vertex. */
float (*import_add_primvar(struct scene_object *object, enum import_family family,
                           unsigned set))[4];

#endif
