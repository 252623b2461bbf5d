// SPDX-License-Identifier: Apache-2.0
/*
 * The last step over a version's body: replaces variables with a single read by their values.
 *
 *     float d = dot(e, e);  return 1.0 / d;      →      return 1.0 / dot(e, e);
 *
 * A value moves if its declaration and its read are in one list of statements, and nothing assigns
 * to its operands.
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

static lang_ref children_of(const struct lang_node *node)
{
    return node->kind == LANG_OP ? node->a : node->kind == LANG_CALL ? node->b : 0;
}

/* The number of nodes of an expression; more than MAX_NODES if it reads an assigned variable. */
static unsigned movable_size(const struct forwarder *f, lang_ref ref)
{
    const struct lang_node *node = spec_node(f->s, ref);
    if (node->kind == LANG_VAR)
        return f->s->slots[node->a].uses & SLOT_WRITTEN ? MAX_NODES + 1 : 1;
    unsigned size = 1;
    for (lang_ref child = children_of(node); child && size <= MAX_NODES;
         child = spec_node(f->s, child)->next)
        size += movable_size(f, child);
    return size;
}

/* True for derivatives: these stay in code that all pixels run together. */
static bool has_derivative(const struct forwarder *f, lang_ref ref)
{
    const struct lang_node *node = spec_node(f->s, ref);
    if (node->kind == LANG_OP && ir_op_info(node->op)->flags & OP_DERIVATIVE)
        return true;
    if (node->kind == LANG_CALL
        && lang_function(f->s->unit, node->a, NULL)->flags & LANG_FN_DERIVATIVE)
        return true;
    for (lang_ref child = children_of(node); child; child = spec_node(f->s, child)->next)
        if (has_derivative(f, child))
            return true;
    return false;
}

static void consider(struct forwarder *f, lang_ref statement)
{
    const struct lang_node *node = spec_node(f->s, statement);
    uint32_t slot = node->a;
    assert(node->kind == LANG_DECLARE && slot < f->s->fn.num_slots);
    if (!node->b || f->reads[slot] != 1 || f->s->slots[slot].uses & SLOT_WRITTEN
        || ast_is_user_type(spec_node(f->s, node->b)->type))
        return;
    if (!spec_has_effects(f->s, node->b) && movable_size(f, node->b) <= MAX_NODES
        && !has_derivative(f, node->b))
        f->declared[slot] = statement;
}

/* Replaces variables that this list declares by their values. */
static void replace(struct forwarder *f, lang_ref ref)
{
    struct lang_node *node = spec_node(f->s, ref);
    if (node->kind == LANG_VAR) {
        lang_ref declaration = f->declared[node->a];
        if (!declaration)
            return;
        assert(f->reads[node->a] == 1);
        struct lang_node value = *spec_node(f->s, spec_node(f->s, declaration)->b);
        f->declared[node->a] = 0;
        f->s->slots[node->a].uses = 0;
        spec_node(f->s, declaration)->b = 0; /* marks the declaration as removed */
        value.next = node->next;
        *node = value;
        f->any = true;
        return;
    }
    for (lang_ref child = children_of(node); child; child = spec_node(f->s, child)->next)
        replace(f, child);
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
        if (node.b)
            replace(f, node.b);
        consider(f, ref);
        break;
    case LANG_ASSIGN: replace(f, node.b); break;
    case LANG_EXPR:
    case LANG_RETURN:
        if (node.a)
            replace(f, node.a);
        break;
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
