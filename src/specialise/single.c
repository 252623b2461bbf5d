// SPDX-License-Identifier: Apache-2.0
/*
 * The last step over a version's body: replaces variables with a single read by their values.
 *
 *     float d = dot(e, e);  return 1.0 / d;      →      return 1.0 / dot(e, e);
 *     vec2 v = vec2(a, b);  return vec3(v, c);   →      return vec3(a, b, c);
 *
 * A value moves if its declaration and its read are in one list of statements, and nothing assigns
 * to its operands. It keeps the name of the variable, for the lowering.
 */
#include "specialise/spec.h"

#include <assert.h>

enum { MAX_NODES = 24 /* size limit of a value that moves, to keep lines readable */ };

struct forwarder {
    struct spec *s;
    uint16_t *reads;    /* by slot: number of VAR nodes; 2 = more than one */
    lang_ref *declared; /* by slot: its DECLARE in the current list, if the value may move */
    bool any;
};

struct value { /* an expression that may move */
    const struct spec *s;
    unsigned size; /* number of nodes */
};

/*
 * Ends the walk over a value that stays: one of too many nodes, with an assigned variable, with
 * effects, or with derivatives, which stay in code that all pixels run together.
 */
static bool may_move(void *user_data, lang_ref ref, unsigned access)
{
    struct value *value = user_data;
    const struct spec *s = value->s;
    const struct lang_node *node = ast_node(s->unit, ref);
    bool is_derivative = node->kind == LANG_OP ? ir_op_info(node->op)->flags & OP_DERIVATIVE
                         : node->kind == LANG_CALL
                             ? lang_function(s->unit, node->a, NULL)->flags & LANG_FN_DERIVATIVE
                             : false;
    bool is_assigned = node->kind == LANG_VAR && s->slots[node->a].uses & SLOT_WRITTEN;
    return ++value->size <= MAX_NODES && !(access & LANG_WRITE) && !is_assigned && !is_derivative;
}

static void consider(struct forwarder *f, lang_ref statement)
{
    const struct lang_node *node = spec_node(f->s, statement);
    uint32_t slot = node->a;
    assert(node->kind == LANG_DECLARE && slot < f->s->fn.num_slots);
    if (!node->b || f->reads[slot] != 1 || f->s->slots[slot].uses & SLOT_WRITTEN
        || ast_is_user_type(spec_node(f->s, node->b)->type))
        return;
    struct value value = {.s = f->s};
    if (lang_walk(f->s->unit, node->b, LANG_READ, may_move, &value))
        f->declared[slot] = statement;
}

static bool replace_variable(void *user_data, lang_ref ref, unsigned access)
{
    struct forwarder *f = user_data;
    struct lang_node *node = spec_node(f->s, ref);
    (void)access;
    lang_ref declaration = node->kind == LANG_VAR ? f->declared[node->a] : 0;
    if (!declaration)
        return true;
    assert(f->reads[node->a] == 1);
    struct lang_node value = *spec_node(f->s, spec_node(f->s, declaration)->b);
    if (value.kind == LANG_OP || value.kind == LANG_CALL)
        value.c = ast_slot(f->s->layer, &f->s->fn, node->a)->name;
    f->declared[node->a] = 0;
    f->s->slots[node->a].uses = 0;
    spec_node(f->s, declaration)->b = 0; /* marks the declaration as removed */
    value.next = node->next;
    *node = value;
    f->any = true;
    return true;
}

/* Replaces variables that this list declares by their values. */
static void replace(struct forwarder *f, lang_ref expression)
{
    lang_walk(f->s->unit, expression, LANG_READ, replace_variable, f);
}

static lang_ref forward_list(struct forwarder *f, lang_ref first);

static void forward_block(struct forwarder *f, lang_ref block)
{
    if (block)
        spec_node(f->s, block)->a = forward_list(f, spec_node(f->s, block)->a);
}

