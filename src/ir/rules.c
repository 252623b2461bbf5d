// SPDX-License-Identifier: Apache-2.0
/* rules: the table of algebraic rules (rules.def) and its interpreter. */
#include "ir/ir_priv.h"

#include <assert.h>

static_assert((unsigned)IR_NUM_OPS <= (unsigned)RULE_A, "ops and rule tokens share a byte");

/* The names that rules.def uses: ops and tokens without their prefixes. */
enum {
#define OP(ID, text, arity, rule, flags, doc) ID = IR_##ID,
#include "ir/ops.def"
#undef OP
    A = RULE_A,
    B = RULE_B,
    C = RULE_C,
    D = RULE_D,
    E = RULE_E,
    K = RULE_K,
    ZERO = RULE_ZERO,
    ONE = RULE_ONE,
    TWO = RULE_TWO,
    HALF = RULE_HALF,
    MINUS_ONE = RULE_MINUS_ONE,
    IDENTITY = RULE_IDENTITY,
    TRUE_ = RULE_TRUE,
    FALSE_ = RULE_FALSE
};

enum { FINITE, EXACT };

#define TOKENS(...) __VA_ARGS__, RULE_END
#define OPERANDS(...) __VA_ARGS__, A, A
#define IS_VARIABLE(token) ((token) >= A && (token) < K)
#define OP_OF(token) ((token) < A ? (token) : CONST)
/*
 * The members `at` and `op` of a rule. Operands behind one that has operands of its own stand
 * elsewhere in the pattern, so the first one is taken.
 */
#define CHECKED_(op, a, b, c, ...) \
    !IS_VARIABLE(a)   ? 0 \
    : !IS_VARIABLE(b) ? 1 \
    : !IS_VARIABLE(c) ? 2 \
                      : RULE_OPERANDS, \
        OP_OF(!IS_VARIABLE(a)   ? (a) \
              : !IS_VARIABLE(b) ? (b) \
              : !IS_VARIABLE(c) ? (c) \
                                : K)
