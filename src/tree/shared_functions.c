// SPDX-License-Identifier: Apache-2.0
/*
 * Functions that are the same in every shader, so that one module can have them for all:
 * specialisation leaves them as the packer wrote them (LANG_FN_FINAL), they read nothing of the
 * host, their types are those of the language, and all this is true of their callees.
 */
#include "tree/shared_functions.h"

#include "tree/ast.h"

#include <assert.h>

static bool has_own_types(const struct lang_unit *layer, const struct lang_function *fn)
{
    bool has = ast_is_user_type(fn->return_type);
    for (uint32_t i = 0; i < fn->num_params; i++)
        has |= ast_is_user_type(ast_slot(layer, fn, i)->type);
    return has;
}

static bool is_same_everywhere(const struct lang_unit *unit, uint32_t id, const bool *before)
{
    const struct lang_unit *layer;
    const struct lang_function *fn = lang_function(unit, id, &layer);
    bool is_same = fn->body && fn->flags & LANG_FN_FINAL && !has_own_types(layer, fn);
    for (uint32_t i = 0; i < fn->num_globals; i++)
        is_same &= lang_global(unit, ast_globals(layer, fn)[i], NULL)->kind == LANG_GLOBAL_CONST;
    for (uint32_t i = 0; i < fn->num_callees; i++) {
        assert(ast_callees(layer, fn)[i] < id);
        is_same &= before[ast_callees(layer, fn)[i]];
    }
    return is_same;
}

const bool *lang_find_shared(const struct lang_unit *unit, uint32_t num, struct arena *arena)
{
    bool *shared = ARENA_ARRAY(arena, bool, num + 1);
    for (uint32_t id = 0; id < num; id++)
        shared[id] = is_same_everywhere(unit, id, shared);
    return shared;
}
