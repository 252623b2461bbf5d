// SPDX-License-Identifier: Apache-2.0
#include "lang/lang.h"

void lang_unit_init(struct lang_unit *unit, struct arena *arena, struct strpool *strings, const struct lang_unit *base)
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

const struct lang_function *lang_function(const struct lang_unit *unit, uint32_t id, const struct lang_unit **out_unit)
{
    while (id < unit->base_functions)
        unit = unit->base;
    if (out_unit)
        *out_unit = unit;
    return &unit->functions.items[id - unit->base_functions];
}

const struct lang_global *lang_global(const struct lang_unit *unit, uint32_t id, const struct lang_unit **out_unit)
{
    while (id < unit->base_globals)
        unit = unit->base;
    if (out_unit)
        *out_unit = unit;
    return &unit->globals.items[id - unit->base_globals];
}

const struct lang_file *lang_file(const struct lang_unit *unit, uint32_t id, const struct lang_unit **out_unit)
{
    while (id < unit->base_files)
        unit = unit->base;
    if (out_unit)
        *out_unit = unit;
    return &unit->files.items[id - unit->base_files];
}

const struct ir_user_type *lang_user_type(const struct lang_unit *unit, ir_type_id type, const struct lang_unit **out_unit)
{
    uint32_t id = (uint32_t)type - IR_TYPE_FIRST_USER;
    while (id < unit->base_user_types)
        unit = unit->base;
    if (out_unit)
        *out_unit = unit;
    return &unit->user_types.items[id - unit->base_user_types];
}
