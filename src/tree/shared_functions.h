// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_TREE_SHARED_FUNCTIONS_H
#define MXG_TREE_SHARED_FUNCTIONS_H

#include "tree/tree.h"

/* By id, of the first `num` functions: true if a module can have the function for all shaders. */
const bool *lang_find_shared(const struct lang_unit *unit, uint32_t num, struct arena *arena);

#endif
