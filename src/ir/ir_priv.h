// SPDX-License-Identifier: Apache-2.0
/* Declarations that the files of the ir room share. */
#ifndef MXG_IR_IR_PRIV_H
#define MXG_IR_IR_PRIV_H

#include "ir/ir.h"

/*
 * op_types.c: true if the product of these types is a product of linear algebra instead of a
 * componentwise one.
 */
bool ir_is_linear_mul(ir_type_id a, ir_type_id b);

/* The identity of a node: all of struct ir_node except flags and origin. */
struct ir_content {
    enum ir_op op;
    ir_type_id type;
    uint32_t attr; /* 0 for a constant, whose attr is the index of its words */
    uint32_t count;
    const uint32_t *data; /* the operands, or the words of a constant */
    uint32_t hash;        /* of all this: ir_find */
};

/* graph.c: the node with this content; 0 if there is none. Sets the hash. */
ir_ref ir_find(struct ir_graph *graph, struct ir_content *content);
/* Adds the node that ir_find did not find. */
ir_ref ir_add(struct ir_graph *graph, const struct ir_content *content);
/* Both. Does not fold. */
ir_ref ir_intern(struct ir_graph *graph, enum ir_op op, ir_type_id type, uint32_t attr,
                 const ir_ref *args, unsigned num_args);
/* ir_intern for a constant of a built-in type. */
ir_ref ir_intern_const(struct ir_graph *graph, ir_type_id type, const union ir_word *words);
/*
 * For ir_check: the first node with the content of node `ref`. It is `ref` itself unless the graph
 * has a duplicate.
 */
ir_ref ir_find_equal(const struct ir_graph *graph, ir_ref ref);
/* For ir_check: the flags that follow from the op of node `ref` and its operands. */
unsigned ir_flags_of(const struct ir_graph *graph, ir_ref ref);

/*
 * simplify.c: an equal, simpler node for a constructor, swizzle, member or index; 0 if there is
 * none.
 */
ir_ref ir_simplify(struct ir_graph *graph, enum ir_op op, ir_type_id type, uint32_t attr,
                   const ir_ref *args, unsigned num_args);
/* Returns `a` if it is a clamp to non-negative values, which needs no abs; otherwise 0. */
ir_ref ir_simplify_abs(const struct ir_graph *graph, ir_ref a);
/*
 * a - -1 = a + 1, a + -1 = a - 1, a / 2 = a · 0.5, if the bits are the same; 0 for other constants.
 */
ir_ref ir_simplify_by_constant(struct ir_graph *graph, enum ir_op op, ir_ref a, ir_ref b);

/* rules.c */

/*
 * A rewrite in prefix form: ops are enum ir_op, all other tokens enum rule_token. A pattern nests
 * at most RULE_DEPTH ops; a replacement is any cheaper expression.
 */
enum rule_token {
    /* any node; a repeated variable is the same node */
    RULE_A = 200,
    RULE_B,
    RULE_C,
    RULE_D,
    RULE_E,
    RULE_K, /* any constant */
    RULE_ZERO,
    RULE_ONE,
    RULE_TWO,
    RULE_HALF,
    RULE_MINUS_ONE,
    RULE_IDENTITY,
    RULE_TRUE,
    RULE_FALSE,
    RULE_END
};

enum { RULE_LENGTH = 10, RULE_DEPTH = 3, RULE_VARIABLES = RULE_E - RULE_A + 1, RULE_OPERANDS = 3 };

struct rule {
    const char *name;
    /* holds for every input; otherwise for finite values, up to rounding and the sign of 0 */
    bool exact;
    /* the first operand that is no variable, and its op; any operands: RULE_OPERANDS */
    uint8_t at, op;
    uint8_t pattern[RULE_LENGTH], replacement[RULE_LENGTH]; /* RULE_END ends them */
};

struct rule_list {
    const struct rule *rules;
    unsigned num;
};
extern const struct rule_list ir_rules[IR_NUM_OPS];

/* Applies the first matching rule to an op; 0 if none matches. */
ir_ref ir_apply_rules(struct ir_graph *graph, enum ir_op op, ir_type_id type, const ir_ref *args,
                      unsigned num_args);

/* invariants.c: NULL, or the reason why the node is invalid. */
const char *ir_node_problem(const struct ir_graph *graph, enum ir_op op, ir_type_id type,
                            uint32_t attr, const ir_ref *args, unsigned num_args);
/* Ends the program: a node breaks an invariant, which only a defect of mxgen can cause. */
_Noreturn void ir_fail(const char *where, ir_ref node, enum ir_op op, const char *problem);

#endif
