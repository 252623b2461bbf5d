// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_TREE_REACH_H
#define MXG_TREE_REACH_H

#include "tree/tree.h"

/*
 * Adds the functions that `id` needs to `functions` (ids, callees before callers, each once, `id`
 * last), and the globals that they read to `globals`. Functions of the unit's module are elsewhere.
 */
struct lang_reach {
    struct arena *arena;
    VEC(uint32_t) functions, globals;
    VEC(ir_type_id) user_types; /* structs in signatures and locals, in order of use */
    bool needs_module;          /* some call is of a function of the module */
    uint8_t *seen_functions, *seen_globals, *seen_types;
    uint32_t cap_functions, cap_globals, cap_types;
};
void lang_reach_add(struct lang_reach *reach, const struct lang_unit *unit, uint32_t id);

#endif
