// SPDX-License-Identifier: Apache-2.0
/*
 * The backward step visits statements last to first, so an assignment sees all later uses of its
 * variable. The only effects in the language are assignments, by statements and by `out` arguments.
 * So the step drops statements that assign only to variables without a later read. In a loop
 * "later" includes the whole loop, so the step collects the loop's reads first.
 */
#include "specialise/spec.h"

#include <assert.h>

/* ---- Uses in the remaining code ---- */

static void use_variable(struct spec *s, lang_ref ref, unsigned access)
{
    struct spec_slot *slot = &s->slots[ast_node(s->unit, ref)->a];
    slot->uses |=
        (uint8_t)((access & LANG_READ ? SLOT_READ : 0) | (access & LANG_WRITE ? SLOT_WRITTEN : 0));
    slot->mention = s->statement;
    vec_push(s->unit->arena, &s->vars, ref);
}

static void use_literal(struct spec *s, lang_ref ref)
{
    struct spec_slot *slot = &s->slots[ast_node(s->unit, ref)->c - 1];
    slot->literals = (uint8_t)(slot->literals + (slot->literals < 2));
    vec_push(s->unit->arena, &s->longs, ref);
}

static bool use_node(void *user_data, lang_ref ref, unsigned access)
{
    struct spec *s = user_data;
    const struct lang_node *node = ast_node(s->unit, ref);
    lang_uses_add(&s->uses, s->unit, node, s->unit->arena);
    if (node->kind == LANG_VAR)
        use_variable(s, ref, access);
    else if (node->kind == LANG_CONST && node->c)
        use_literal(s, ref);
    return true;
}

static void use_tree(struct spec *s, lang_ref ref, unsigned access)
{
    lang_walk(s->unit, ref, access, use_node, s);
}

/* ---- Effects on variables with later reads ---- */

static bool is_live(const struct spec *s, lang_ref target)
{
    return s->slots[ast_target_slot(s->unit, target)].uses & SLOT_READ;
}

static bool has_no_live_effect(void *user_data, lang_ref ref, unsigned access)
{
    const struct spec *s = user_data;
    return !(access & LANG_WRITE) || !is_live(s, ref);
}

static bool has_live_effects(struct spec *s, lang_ref expression)
{
    return !lang_walk(s->unit, expression, LANG_READ, has_no_live_effect, s);
}

/*
 * Collects the reads of a loop before the sweep of the loop. An assignment to a part reads the
 * variable, because it keeps the other parts.
 */
static bool read_variable(void *user_data, lang_ref ref, unsigned access)
{
    struct spec *s = user_data;
    const struct lang_node *node = ast_node(s->unit, ref);
    if (node->kind == LANG_VAR && access & (LANG_READ | LANG_PART))
        s->slots[node->a].uses |= SLOT_READ;
    return true;
}

/* ---- Statements; each function returns whether the statement stays ---- */

static lang_ref sweep_list(struct spec *s, lang_ref first, unsigned loops);

/*
 * Handles an unused value whose computation has effects: keeps the call, or else the whole
 * statement.
 */
static bool becomes_call(struct spec *s, lang_ref ref, lang_ref value)
{
    if (spec_node(s, value)->kind != LANG_CALL)
        return false;
    struct lang_node *node = spec_node(s, ref);
    node->kind = LANG_EXPR;
    node->a = value;
    node->b = 0;
    use_tree(s, value, LANG_READ);
    return true;
}

/*
 * Turns long literals back into their variable if two or more stand for it.
 */
static void name_literals(struct spec *s, uint32_t slot)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < s->longs.len; i++) {
        lang_ref ref = s->longs.items[i];
        struct lang_node *node = spec_node(s, ref);
        if (node->c != slot + 1) {
            s->longs.items[kept++] = ref;
            continue;
        }
        node->kind = LANG_VAR;
        node->a = slot;
        node->c = 0;
        vec_push(s->unit->arena, &s->vars, ref);
    }
    assert(kept + 2 <= s->longs.len);
    s->longs.len = kept;
    s->slots[slot].uses |= SLOT_READ;
}