static void forward_statement(struct forwarder *f, lang_ref ref)
{
    struct lang_node node = *spec_node(f->s, ref);
    switch (node.kind) {
    case LANG_DECLARE:
        replace(f, node.b);
        consider(f, ref);
        break;
    case LANG_ASSIGN: replace(f, node.b); break;
    case LANG_EXPR:
    case LANG_RETURN: replace(f, node.a); break;
    case LANG_IF:
        replace(f, node.a);
        forward_block(f, node.b);
        forward_block(f, node.c);
        break;
    case LANG_BLOCK: forward_block(f, ref); break;
    case LANG_FOR:
    case LANG_WHILE:
    case LANG_DO: forward_block(f, node.c); break;
    default: break;
    }
}

/* Inner lists have candidates of their own: no value moves into a branch or a loop. */
static lang_ref forward_list(struct forwarder *f, lang_ref first)
{
    struct spec *s = f->s;
    lang_ref *outer = f->declared;
    f->declared = ARENA_ARRAY(s->unit->arena, lang_ref, s->fn.num_slots);
    for (lang_ref ref = first; ref; ref = spec_node(s, ref)->next)
        forward_statement(f, ref);
    struct chain kept = {0};
    for (lang_ref ref = first, next; ref; ref = next) {
        const struct lang_node *node = spec_node(s, ref);
        next = node->next;
        bool gone = node->kind == LANG_DECLARE && !node->b && !s->slots[node->a].uses;
        if (gone)
            continue;
        spec_node(s, ref)->next = 0;
        spec_append(s, &kept, ref);
    }
    f->declared = outer;
    return kept.first;
}

/* The last operand of a constructor of a vector by parts; 0: the operand is no such constructor. */
static lang_ref last_of_vector(const struct spec *s, lang_ref operand)
{
    const struct lang_node *node = ast_node(s->unit, operand);
    if (node->kind != LANG_OP || node->op != IR_CONSTRUCT || ast_is_user_type(node->type)
        || ir_type_is_matrix(node->type) || !node->a || !ast_node(s->unit, node->a)->next)
        return 0;
    lang_ref last = node->a;
    while (ast_node(s->unit, last)->next)
        last = ast_node(s->unit, last)->next;
    return last;
}

/* vec3(vec2(a, b), c) is vec3(a, b, c) */
static bool flatten(void *user_data, lang_ref ref, unsigned access)
{
    struct spec *s = user_data;
    struct lang_node *node = spec_node(s, ref);
    (void)access;
    if (node->kind != LANG_OP || node->op != IR_CONSTRUCT || ast_is_user_type(node->type))
        return true;
    ir_type_id scalar = ir_type_info(node->type)->scalar;
    for (lang_ref *place = &node->a; *place;) {
        struct lang_node *operand = spec_node(s, *place);
        lang_ref last = last_of_vector(s, *place);
        if (last && ir_type_info(operand->type)->scalar == scalar) {
            spec_node(s, last)->next = operand->next;
            *place = operand->a;
        } else {
            place = &operand->next;
        }
    }
    return true;
}

lang_ref spec_single(struct spec *s, lang_ref first)
{
    struct forwarder f = {.s = s, .reads = ARENA_ARRAY(s->unit->arena, uint16_t, s->fn.num_slots)};
    for (uint32_t i = 0; i < s->vars.len; i++) {
        const struct lang_node *node = spec_node(s, s->vars.items[i]);
        if (node->kind == LANG_VAR && f.reads[node->a] < 2)
            f.reads[node->a]++;
    }
    first = forward_list(&f, first);
    s->changed |= f.any;
    for (lang_ref ref = first; ref && f.any; ref = spec_node(s, ref)->next)
        lang_walk(s->unit, ref, LANG_READ, flatten, s);
    uint32_t kept = 0; /* removes VAR nodes that became values */
    for (uint32_t i = 0; i < s->vars.len; i++) {
        uint8_t kind = spec_node(s, s->vars.items[i])->kind;
        if (kind == LANG_VAR || kind == LANG_DECLARE)
            s->vars.items[kept++] = s->vars.items[i];
    }
    assert(kept == s->vars.len || f.any);
    s->vars.len = kept;
    return first;
}
