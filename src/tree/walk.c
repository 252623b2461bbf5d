// SPDX-License-Identifier: Apache-2.0
#include "tree/walk.h"

#include "tree/ast.h"

#include <assert.h>

/* The fields of a node that start lists of children, by kind. */
enum { CHILD_A = 1, CHILD_B = 2, CHILD_C = 4 };
static const uint8_t child_fields[LANG_NUM_KINDS] = {
    [LANG_OP] = CHILD_A,
    [LANG_CALL] = CHILD_B,
    [LANG_DECLARE] = CHILD_B,
    [LANG_ASSIGN] = CHILD_A | CHILD_B,
    [LANG_EXPR] = CHILD_A,
    [LANG_IF] = CHILD_A | CHILD_B | CHILD_C,
    [LANG_FOR] = CHILD_A | CHILD_B | CHILD_C,
    [LANG_WHILE] = CHILD_B | CHILD_C,
    [LANG_DO] = CHILD_B | CHILD_C,
    [LANG_BLOCK] = CHILD_A | CHILD_B,
    [LANG_RETURN] = CHILD_A,
};

struct walk {
    const struct lang_unit *unit;
    lang_visitor *visit;
    void *user_data;
};

/* The access to child `index` of a field. */
static unsigned child_access(const struct walk *w, const struct lang_node *node, unsigned access,
                             unsigned field, uint32_t index)
{
    static const uint8_t of_modes[] = {LANG_READ, LANG_WRITE, LANG_READ | LANG_WRITE};
    switch (node->kind) {
    case LANG_ASSIGN: return field == 0 ? LANG_WRITE : LANG_READ;
    case LANG_CALL: return of_modes[ast_param_mode(w->unit, node->a, index)];
    case LANG_OP: return index == 0 && access & LANG_WRITE ? access | LANG_PART : LANG_READ;
    default: return LANG_READ;
    }
}

static bool walk(const struct walk *w, lang_ref ref, unsigned access)
{
    if (!w->visit(w->user_data, ref, access))
        return false;
    const struct lang_node *node = ast_node(w->unit, ref);
    unsigned fields = child_fields[node->kind];
    if (!fields)
        return true;
    const uint32_t firsts[] = {node->a, node->b, node->c};
    for (unsigned field = 0; fields >> field; field++) {
        uint32_t index = 0;
        lang_ref child = fields >> field & 1 ? firsts[field] : 0;
        for (; child; child = ast_node(w->unit, child)->next, index++)
            if (!walk(w, child, child_access(w, node, access, field, index)))
                return false;
    }
    return true;
}

bool lang_walk(const struct lang_unit *unit, lang_ref root, unsigned access, lang_visitor *visit,
               void *user_data)
{
    return !root || walk(&(struct walk){unit, visit, user_data}, root, access);
}

lang_ref lang_copy(const struct lang_unit *from, lang_ref root, struct lang_unit *to,
                   lang_maker *make, void *user_data)
{
    if (!root)
        return 0;
    struct lang_node node = *ast_node(from, root);
    uint32_t *firsts[] = {&node.a, &node.b, &node.c};
    unsigned fields = child_fields[node.kind];
    for (unsigned field = 0; fields >> field; field++) {
        lang_ref last = 0, child = fields >> field & 1 ? *firsts[field] : 0;
        for (; child; child = ast_node(from, child)->next) {
            lang_ref copy = lang_copy(from, child, to, make, user_data);
            *(last ? &to->nodes.items[last].next : firsts[field]) = copy;
            last = copy;
        }
    }
    node.next = 0;
    return make(user_data, node);
}

static bool reads_only(void *user_data, lang_ref ref, unsigned access)
{
    (void)user_data, (void)ref;
    return !(access & LANG_WRITE);
}

bool lang_has_effects(const struct lang_unit *unit, lang_ref expression)
{
    return !lang_walk(unit, expression, LANG_READ, reads_only, NULL);
}

struct slot_search {
    const struct lang_unit *unit;
    uint32_t slot;
};

static bool names_other_slot(void *user_data, lang_ref ref, unsigned access)
{
    const struct slot_search *search = user_data;
    const struct lang_node *node = ast_node(search->unit, ref);
    (void)access;
    return node->kind != LANG_VAR || node->a != search->slot;
}

bool lang_names_slot(const struct lang_unit *unit, lang_ref expression, uint32_t slot)
{
    struct slot_search search = {unit, slot};
    return !lang_walk(unit, expression, LANG_READ, names_other_slot, &search);
}