/*
 * The statement that assigns a new value to a variable, if this is the next mention of the
 * variable; else 0.
 */
static lang_ref overwriting(const struct spec *s, uint32_t slot, uint32_t list)
{
    lang_ref ref = s->slots[slot].mention;
    const struct lang_node *next = ast_node(s->unit, ref);
    bool overwrites = next->kind == LANG_ASSIGN && next->op == IR_NUM_OPS && next->c == list
                      && ast_node(s->unit, next->a)->kind == LANG_VAR
                      && !lang_names_slot(s->unit, next->b, slot);
    return overwrites ? ref : 0;
}

/* Moves the declaration of the variable to a statement. */
static void move_down(struct spec *s, uint32_t slot, lang_ref to)
{
    spec_node(s, to)->kind = LANG_DECLARE;
    spec_node(s, to)->a = slot;
    vec_push(s->unit->arena, &s->vars, to);
}

static bool sweep_declare(struct spec *s, lang_ref ref, uint32_t list)
{
    struct lang_node *node = spec_node(s, ref);
    uint32_t slot = node->a;
    assert(slot < s->fn.num_slots);
    if (s->slots[slot].literals > 1)
        name_literals(s, slot);
    bool is_read = s->slots[slot].uses & SLOT_READ;
    bool is_written = s->slots[slot].uses & SLOT_WRITTEN;
    lang_ref value = node->b && (is_read || has_live_effects(s, node->b)) ? node->b : 0;
    if (!is_read && !is_written)
        if (!value || becomes_call(s, ref, value))
            return value != 0;
    lang_ref next = overwriting(s, slot, list);
    if (next && (!value || !has_live_effects(s, value))) {
        move_down(s, slot, next);
        return false;
    }
    spec_node(s, ref)->b = value;
    if (value) {
        use_tree(s, value, LANG_READ);
        s->slots[slot].uses |= is_read ? 0 : SLOT_WRITTEN; /* the variable keeps its slot */
    }
    vec_push(s->unit->arena, &s->vars, ref);
    return true;
}

static bool sweep_assign(struct spec *s, lang_ref ref, unsigned loops, uint32_t list)
{
    struct lang_node node = *spec_node(s, ref);
    spec_node(s, ref)->c = list;
    uint32_t slot = ast_target_slot(s->unit, node.a);
    bool is_local = slot >= s->fn.num_params || ast_slot(s->layer, &s->fn, slot)->mode == LANG_IN;
    bool is_lost = is_local && loops == 0 && spec_node(s, node.a)->kind == LANG_VAR
                   && overwriting(s, slot, list);
    if (is_lost || !is_live(s, node.a)) {
        if (!has_live_effects(s, node.b) && !has_live_effects(s, node.a))
            return false;
        if (!has_live_effects(s, node.a) && becomes_call(s, ref, node.b))
            return true;
    }
    use_tree(s, node.a, LANG_WRITE);
    use_tree(s, node.b, LANG_READ);
    return true;
}

static void invert_condition(struct spec *s, lang_ref ref)
{
    struct lang_node node = *spec_node(s, ref);
    lang_ref not = spec_add(
        s, (struct lang_node){.kind = LANG_OP, .op = IR_NOT, .type = IR_TYPE_BOOL, .a = node.a});
    spec_node(s, ref)->a = not ;
    spec_node(s, ref)->b = node.c;
    spec_node(s, ref)->c = 0;
}

static lang_ref sweep_block(struct spec *s, lang_ref block, unsigned loops)
{
    lang_ref first = sweep_list(s, spec_node(s, block)->a, loops);
    spec_node(s, block)->a = first;
    return first;
}

