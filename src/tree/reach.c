// SPDX-License-Identifier: Apache-2.0
#include "tree/reach.h"

#include "tree/ast.h"

#include <assert.h>

/* Adds `index` to a set of bytes, which grows as needed. True if it is new. */
static bool mark(struct arena *arena, uint8_t **seen, uint32_t *cap, uint32_t index)
{
    if (index >= *cap) {
        uint32_t old = *cap, want = index + 1 > old * 2 ? index + 64 : old * 2;
        *seen = arena_grow(arena, *seen, old, want);
        memset(*seen + old, 0, want - old);
        *cap = want;
    }
    assert(index < *cap);
    bool is_new = !(*seen)[index];
    (*seen)[index] = 1;
    return is_new;
}

/*
 * Adds members before the struct that contains them. Declarations cannot be recursive, so they
 * bound the depth.
 */
static void add_type(struct lang_reach *reach, const struct lang_unit *unit, ir_type_id type)
{
    if (!ast_is_user_type(type)
        || !mark(reach->arena, &reach->seen_types, &reach->cap_types,
                 (uint32_t)type - IR_TYPE_FIRST_USER))
        return;
    const struct lang_unit *layer;
    const struct ir_user_type *user = lang_user_type(unit, type, &layer);
    assert(user->first_member + user->num_members <= layer->members.len || user->array_length);
    if (user->array_length) {
        add_type(reach, unit, user->element);
        return;
    }
    for (uint32_t i = 0; i < user->num_members; i++)
        add_type(reach, unit, layer->members.items[user->first_member + i].type);
    vec_push(reach->arena, &reach->user_types, type);
}

static void add_global(struct lang_reach *reach, const struct lang_unit *unit, uint32_t id)
{
    if (!mark(reach->arena, &reach->seen_globals, &reach->cap_globals, id))
        return;
    add_type(reach, unit, lang_global(unit, id, NULL)->type);
    vec_push(reach->arena, &reach->globals, id);
}

static void add_own_needs(struct lang_reach *reach, const struct lang_unit *unit,
                          const struct lang_unit *layer, const struct lang_function *fn)
{
    add_type(reach, unit, fn->return_type);
    for (uint32_t i = 0; i < fn->num_slots; i++)
        add_type(reach, unit, ast_slot(layer, fn, i)->type);
    for (uint32_t i = 0; i < fn->num_globals; i++)
        add_global(reach, unit, ast_globals(layer, fn)[i]);
}

/* False: it is no news, or a module has the function. */
static bool is_new(struct lang_reach *reach, const struct lang_unit *unit, uint32_t id)
{
    bool is_elsewhere = lang_module_name(unit, id) != NULL;
    reach->needs_module |= is_elsewhere;
    return !is_elsewhere && mark(reach->arena, &reach->seen_functions, &reach->cap_functions, id);
}

/*
 * Nothing bounds the depth of calls in the author's functions, so the walk uses an explicit stack.
 */
void lang_reach_add(struct lang_reach *reach, const struct lang_unit *unit, uint32_t id)
{
    struct visit {
        uint32_t id, next_callee;
    };
    VEC(struct visit) stack = {0};
    if (is_new(reach, unit, id))
        vec_push(reach->arena, &stack, (struct visit){id, 0});
    while (stack.len) {
        struct visit *top = &vec_last(&stack);
        const struct lang_unit *layer;
        const struct lang_function *fn = lang_function(unit, top->id, &layer);
        assert(top->next_callee <= fn->num_callees);
        if (top->next_callee == fn->num_callees) {
            add_own_needs(reach, unit, layer, fn);
            vec_push(reach->arena, &reach->functions, top->id);
            (void)vec_pop(&stack);
            continue;
        }
        uint32_t callee = ast_callees(layer, fn)[top->next_callee++];
        assert(callee < top->id);
        if (is_new(reach, unit, callee))
            vec_push(reach->arena, &stack, (struct visit){callee, 0});
    }
}
