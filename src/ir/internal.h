// SPDX-License-Identifier: Apache-2.0
/* What the files of this folder share among themselves. */
#ifndef MXG_IR_INTERNAL_H
#define MXG_IR_INTERNAL_H

#include "ir/ir.h"

/* types.c: whether a product of these is one of linear algebra, not a componentwise one. */
bool ir_is_linear_mul(ir_type_id a, ir_type_id b);

/* graph.c: the node with this content, which is added where there is none. Nothing is folded. */
ir_ref ir_intern(struct ir_graph *graph, enum ir_op op, ir_type_id type, uint32_t attr,
                 const ir_ref *args, unsigned num_args);
/* The same for a constant of a built-in type. */
ir_ref ir_intern_const(struct ir_graph *graph, ir_type_id type, const union ir_word *words);
/* The node with the content of node `ref`: itself, unless it stands twice. For ir_check. */
ir_ref ir_find_equal(const struct ir_graph *graph, ir_ref ref);

/* simplify.c: a simpler node for an op that builds or takes apart; 0 where there is none. */
ir_ref ir_simplify(struct ir_graph *graph, enum ir_op op, ir_type_id type, uint32_t attr,
                   const ir_ref *args, unsigned num_args);
/*
 * A value that is clamped to 0 and more is its own absolute value; 0 for any other value.
 */
ir_ref ir_simplify_abs(const struct ir_graph *graph, ir_ref a);
/*
 * a - -1 = a + 1, a + -1 = a - 1, a / 2 = a · 0.5, each bit by bit the same; 0 where `b` is no such
 * constant.
 */
ir_ref ir_simplify_by_constant(struct ir_graph *graph, enum ir_op op, ir_ref a, ir_ref b);

/* rules.c */

/*
 * A rewrite in prefix form: ops are enum ir_op, everything else an enum rule_token. A pattern is an
 * op whose operands are variables, constants, or ops of such; a replacement is anything that is
 * cheaper.
 */
enum rule_token {
    /* any node; the same one where the variable stands twice */
    RULE_A = 200,
    RULE_B,
    RULE_C,
    RULE_D,
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

enum { RULE_LENGTH = 10 };

struct rule {
    const char *name;
    /* what must be present among a node's operands for the rule to be worth trying */
    uint64_t needs;
    /*
     * holds for every input; otherwise where all values are finite, and up to rounding and the sign
     * of 0
     */
    bool exact;
    uint8_t pattern[RULE_LENGTH], replacement[RULE_LENGTH]; /* ended by RULE_END */
};

struct rule_list {
    const struct rule *rules;
    unsigned num;
    uint64_t any; /* what any of them needs */
};
extern const struct rule_list ir_rules[IR_NUM_OPS];

/*
 * A filter, since almost every node is left as it is: a rule needs each op and constant of its
 * pattern among the operands, or two equal operands where it has none. Sets are sets of bits: a few
 * ops share one, each kind of constant has its own.
 */
enum { IR_OP_BITS = 32 };
#define IR_OP_BIT(op) ((uint64_t)1 << ((op) % IR_OP_BITS))
#define IR_EQUAL_BIT ((uint64_t)1 << 63)
uint64_t ir_constant_bits(const struct ir_graph *graph, const struct ir_node *node);

/*
 * What the first rule that fits makes of an op with these bits present among its operands; 0 where
 * none does.
 */
ir_ref ir_apply_rules(struct ir_graph *graph, enum ir_op op, ir_type_id type, const ir_ref *args,
                      unsigned num_args, uint64_t present);

/* check.c: NULL, or why no node may look like this. */
const char *ir_node_problem(const struct ir_graph *graph, enum ir_op op, ir_type_id type,
                            uint32_t attr, const ir_ref *args, unsigned num_args);

#endif