static bool sweep_if(struct spec *s, lang_ref ref, unsigned loops)
{
    struct lang_node node = *spec_node(s, ref);
    bool has_else = node.c && sweep_block(s, node.c, loops);
    bool has_then = sweep_block(s, node.b, loops);
    if (!has_else)
        spec_node(s, ref)->c = 0;
    if (!has_then && !has_else && !has_live_effects(s, node.a))
        return false;
    if (!has_then && has_else)
        invert_condition(s, ref);
    s->statement = ref;
    use_tree(s, spec_node(s, ref)->a, LANG_READ);
    return true;
}

/* True if the head of an empty loop only counts its own variable. */
static bool is_idle(struct spec *s, const struct lang_node *loop)
{
    if (loop->b && has_live_effects(s, loop->b))
        return false;
    if (!ast_step(s->unit, loop))
        return true;
    const struct lang_node *init = loop->a ? ast_node(s->unit, loop->a) : NULL;
    const struct lang_node *step = ast_node(s->unit, ast_step(s->unit, loop));
    return init && init->kind == LANG_DECLARE && step->kind == LANG_ASSIGN && !step->next
           && ast_target_slot(s->unit, step->a) == init->a && !has_live_effects(s, step->b);
}

static bool sweep_loop(struct spec *s, lang_ref ref, unsigned loops)
{
    struct lang_node node = *spec_node(s, ref);
    if (loops == 0)
        lang_walk(s->unit, ref, LANG_READ, read_variable, s);
    bool has_body = sweep_block(s, node.c, loops + 1);
    if (!has_body && is_idle(s, &node))
        return false;
    s->uses.flags &= (uint16_t)~LANG_FN_STRAIGHT;
    s->statement = ref;
    if (node.kind == LANG_FOR) {
        lang_ref step = sweep_list(s, ast_step(s->unit, &node), loops + 1);
        spec_node(s, node.c)->b = step;
    }
    use_tree(s, node.b, LANG_READ);
    if (node.kind == LANG_FOR)
        spec_node(s, ref)->a = sweep_list(s, node.a, loops + 1);
    return true;
}

static bool sweep_statement(struct spec *s, lang_ref ref, unsigned loops, uint32_t list)
{
    struct lang_node node = *spec_node(s, ref);
    switch (node.kind) {
    case LANG_DECLARE: return sweep_declare(s, ref, list);
    case LANG_ASSIGN: return sweep_assign(s, ref, loops, list);
    case LANG_EXPR:
        if (!has_live_effects(s, node.a))
            return false;
        use_tree(s, node.a, LANG_READ);
        return true;
    case LANG_IF: return sweep_if(s, ref, loops);
    case LANG_RETURN: use_tree(s, node.a, LANG_READ); return true;
    case LANG_BREAK:
    case LANG_CONTINUE: return true;
    default:
        assert(node.kind == LANG_FOR || node.kind == LANG_WHILE || node.kind == LANG_DO);
        return sweep_loop(s, ref, loops);
    }
}

static lang_ref sweep_list(struct spec *s, lang_ref first, unsigned loops)
{
    uint32_t begin = s->stack.len, list = ++s->num_lists;
    for (lang_ref ref = first; ref; ref = spec_node(s, ref)->next)
        vec_push(s->unit->arena, &s->stack, ref);
    lang_ref next = 0;
    for (uint32_t i = s->stack.len; i > begin; i--) {
        lang_ref ref = s->stack.items[i - 1];
        s->statement = ref;
        if (!sweep_statement(s, ref, loops, list)) {
            s->changed = true;
            continue;
        }
        s->uses.num_nodes++;
        spec_node(s, ref)->next = next;
        next = ref;
    }
    assert(s->stack.len >= begin);
    s->stack.len = begin;
    return next;
}

lang_ref spec_sweep(struct spec *s, lang_ref first)
{
    assert(s->vars.len == 0 && s->longs.len == 0);
    return sweep_list(s, first, 0);
}
