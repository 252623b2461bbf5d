// SPDX-License-Identifier: Apache-2.0
/* Folding of ops: constants by ir_eval_op, then identities that hold for all finite operands. */
#include "specialise/spec.h"

#include <assert.h>
#include <string.h>

static lang_ref fold_constants(struct spec *s, const struct lang_node *op, const lang_ref *args,
                               unsigned num_args)
{
    for (unsigned i = 0; i < num_args; i++)
        if (spec_node(s, args[i])->kind != LANG_CONST)
            return 0;
    struct ir_value values[AST_MAX_OPERANDS], result;
    for (unsigned i = 0; i < num_args; i++)
        spec_get(s, args[i], &values[i]);
    if (!ir_eval_op(op->op, op->type, op->b, values, num_args, &result))
        return 0;
    return spec_constant(s, &result);
}

/* True for a constant scalar or vector whose components all equal `number`. */
static bool is_number(const struct spec *s, lang_ref ref, int number)
{
    const struct lang_node *node = ast_node(s->unit, ref);
    if (node->kind != LANG_CONST || ir_type_is_matrix(node->type))
        return false;
    const struct ir_type_info *info = ir_type_info(node->type);
    if (info->scalar < IR_TYPE_INT || info->scalar > IR_TYPE_FLOAT)
        return false;
    const union ir_word *words = ast_words(s->unit, node);
    for (unsigned i = 0; i < info->components; i++)
        if (info->scalar == IR_TYPE_FLOAT ? words[i].f != (float)number : words[i].i != number)
            return false;
    return true;
}

static bool is_splat(const struct ir_value *value)
{
    const struct ir_type_info *info = ir_type_info(value->type);
    for (unsigned i = 1; i < info->components; i++)
        if (value->w[i].u != value->w[0].u)
            return false;
    return info->components > 1 && info->columns == 1;
}

static bool is_false_or_true(const struct spec *s, lang_ref ref, bool wanted)
{
    const struct lang_node *node = ast_node(s->unit, ref);
    return node->kind == LANG_CONST && node->type == IR_TYPE_BOOL
           && (ast_words(s->unit, node)->u != 0) == wanted;
}

/* An operand as the result of an op, spread if the op spreads it. */
static lang_ref as_result(struct spec *s, const struct lang_node *op, lang_ref ref)
{
    bool fits = spec_node(s, ref)->type == op->type;
    if (!fits && ir_type_is_matrix(op->type))
        return 0;
    assert(fits || spec_node(s, ref)->type == ir_type_info(op->type)->scalar);
    spec_node(s, ref)->next = 0;
    if (fits)
        return ref;
    return spec_add(
        s, (struct lang_node){.kind = LANG_OP, .op = IR_CONSTRUCT, .type = op->type, .a = ref});
}

static lang_ref zero(struct spec *s, const struct lang_node *op, lang_ref dropped)
{
    if (lang_has_effects(s->unit, dropped))
        return 0;
    return spec_constant(s, &(struct ir_value){.type = op->type});
}

/*
 * A linear-algebra product with a vector of ones is a sum of columns instead of an identity.
 */
static bool is_linear(const struct spec *s, lang_ref a, lang_ref b)
{
    ir_type_id types[2] = {ast_node(s->unit, a)->type, ast_node(s->unit, b)->type};
    for (unsigned i = 0; i < 2; i++)
        if (ir_type_is_matrix(types[i]) && ir_type_info(types[1 - i])->components > 1)
            return true;
    return false;
}

static lang_ref simplify_mul(struct spec *s, const struct lang_node *op, lang_ref a, lang_ref b)
{
    if (is_number(s, a, 0))
        return zero(s, op, b);
    if (is_number(s, b, 0))
        return zero(s, op, a);
    if (is_linear(s, a, b))
        return 0;
    return is_number(s, a, 1) ? as_result(s, op, b) : is_number(s, b, 1) ? as_result(s, op, a) : 0;
}

static lang_ref simplify_sub(struct spec *s, const struct lang_node *op, lang_ref a, lang_ref b)
{
    if (is_number(s, b, 0))
        return as_result(s, op, a);
    if (!is_number(s, a, 0) || spec_node(s, b)->type != op->type)
        return 0;
    return spec_add(s,
                    (struct lang_node){
                        .kind = LANG_OP, .op = IR_NEG, .type = op->type, .a = as_result(s, op, b)});
}

static lang_ref simplify_logic(struct spec *s, const struct lang_node *op, lang_ref a, lang_ref b)
{
    bool neutral = op->op == IR_LAND;
    if (is_false_or_true(s, a, neutral))
        return as_result(s, op, b);
    if (is_false_or_true(s, b, neutral))
        return as_result(s, op, a);
    bool decided = is_false_or_true(s, a, !neutral)
                   || (is_false_or_true(s, b, !neutral) && !lang_has_effects(s->unit, a));
    return decided
               ? spec_constant(s, &(struct ir_value){.type = IR_TYPE_BOOL, .w = {{.u = !neutral}}})
               : 0;
}

static bool is_same_constant(const struct spec *s, lang_ref a, lang_ref b)
{
    const struct lang_node *x = ast_node(s->unit, a), *y = ast_node(s->unit, b);
    size_t count = ir_type_info(x->type)->components;
    return x->kind == LANG_CONST && y->kind == LANG_CONST && x->type == y->type
           && memcmp(ast_words(s->unit, x), ast_words(s->unit, y), count * sizeof(union ir_word))
                  == 0;
}

