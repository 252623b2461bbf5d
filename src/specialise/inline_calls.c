// SPDX-License-Identifier: Apache-2.0
/*
 * The forward step over calls of small functions: replaces the call by the expression of `return
 * expression;`, with the arguments for the parameters.
 */
#include "specialise/spec.h"

#include <assert.h>

enum { MAX_NODES = 14 /* size limit of an inlined function */ };

struct inlining {
    struct spec *s;
    const struct lang_unit *layer; /* unit of the function */
    const lang_ref *args;          /* NULL: variables stay unchanged */
};

static lang_ref copy_node(void *user_data, struct lang_node node)
{
    const struct inlining *in = user_data;
    struct spec *s = in->s;
    lang_ref operands[AST_MAX_OPERANDS];
    if (node.kind == LANG_VAR && in->args) {
        struct inlining plain = {s, s->unit, NULL};
        assert(node.a < AST_MAX_OPERANDS);
        return lang_copy(s->unit, in->args[node.a], s->unit, copy_node, &plain);
    }
    if (node.kind == LANG_CONST)
        return spec_constant_words(s, node.type, ast_words(in->layer, &node));
    if (node.kind != LANG_OP || node.op == IR_MEMBER || node.op == IR_INDEX)
        return spec_add(s, node);
    unsigned count = ast_list(s->unit, node.a, operands, AST_MAX_OPERANDS);
    lang_ref folded = spec_fold(s, &node, operands, count);
    return folded ? folded : spec_add(s, node);
}

/* True for a name, a number, or a part of a name: the code may repeat it. */
static bool is_trivial(const struct spec *s, lang_ref ref)
{
    const struct lang_node *node = ast_node(s->unit, ref);
    while (node->kind == LANG_OP
           && (node->op == IR_SWIZZLE || node->op == IR_MEMBER || node->op == IR_NEG))
        node = ast_node(s->unit, node->a);
    return node->kind == LANG_VAR || node->kind == LANG_CONST || node->kind == LANG_GLOBAL;
}

struct use_counter {
    const struct lang_unit *layer;
    uint8_t uses[AST_MAX_OPERANDS]; /* by parameter */
};

/* Ends the walk at an assignment to an argument. */
static bool count_use(void *user_data, lang_ref ref, unsigned access)
{
    struct use_counter *counter = user_data;
    const struct lang_node *node = ast_node(counter->layer, ref);
    assert(node->kind != LANG_VAR || node->a < AST_MAX_OPERANDS);
    if (node->kind == LANG_VAR)
        counter->uses[node->a]++;
    return !(access & LANG_WRITE);
}

lang_ref spec_inline(struct spec *s, const struct lang_node *call)
{
    const struct lang_unit *layer;
    const struct lang_function fn = *lang_function(s->unit, call->a, &layer);
    lang_ref returned = ast_returned(layer, &fn);
    if (!returned || fn.num_nodes > MAX_NODES || fn.num_params > AST_MAX_OPERANDS
        || (fn.flags & LANG_FN_EXPRESSION))
        return 0;
    struct use_counter counter = {.layer = layer};
    lang_ref args[AST_MAX_OPERANDS];
    if (!lang_walk(layer, returned, LANG_READ, count_use, &counter))
        return 0;
    ast_list(s->unit, call->b, args, AST_MAX_OPERANDS);
    for (uint32_t i = 0; i < fn.num_params; i++)
        if (ast_slot(layer, &fn, i)->mode != LANG_IN
            || (counter.uses[i] > 1 && !is_trivial(s, args[i]))
            || (counter.uses[i] == 0 && lang_has_effects(s->unit, args[i])))
            return 0;
    struct inlining in = {s, layer, args};
    return lang_copy(layer, returned, s->unit, copy_node, &in);
}
