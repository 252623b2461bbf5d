// SPDX-License-Identifier: Apache-2.0
/*
 * Collects the callees, globals and flags of bodies. Sorts callees before callers, and rejects
 * recursion.
 */
#include "parse/parse_priv.h"
#include "tree/ast.h"
#include "tree/uses.h"
#include "tree/walk.h"

#include <assert.h>

struct body { /* the body whose uses are collected */
    struct parser *p;
    struct lang_uses uses;
};

static bool use_node(void *user_data, lang_ref ref, unsigned access)
{
    struct body *body = user_data;
    (void)access;
    lang_uses_add(&body->uses, body->p->unit, tree_node(body->p, ref), body->p->unit->arena);
    return true;
}

static void find_uses(struct body *body, struct lang_function *function)
{
    struct lang_unit *unit = body->p->unit;
    lang_uses_init(&body->uses);
    lang_walk(unit, function->body, LANG_READ, use_node, body);
    for (unsigned i = 0; i < function->num_params; i++)
        if (ast_slot(unit, function, i)->type == IR_TYPE_STRING)
            function->flags |= LANG_FN_STRINGS;
    lang_uses_record(&body->uses, unit, function);
}

/* Order */

struct order {
    struct parser *p;
    uint32_t first, num;   /* functions of the file */
    uint32_t *new_id;      /* per function; LANG_NONE: no place yet */
    uint32_t *next_callee; /* per function: the next callee to visit */
    VEC(uint32_t) stack;   /* functions being visited, by index */
    uint32_t num_placed;
};

static struct lang_function *ordered(const struct order *order, uint32_t index)
{
    return &order->p->unit->functions.items[order->first - order->p->unit->base_functions + index];
}

static void refuse_recursion(struct order *order, uint32_t index)
{
    struct parser *p = order->p;
    struct text path;
    text_init(&path, p->diags->arena);
    uint32_t i = 0;
    while (order->stack.items[i] != index)
        i++;
    assert(i < order->stack.len);
    for (; i < order->stack.len; i++)
        text_fmt(&path, "'%s' calls ", parse_text(p, ordered(order, order->stack.items[i])->name));
    text_fmt(&path, "'%s'", parse_text(p, ordered(order, index)->name));
    PARSE_ERROR(p, parse_where_function(p, ordered(order, index)), lang_recursion,
                text_cstr(&path));
}

/*
 * Continues with the function on top of the stack: visits its next callee, or gives the function
 * its place.
 */
static bool visit_top(struct order *order)
{
    const struct lang_unit *unit = order->p->unit;
    uint32_t top = vec_last(&order->stack);
    const struct lang_function *function = ordered(order, top);
    assert(order->next_callee[top] <= function->num_callees);
    while (order->next_callee[top] < function->num_callees) {
        uint32_t callee = ast_callees(unit, function)[order->next_callee[top]++] - order->first;
        bool own = callee < order->num; /* wraps for other files */
        if (!own || order->new_id[callee] != LANG_NONE)
            continue;
        if (lang_has_id(order->stack.items, order->stack.len, callee)) {
            refuse_recursion(order, callee);
            return false;
        }
        vec_push(unit->arena, &order->stack, callee);
        return true;
    }
    assert(order->new_id[top] == LANG_NONE && order->num_placed < order->num);
    order->new_id[top] = order->first + order->num_placed++;
    order->stack.len--;
    return true;
}

static bool find_order(struct order *order)
{
    for (uint32_t i = 0; i < order->num; i++) {
        if (order->new_id[i] != LANG_NONE)
            continue;
        vec_push(order->p->unit->arena, &order->stack, i);
        while (order->stack.len)
            if (!visit_top(order))
                return false;
    }
    assert(order->num_placed == order->num);
    return true;
}

static uint32_t renamed(const struct order *order, uint32_t id)
{
    return id >= order->first && id - order->first < order->num ? order->new_id[id - order->first]
                                                                : id;
}

static void apply_order(struct order *order)
{
    struct lang_unit *unit = order->p->unit;
    struct lang_function *sorted = ARENA_ARRAY(unit->arena, struct lang_function, order->num);
    for (uint32_t i = 0; i < order->num; i++) {
        struct lang_function *function = ordered(order, i);
        for (uint32_t k = 0; k < function->num_callees; k++)
            unit->refs.items[function->first_ref + k] =
                renamed(order, unit->refs.items[function->first_ref + k]);
        assert(order->new_id[i] - order->first < order->num);
        sorted[order->new_id[i] - order->first] = *function;
    }
    if (order->num)
        memcpy(ordered(order, 0), sorted, order->num * sizeof *sorted);
    for (uint32_t i = order->p->first_node; i < unit->nodes.len; i++)
        if (unit->nodes.items[i].kind == LANG_CALL)
            unit->nodes.items[i].a = renamed(order, unit->nodes.items[i].a);
}

/*
 * A prototype is enough for a function of the host, which its name tells. It is not pure: the host
 * reads what it likes.
 */
static bool is_of_host(struct parser *p, const struct lang_function *function)
{
    return !function->body && strncmp(parse_text(p, function->name), "mxg_", 4) == 0;
}

static bool order_functions(struct parser *p, uint32_t first, uint32_t num)
{
    struct order order = {.p = p, .first = first, .num = num};
    order.new_id = ARENA_ARRAY(p->unit->arena, uint32_t, num);
    order.next_callee = ARENA_ARRAY(p->unit->arena, uint32_t, num);
    for (uint32_t i = 0; i < num; i++)
        order.new_id[i] = LANG_NONE;
    if (!find_order(&order))
        return false;
    apply_order(&order);
    return true;
}

bool check_finish_functions(struct parser *p, uint32_t first_function)
{
    struct lang_unit *unit = p->unit;
    assert(first_function >= unit->base_functions);
    uint32_t first = first_function - unit->base_functions, num = unit->functions.len - first;
    struct body body = {.p = p};
    for (uint32_t i = 0; i < num; i++) {
        struct lang_function *function = &unit->functions.items[first + i];
        bool is_hosts = is_of_host(p, function);
        if (!function->body && !p->is_program && !is_hosts)
            PARSE_TYPE_ERROR(p, function->place, "'%s' is declared here but nowhere defined",
                             parse_text(p, function->name));
        find_uses(&body, function);
        if (is_hosts)
            function->flags &= (uint16_t)~LANG_FN_PURE;
    }
    if (p->num_errors || !order_functions(p, first_function, num))
        return false;
    for (uint32_t i = 0; i < num; i++)
        lang_inherit_flags(unit, &unit->functions.items[first + i]);
    return true;
}
