// SPDX-License-Identifier: Apache-2.0
/*
 * Lowering: a function body is executed with IR nodes for values. Shared by lower.c (calls),
 * expression.c and statement.c.
 *
 * A value of any type is a row of leaves, nodes of built-in type: one for a vector, one per member
 * for a struct. 0 stands for what has no value: an absent input, a variable before its first
 * assignment.
 */
#ifndef MXG_LOWER_LOWER_PRIV_H
#define MXG_LOWER_LOWER_PRIV_H

#include "lower/lower.h"
#include "tree/ast.h"

enum {
    LOWER_MAX_LEAVES = 128, /* of an expression, or of all arguments of a call */
    LOWER_MAX_DEPTH = 40,   /* of calls lowered inside of calls */
    /* that a branch may add where both are computed and one is selected */
    LOWER_MAX_BRANCH_NODES = 12,
    LOWER_OUTER_DEPTH = 2, /* the called function, and those that it calls */
    /* larger functions may be small with the constants at hand; these are tried … */
    LOWER_MAX_TRIED = 200,
    LOWER_TRIED_NODES = 10, /* … and given up when they add more than this */
};

struct lower_frame { /* the function being lowered */
    const struct lang_unit *layer;
    const struct lang_function *fn;
    const uint32_t *offsets; /* by slot, in leaves; num_slots + 1 of them */
    ir_ref *leaves;          /* of all slots, and behind them of the returned value */
    uint32_t num_leaves;     /* of all of these */
    unsigned nesting;        /* of bodies in bodies */
    uint32_t budget;         /* of tree nodes that may still be executed */
};

struct lower {
    struct lang_unit *unit; /* the generation's */
    struct ir_graph *graph;
    const struct lang_host *host;
    const ir_ref *inputs; /* of an inline expression */
    struct lower_frame *frame;
    unsigned depth;
    uint32_t max_graph_nodes; /* a body that makes the graph larger than this is not worth it */
    uint32_t num_calls;       /* that were built, or found in the graph */
    bool failed;              /* the function cannot become nodes: the result is of no use */
};

static inline const struct lang_node *lower_node(const struct lower *lo, lang_ref ref)
{
    return ast_node(lo->frame->layer, ref);
}

static inline uint32_t lower_leaves(const struct lower *lo, ir_type_id type)
{
    return ast_type_leaves(lo->unit, type);
}

/* expression.c */
void lower_expression(struct lower *lo, const struct lang_node *node, ir_ref *out);
ir_ref lower_single(struct lower *lo, const struct lang_node *node); /* of a built-in type */
void lower_assign(struct lower *lo, lang_ref target, const ir_ref *leaves);

/* lower.c: the graph's form of a type of the language. */
ir_type_id lower_graph_type(const struct lang_unit *unit, struct ir_graph *graph, ir_type_id type);

/* Names a value of the type after a variable; a struct or array: the call that gives it. */
void lower_name(struct lower *lo, ir_type_id type, ir_ref first_leaf, str_id name,
                enum ir_name_rank rank);
/* The same for the value of a slot, whose name it is. */
void lower_name_slot(struct lower *lo, uint32_t slot, enum ir_name_rank rank);

/* statement.c. True where the function has returned. */
bool lower_statements(struct lower *lo, lang_ref first);

/*
 * lower.c: leaves of the in and inout parameters to leaves of the returned value and the out and
 * inout parameters.
 */
void lower_call(struct lower *lo, uint32_t id, const ir_ref *in, ir_ref *out);

#endif
