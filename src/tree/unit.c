// SPDX-License-Identifier: Apache-2.0
#include "tree/tree.h"

void lang_unit_init(struct lang_unit *unit, struct arena *arena, struct strpool *strings,
                    const struct lang_unit *base)
{
    *unit = (struct lang_unit){.base = base, .arena = arena, .strings = strings};
    if (base) {
        unit->base_functions = base->base_functions + base->functions.len;
        unit->base_files = base->base_files + base->files.len;
        unit->base_globals = base->base_globals + base->globals.len;
        unit->base_user_types = base->base_user_types + base->user_types.len;
    }
    vec_push(arena, &unit->nodes, (struct lang_node){0});
}
