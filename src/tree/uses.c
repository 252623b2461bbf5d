// SPDX-License-Identifier: Apache-2.0
#include "tree/uses.h"

#include "tree/ast.h"

#include <assert.h>

bool lang_has_id(const uint32_t *ids, uint32_t num, uint32_t id)
{
    for (uint32_t i = 0; i < num; i++)
        if (ids[i] == id)
            return true;
    return false;
}

void lang_uses_init(struct lang_uses *uses)
{
    uses->callees.len = uses->globals.len = uses->num_nodes = 0;
    uses->flags = LANG_FN_PURE | LANG_FN_STRAIGHT;
}

static void add_op(struct lang_uses *uses, enum ir_op op)
{
    if (ir_op_info(op)->flags & OP_DERIVATIVE)
        uses->flags |= LANG_FN_DERIVATIVE;
    if (ir_is_difference(op))
        uses->flags |= LANG_FN_DIFFERENCE;
    if (op >= IR_TEX && op <= IR_TEX_FETCH)
        uses->flags &= (uint16_t)~LANG_FN_PURE;
}

void lang_uses_add(struct lang_uses *uses, const struct lang_unit *unit,
                   const struct lang_node *node, struct arena *arena)
{
    uses->num_nodes++;
    switch ((enum lang_kind)node->kind) {
    case LANG_OP: add_op(uses, (enum ir_op)node->op); break;
    case LANG_CALL:
        if (!lang_has_id(uses->callees.items, uses->callees.len, node->a))
            vec_push(arena, &uses->callees, node->a);
        break;
    case LANG_GLOBAL:
        if (lang_global(unit, node->a, NULL)->kind != LANG_GLOBAL_CONST)
            uses->flags &= (uint16_t)~LANG_FN_PURE;
        if (!lang_has_id(uses->globals.items, uses->globals.len, node->a))
            vec_push(arena, &uses->globals, node->a);
        break;
    case LANG_FOR:
    case LANG_WHILE:
    case LANG_DO: uses->flags &= (uint16_t)~LANG_FN_STRAIGHT; break;
    default: break;
    }
}

static void push_refs(struct lang_unit *unit, const uint32_t *ids, uint32_t count)
{
    if (count)
        memcpy(vec_extend(unit->arena, &unit->refs, count), ids, count * sizeof *ids);
}

void lang_uses_record(const struct lang_uses *uses, struct lang_unit *unit,
                      struct lang_function *fn)
{
    fn->flags |= uses->flags;
    fn->num_nodes = uses->num_nodes;
    fn->first_ref = unit->refs.len;
    fn->num_callees = uses->callees.len;
    fn->num_globals = uses->globals.len;
    push_refs(unit, uses->callees.items, uses->callees.len);
    push_refs(unit, uses->globals.items, uses->globals.len);
    assert(ast_globals(unit, fn) + fn->num_globals == unit->refs.items + unit->refs.len);
}

void lang_inherit_flags(const struct lang_unit *unit, struct lang_function *fn)
{
    const uint16_t all_of = LANG_FN_PURE | LANG_FN_STRAIGHT,
                   any_of = LANG_FN_DERIVATIVE | LANG_FN_DIFFERENCE;
    for (uint32_t i = 0; i < fn->num_callees; i++) {
        uint16_t flags = lang_function(unit, ast_callees(unit, fn)[i], NULL)->flags;
        fn->flags &= (uint16_t)(flags | ~all_of);
        fn->flags |= flags & any_of;
    }
}
