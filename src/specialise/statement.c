// SPDX-License-Identifier: Apache-2.0
/*
 * The forward step over statements. Constants follow control flow: branches start with the
 * constants before them, and the code after them has the constants on which both agree. A loop, and
 * the code after it, has no constants for variables that the loop assigns.
 */
#include "specialise/spec.h"

#include <assert.h>

static bool forget_variable(void *user_data, lang_ref ref, unsigned access)
{
    struct spec *s = user_data;
    const struct lang_node *node = ast_node(s->layer, ref);
    if (node->kind == LANG_DECLARE || (node->kind == LANG_VAR && access & LANG_WRITE))
        s->known[node->a] = 0;
    return true;
}

/* Forgets the constants of all variables that a tree of the source may assign. */
static void forget_assigned(struct spec *s, lang_ref tree)
{
    lang_walk(s->layer, tree, LANG_READ, forget_variable, s);
}

/*
 * True if an expression can replace a variable or its parts: a constant, or a struct or array with
 * a constant.
 */
static bool is_known(const struct spec *s, lang_ref value)
{
    const struct lang_node *node = ast_node(s->unit, value);
    if (node->kind == LANG_CONST)
        return true;
    if (node->kind != LANG_OP || node->op != IR_CONSTRUCT || !ast_is_user_type(node->type))
        return false;
    for (lang_ref part = node->a; part; part = ast_node(s->unit, part)->next)
        if (ast_node(s->unit, part)->kind == LANG_CONST)
            return true; /* lookups skip the variable parts */
    return false;
}

static void spec_declare(struct spec *s, struct lang_node node, struct chain *out)
{
    assert(node.a < s->fn.num_slots);
    if (node.b)
        node.b = spec_expression(s, node.b);
    s->known[node.a] = node.b && is_known(s, node.b) ? node.b : 0;
    spec_append(s, out, spec_add(s, node));
}

/* Folds x op= y to x = value if both sides are constant; 0 otherwise. */
static lang_ref fold_assignment(struct spec *s, const struct lang_node *node, lang_ref value,
                                uint32_t slot)
{
    lang_ref args[2] = {s->known[slot], value};
    if (!args[0] || spec_node(s, args[0])->kind != LANG_CONST
        || spec_node(s, value)->kind != LANG_CONST)
        return 0;
    for (unsigned i = 0; i < 2; i++) /* the originals stay unchanged */
        args[i] = spec_add(s, *spec_node(s, args[i]));
    struct lang_node op = {.kind = LANG_OP, .op = node->op, .type = spec_node(s, args[0])->type};
    return spec_fold(s, &op, args, 2);
}

/* True for x = x, for example the rest of x = pow(x, p) with p = 1. */
static bool is_idle(struct spec *s, const struct lang_node *assignment)
{
    const struct lang_node *target = spec_node(s, assignment->a),
                           *value = spec_node(s, assignment->b);
    return assignment->op == IR_NUM_OPS && target->kind == LANG_VAR && value->kind == LANG_VAR
           && target->a == value->a;
}

static void spec_assign(struct spec *s, struct lang_node node, struct chain *out)
{
    uint32_t slot = ast_target_slot(s->layer, node.a);
    assert(slot < s->fn.num_slots);
    bool is_whole = ast_node(s->layer, node.a)->kind == LANG_VAR;
    node.b = spec_expression(s, node.b);
    node.a = spec_target(s, node.a);
    if (is_idle(s, &node)) {
        s->changed = true;
        return;
    }
    if (is_whole && node.op != IR_NUM_OPS) {
        lang_ref folded = fold_assignment(s, &node, node.b, slot);
        if (folded) {
            node.op = IR_NUM_OPS;
            node.b = folded;
            s->changed = true;
        }
    }
    s->known[slot] = is_whole && node.op == IR_NUM_OPS && is_known(s, node.b) ? node.b : 0;
    spec_append(s, out, spec_add(s, node));
}

/* Scratch memory that lives as long as its statement. */
static uint32_t save_known(struct spec *s)
{
    uint32_t mark = s->stack.len;
    if (s->fn.num_slots == 0)
        return mark;
    lang_ref *copy = vec_extend(s->unit->arena, &s->stack, s->fn.num_slots);
    memcpy(copy, s->known, s->fn.num_slots * sizeof *copy);
    return mark;
}

static bool is_same(const struct spec *s, lang_ref a, lang_ref b)
{
    if (a == b)
        return true;
    struct ir_value x, y;
    return a && b && spec_get(s, a, &x) && spec_get(s, b, &y) && ir_value_equal(&x, &y);
}

