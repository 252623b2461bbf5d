// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_BIND_MATERIALS_H
#define MXG_BIND_MATERIALS_H

#include "bind/scene.h"
#include "library/library.h"

/*
 * Adds the Materials of a stage to the document of a library layer, which is not complete yet. The
 * document's own elements stay: a Material whose name one of them has is left out. Shaders without
 * a definition are reported, and left out.
 */
void bind_add_materials(const struct scene *scene, struct library *lib, struct arena *scratch,
                        struct diag_list *diags);

#endif
