// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_TREE_REACH_H
#define MXG_TREE_REACH_H

#include "tree/tree.h"

/*
 * Adds to `functions` (ids, callees before callers, each once) what function `id` needs, itself
 * last, and to `globals` what these read.
 */
struct lang_reach {
    struct arena *arena;
    VEC(uint32_t) functions, globals;
    VEC(ir_type_id) user_types; /* structs used in signatures and locals, in order of need */
    uint8_t *seen_functions, *seen_globals, *seen_types;
    uint32_t cap_functions, cap_globals, cap_types;
};
void lang_reach_add(struct lang_reach *reach, const struct lang_unit *unit, uint32_t id);

#endif