#define CHECKED(...) CHECKED_(__VA_ARGS__, 0)
#define RULE(name, exactness, pattern, replacement) \
    {#name, exactness, CHECKED(OPERANDS pattern), {TOKENS pattern}, {TOKENS replacement}},

#define RULES(op, ...) static const struct rule rules_of_##op[] = {__VA_ARGS__};
#include "ir/rules.def"
#undef RULES

const struct rule_list ir_rules[IR_NUM_OPS] = {
#define RULES(op, ...) [IR_##op] = {rules_of_##op, sizeof rules_of_##op / sizeof *rules_of_##op},
#include "ir/rules.def"
#undef RULES
};

static float token_value(unsigned token)
{
    /* in the order of the tokens */
    static const float values[] = {0.0f, 1.0f, 2.0f, 0.5f, -1.0f, 1.0f, 1.0f, 0.0f};
    return values[token - RULE_ZERO];
}

struct match {
    const struct ir_graph *graph;
    bool exact;                       /* the rule is exact */
    bool linear;                      /* the root is a product of linear algebra */
    ir_ref bound[RULE_VARIABLES + 1]; /* nodes bound to A B C D E K; 0 = not bound yet */
};

static bool has_word(const struct match *m, unsigned token, ir_type_id scalar, union ir_word w)
{
    float value = token_value(token);
    switch (scalar) {
    case IR_TYPE_FLOAT:
        /* x - -0 is not x: only +0 is exact */
        return w.f == value && (w.u == 0 || value != 0.0f || !m->exact);
    case IR_TYPE_INT: return (float)w.i == value;
    case IR_TYPE_UINT: return (float)w.u == value;
    default: return false;
    }
}

static bool match_constant(const struct match *m, unsigned token, const struct ir_node *node)
{
    const union ir_word *words = m->graph->words.items + node->attr;
    if (node->type == IR_TYPE_BOOL || token >= RULE_TRUE)
        return node->type == IR_TYPE_BOOL && token >= RULE_TRUE
               && words[0].u == (token == RULE_TRUE);
    const struct ir_type_info *info = ir_type_info(node->type);
    bool identity = token == RULE_IDENTITY;
    if (identity ? !m->linear || info->columns == 1 : m->linear && token != RULE_ZERO)
        return false;
    for (unsigned i = 0; i < info->components; i++) {
        bool off_diagonal = identity && i % (info->columns + 1u) != 0;
        if (!has_word(m, off_diagonal ? RULE_ZERO : token, info->scalar, words[i]))
            return false;
    }
    return true;
}

static bool match_leaf(struct match *m, unsigned token, ir_ref ref)
{
    const struct ir_node *node = ir_get(m->graph, ref);
    if (token >= RULE_K && node->op != IR_CONST)
        return false;
    if (token > RULE_K)
        return match_constant(m, token, node);
    assert(token >= RULE_A);
    ir_ref *bound = &m->bound[token - RULE_A];
    if (!*bound)
        *bound = ref;
    return *bound == ref;
}

struct operands { /* of an op of the pattern: those not compared yet */
    const ir_ref *next, *end;
};

static bool match(struct match *m, const struct rule *rule, const ir_ref *args, unsigned num_args)
{
    struct operands open[RULE_DEPTH] = {{args, args + num_args}};
    const uint8_t *token = rule->pattern + 1;
    memset(m->bound, 0, sizeof m->bound);
    for (unsigned depth = 1; depth > 0;) {
        if (open[depth - 1].next == open[depth - 1].end) {
            depth--;
            continue;
        }
        ir_ref ref = *open[depth - 1].next++;
        unsigned t = *token++;
        if (t >= RULE_A) {
            if (!match_leaf(m, t, ref))
                return false;
            continue;
        }
        const struct ir_node *inner = ir_get(m->graph, ref);
        assert(t < IR_NUM_OPS && depth < RULE_DEPTH);
        if (inner->op != t)
            return false;
        const ir_ref *inner_args = m->graph->args.items + inner->first_arg;
        open[depth++] = (struct operands){inner_args, inner_args + inner->num_args};
    }
    return true;
}

static ir_ref build_op(struct ir_graph *graph, enum ir_op op, const ir_ref *args)
{
    switch (ir_op_info(op)->arity) {
    case 1: return ir_op1(graph, op, args[0]);
    case 2: return ir_op2(graph, op, args[0], args[1]);
    default: return ir_op3(graph, op, args[0], args[1], args[2]);
    }
}

/* Spreads a scalar to a vector type; 0 if it would have to become a matrix. */
static ir_ref widen(struct ir_graph *graph, ir_type_id type, ir_ref ref)
{
    if (ir_type_of(graph, ref) == type)
        return ref;
    return ir_type_is_matrix(type) ? 0 : ir_build(graph, IR_CONSTRUCT, type, 0, &ref, 1);
}

/* Builds the replacement: prefix form read backwards needs only a stack of operands. */
static ir_ref replace(struct ir_graph *graph, const struct rule *rule, ir_type_id type,
                      const ir_ref *bound)
{
    const uint8_t *tokens = rule->replacement;
    if (tokens[0] >= RULE_ZERO)
        return ir_const_splat(graph, type, token_value(tokens[0]));
    ir_ref stack[RULE_LENGTH + 1] = {0};
    unsigned top = RULE_LENGTH, length = 0;
    while (tokens[length] != RULE_END)
        length++;
    while (length-- > 0) {
        unsigned token = tokens[length];
        ir_ref ref;
        if (token < RULE_A) {
            ref = build_op(graph, (enum ir_op)token, &stack[top]);
            top += (unsigned)ir_op_info((enum ir_op)token)->arity;
        } else {
            ref = token < RULE_K
                      ? bound[token - RULE_A]
                      : ir_const_splat(graph, ir_type_info(type)->scalar, token_value(token));
        }
        if (!ref) /* the types do not fit, for example if A is a vector and B a scalar */
            return 0;
        assert(top > 0);
        stack[--top] = ref;
    }
    assert(top == RULE_LENGTH - 1);
    return widen(graph, type, stack[top]);
}

ir_ref ir_apply_rules(struct ir_graph *graph, enum ir_op op, ir_type_id type, const ir_ref *args,
                      unsigned num_args)
{
    const struct rule *rules = ir_rules[op].rules, *end = rules + ir_rules[op].num;
    struct match m = {.graph = graph};
    uint8_t ops[RULE_OPERANDS + 1] = {[RULE_OPERANDS] = IR_CONST};
    for (unsigned i = 0; rules < end && i < num_args; i++)
        ops[i] = ir_get(graph, args[i])->op;
    if (op == IR_MUL)
        m.linear = ir_is_linear_mul(ir_type_of(graph, args[0]), ir_type_of(graph, args[1]));
    for (const struct rule *rule = rules; rule < end; rule++) {
        if (ops[rule->at] != rule->op)
            continue;
        m.exact = rule->exact;
        if ((graph->exact && !rule->exact) || !match(&m, rule, args, num_args))
            continue;
        ir_ref result = replace(graph, rule, type, m.bound);
        if (result)
            return result;
    }
    return 0;
}