static lang_ref add_block(struct spec *s, lang_ref first)
{
    return spec_add(s, (struct lang_node){.kind = LANG_BLOCK, .a = first});
}

/* A body of the source, a block or a single statement, as statements. */
static bool spec_body(struct spec *s, lang_ref body, struct chain *out)
{
    if (!body)
        return true;
    bool is_block = ast_node(s->layer, body)->kind == LANG_BLOCK;
    return spec_statements(s, is_block ? ast_node(s->layer, body)->a : body, out);
}

static bool spec_if(struct spec *s, struct lang_node node, struct chain *out)
{
    lang_ref condition = spec_expression(s, node.a);
    struct ir_value value;
    if (spec_get(s, condition, &value)) {
        s->changed = true;
        return spec_body(s, value.w[0].u ? node.b : node.c, out);
    }
    uint32_t before = save_known(s);
    struct chain yes = {0}, no = {0};
    bool yes_falls = spec_body(s, node.b, &yes);
    uint32_t after = save_known(s);
    assert(after == before + s->fn.num_slots);
    if (s->fn.num_slots)
        memcpy(s->known, s->stack.items + before, s->fn.num_slots * sizeof *s->known);
    bool no_falls = spec_body(s, node.c, &no);
    for (uint32_t i = 0; i < s->fn.num_slots && yes_falls; i++) {
        lang_ref after_yes = s->stack.items[after + i];
        if (!no_falls)
            s->known[i] = after_yes;
        else if (!is_same(s, s->known[i], after_yes))
            s->known[i] = 0;
    }
    assert(s->stack.len == after + s->fn.num_slots);
    s->stack.len = before;
    node.a = condition;
    node.b = add_block(s, yes.first);
    node.c = no.first ? add_block(s, no.first) : 0;
    spec_append(s, out, spec_add(s, node));
    return yes_falls || no_falls;
}

static void forget_round(struct spec *s, const struct lang_node *loop)
{
    forget_assigned(s, loop->b);
    forget_assigned(s, loop->c);
}

static bool is_false(const struct spec *s, lang_ref condition)
{
    struct ir_value value;
    return condition && spec_get(s, condition, &value) && !value.w[0].u;
}

static void spec_loop(struct spec *s, const struct lang_node *source, struct chain *out)
{
    struct lang_node node = *source;
    struct chain init = {0}, body = {0}, step = {0};
    if (node.kind == LANG_FOR && node.a)
        spec_statements(s, node.a, &init);
    forget_round(s, source);
    if (node.kind != LANG_DO && node.b) {
        node.b = spec_expression(s, node.b);
        if (is_false(s, node.b)) {
            s->changed = true;
            if (init.first)
                spec_append(s, out, init.first);
            return;
        }
    }
    spec_body(s, node.c, &body);
    /* `continue` gets here with fewer constants than the end of the body */
    if (node.kind != LANG_WHILE)
        forget_round(s, source);
    if (node.kind == LANG_DO)
        node.b = spec_expression(s, node.b);
    if (ast_step(s->layer, source))
        spec_statements(s, ast_step(s->layer, source), &step);
    forget_round(s, source);
    if (node.kind == LANG_FOR)
        node.a = init.first;
    node.c = add_block(s, body.first);
    spec_node(s, node.c)->b = step.first;
    spec_append(s, out, spec_add(s, node));
}

static bool spec_statement(struct spec *s, lang_ref ref, struct chain *out)
{
    struct lang_node node = *ast_node(s->layer, ref);
    switch (node.kind) {
    case LANG_DECLARE: spec_declare(s, node, out); return true;
    case LANG_ASSIGN: spec_assign(s, node, out); return true;
    case LANG_EXPR:
        node.a = spec_expression(s, node.a);
        if (spec_node(s, node.a)->kind == LANG_CALL) /* otherwise it was evaluated */
            spec_append(s, out, spec_add(s, node));
        return true;
    case LANG_IF: return spec_if(s, node, out);
    case LANG_FOR:
    case LANG_WHILE:
    case LANG_DO: spec_loop(s, &node, out); return true;
    case LANG_BLOCK: return spec_statements(s, node.a, out);
    case LANG_RETURN:
        if (node.a)
            node.a = spec_expression(s, node.a);
        break;
    default: /* break, continue */ break;
    }
    spec_append(s, out, spec_add(s, node));
    return false;
}

bool spec_statements(struct spec *s, lang_ref first, struct chain *out)
{
    for (lang_ref ref = first; ref; ref = ast_node(s->layer, ref)->next)
        if (!spec_statement(s, ref, out)) {
            s->changed |= ast_node(s->layer, ref)->next != 0;
            return false;
        }
    return true;
}
