// SPDX-License-Identifier: Apache-2.0
#include "tree/ast.h"

#include <assert.h>

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

ir_type_id lang_add_type(struct lang_unit *unit, struct ir_user_type type)
{
    uint32_t id = IR_TYPE_FIRST_USER + unit->base_user_types + unit->user_types.len;
    uint64_t words = 0, leaves = 0;
    assert(type.first_member + type.num_members <= unit->members.len);
    for (uint32_t i = 0; i < type.num_members; i++) {
        ir_type_id member = unit->members.items[type.first_member + i].type;
        words += ast_type_words(unit, member);
        leaves += ast_type_leaves(unit, member);
    }
    if (type.array_length) {
        words = (uint64_t)type.array_length * ast_type_words(unit, type.element);
        leaves = (uint64_t)type.array_length * ast_type_leaves(unit, type.element);
    }
    if (words > LANG_MAX_WORDS || leaves > LANG_MAX_WORDS || id > UINT16_MAX)
        return IR_TYPE_VOID;
    type.num_words = (uint32_t)words;
    type.num_leaves = (uint32_t)leaves;
    vec_push(unit->arena, &unit->user_types, type);
    return (ir_type_id)id;
}
