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

static lang_ref copy(struct inlining *in, lang_ref ref);

static lang_ref copy_argument(struct inlining *in, uint32_t param)
{
    assert(param < AST_MAX_OPERANDS);
    struct inlining plain = {in->s, in->s->unit, NULL};
    return copy(&plain, in->args[param]);
}

static lang_ref copy_constant(struct inlining *in, struct lang_node node)
{
    struct ir_value value = ast_value(node.type, ast_words(in->layer, &node));
    return spec_constant(in->s, &value);
}

static lang_ref copy(struct inlining *in, lang_ref ref)
{
    struct lang_node node = *ast_node(in->layer, ref);
    if (node.kind == LANG_VAR && in->args)
        return copy_argument(in, node.a);
    if (node.kind == LANG_CONST)
        return copy_constant(in, node);
    if (node.kind != LANG_OP && node.kind != LANG_CALL)
        return spec_add(in->s, node);
    uint32_t *first = node.kind == LANG_OP ? &node.a : &node.b;
    lang_ref operands[AST_MAX_OPERANDS];
    struct chain chain = {0};
    unsigned count = 0;
    for (lang_ref child = *first; child; child = ast_node(in->layer, child)->next, count++) {
        lang_ref operand = copy(in, child);
        spec_append(in->s, &chain, operand);
        if (count < AST_MAX_OPERANDS)
            operands[count] = operand;
    }
    *first = chain.first;
    lang_ref folded = node.kind == LANG_OP && node.op != IR_MEMBER && node.op != IR_INDEX
                          ? spec_fold(in->s, &node, operands, count)
                          : 0;
    return folded ? folded : spec_add(in->s, node);
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

/*
 * Counts the uses of parameters; false if the expression calls a function that assigns to its
 * arguments.
 */
static bool count_uses(const struct lang_unit *layer, const struct spec *s, lang_ref ref,
                       uint8_t *uses)
{
    const struct lang_node *node = ast_node(layer, ref);
    assert(node->kind != LANG_VAR || node->a < AST_MAX_OPERANDS);
    if (node->kind == LANG_VAR)
        uses[node->a]++;
    lang_ref child = node->kind == LANG_OP ? node->a : node->kind == LANG_CALL ? node->b : 0;
    for (uint32_t i = 0; child; child = ast_node(layer, child)->next, i++) {
        if (node->kind == LANG_CALL && ast_param_mode(s->unit, node->a, i) != LANG_IN)
            return false;
        if (!count_uses(layer, s, child, uses))
            return false;
    }
    return true;
}

lang_ref spec_inline(struct spec *s, const struct lang_node *call)
{
    const struct lang_unit *layer;
    const struct lang_function fn = *lang_function(s->unit, call->a, &layer);
    lang_ref returned = ast_returned(layer, &fn);
    if (!returned || fn.num_nodes > MAX_NODES || fn.num_params > AST_MAX_OPERANDS
        || (fn.flags & LANG_FN_EXPRESSION))
        return 0;
    uint8_t uses[AST_MAX_OPERANDS] = {0};
    lang_ref args[AST_MAX_OPERANDS];
    if (!count_uses(layer, s, returned, uses))
        return 0;
    ast_list(s->unit, call->b, args, AST_MAX_OPERANDS);
    for (uint32_t i = 0; i < fn.num_params; i++)
        if (ast_slot(layer, &fn, i)->mode != LANG_IN || (uses[i] > 1 && !is_trivial(s, args[i]))
            || (uses[i] == 0 && spec_has_effects(s, args[i])))
            return 0;
    struct inlining in = {s, layer, args};
    return copy(&in, returned);
}