static lang_ref simplify_mix(struct spec *s, const struct lang_node *op, const lang_ref *args)
{
    if (is_same_constant(s, args[0], args[1]) && !lang_has_effects(s->unit, args[2]))
        return as_result(s, op, args[0]);
    if (is_number(s, args[2], 0) && !lang_has_effects(s->unit, args[1]))
        return as_result(s, op, args[0]);
    if (is_number(s, args[2], 1) && !lang_has_effects(s->unit, args[0]))
        return as_result(s, op, args[1]);
    return 0;
}

/* Simplifies components of a spread scalar, and of a negative vector: (-v).z is -v.z. */
static lang_ref simplify_swizzle(struct spec *s, const struct lang_node *op, lang_ref a)
{
    const struct lang_node *inner = spec_node(s, a);
    if (inner->kind == LANG_OP && inner->op == IR_NEG) {
        struct lang_node part = *op;
        part.a = inner->a;
        part.a = spec_add(s, part);
        return spec_add(
            s, (struct lang_node){.kind = LANG_OP, .op = IR_NEG, .type = op->type, .a = part.a});
    }
    if (inner->kind != LANG_OP || inner->op != IR_CONSTRUCT || ast_is_user_type(inner->type)
        || !inner->a || ir_type_is_matrix(inner->type))
        return 0;
    const struct lang_node *part = spec_node(s, inner->a);
    bool spreads = !part->next && part->type == ir_type_info(inner->type)->scalar;
    return spreads ? as_result(s, op, inner->a) : 0;
}

/*
 * vec3(2.0) * v is 2.0 * v: the scalar is shorter, and the op spreads it. Writes the op if this
 * applies.
 */
static lang_ref shorten(struct spec *s, const struct lang_node *op, const lang_ref *args)
{
    for (unsigned i = 0; i < 2; i++) {
        struct ir_value value;
        if (spec_node(s, args[1 - i])->type != op->type || !spec_get(s, args[i], &value)
            || !is_splat(&value))
            continue;
        value.type = ir_type_info(value.type)->scalar;
        lang_ref parts[2] = {args[0], args[1]};
        parts[i] = spec_constant(s, &value);
        spec_node(s, parts[0])->next = parts[1];
        spec_node(s, parts[1])->next = 0;
        struct lang_node shorter = *op;
        shorter.a = parts[0];
        return spec_add(s, shorter);
    }
    return 0;
}

/* Any part of a constant whose components are equal. */
static lang_ref simplify_index(struct spec *s, const struct lang_node *op, const lang_ref *args)
{
    struct ir_value value;
    if (!spec_get(s, args[0], &value) || !is_splat(&value) || lang_has_effects(s->unit, args[1]))
        return 0;
    value.type = op->type;
    return spec_constant(s, &value);
}

static lang_ref simplify_div(struct spec *s, const struct lang_node *op, const lang_ref *args)
{
    if (is_number(s, args[0], 0))
        return zero(s, op, args[1]);
    return is_number(s, args[1], 1) ? as_result(s, op, args[0]) : 0;
}

/* The packer of a library does not know the arguments of a generation, so it leaves the op. */
static lang_ref simplify_known(struct spec *s, lang_ref a)
{
    if (!s->unit->host.global || lang_has_effects(s->unit, a))
        return 0;
    return spec_constant(s, &(struct ir_value){.type = IR_TYPE_BOOL});
}

static lang_ref simplify(struct spec *s, const struct lang_node *op, const lang_ref *args)
{
    switch (op->op) {
    case IR_MUL: return simplify_mul(s, op, args[0], args[1]);
    case IR_ADD:
        return is_number(s, args[0], 0)   ? as_result(s, op, args[1])
               : is_number(s, args[1], 0) ? as_result(s, op, args[0])
                                          : 0;
    case IR_SUB: return simplify_sub(s, op, args[0], args[1]);
    case IR_DIV: return simplify_div(s, op, args);
    case IR_POW: return is_number(s, args[1], 1) ? as_result(s, op, args[0]) : 0;
    case IR_LAND:
    case IR_LOR: return simplify_logic(s, op, args[0], args[1]);
    case IR_MIX: return simplify_mix(s, op, args);
    case IR_CONVERT: return spec_node(s, args[0])->type == op->type ? as_result(s, op, args[0]) : 0;
    case IR_SWIZZLE: return simplify_swizzle(s, op, args[0]);
    case IR_INDEX: return simplify_index(s, op, args);
    case IR_KNOWN: return simplify_known(s, args[0]);
    default: return 0;
    }
}

lang_ref spec_fold(struct spec *s, const struct lang_node *op, const lang_ref *args,
                   unsigned num_args)
{
    if (!(ir_op_info(op->op)->flags & OP_PURE) || num_args > AST_MAX_OPERANDS
        || ast_is_user_type(op->type))
        return 0;
    lang_ref folded = fold_constants(s, op, args, num_args);
    if (!folded)
        folded = simplify(s, op, args);
    assert(!folded || spec_node(s, folded)->type == op->type);
    return folded || op->op != IR_MUL ? folded : shorten(s, op, args);
}
