// SPDX-License-Identifier: Apache-2.0
/*
 * Lowering: executes a function body with IR nodes as values. Shared by lower.c (calls),
 * expression.c and statement.c.
 *
 * A value of any type is a sequence of leaves, which are nodes of built-in type: one for a vector,
 * one per member for a struct. Leaf 0 is "no value": an absent input, or a variable before its
 * first assignment.
 */
#ifndef MXG_LOWER_LOWER_PRIV_H
#define MXG_LOWER_LOWER_PRIV_H

#include "lower/lower.h"
#include "tree/ast.h"

enum {
    LOWER_MAX_LEAVES = 128, /* leaves of an expression, or of all arguments of a call */
    LOWER_MAX_DEPTH = 40,   /* depth of nested calls that become nodes */
    /* nodes that a branch may add if the shader computes both branches and selects one */
    LOWER_MAX_BRANCH_NODES = 12,
    LOWER_OUTER_DEPTH = 2, /* depth of the called function and its direct callees */
    /* larger functions may shrink with constant arguments; the limit of tree nodes for a trial */
    LOWER_MAX_TRIED = 200,
    LOWER_MAX_STEPS = 10000, /* tree nodes that may run in the callees of a call, all together */
    LOWER_TRIED_NODES = 10,  /* a trial fails if it adds more nodes than this to the graph */
};

struct lower_frame { /* the function being lowered */
    const struct lang_unit *layer;
    const struct lang_function *fn;
    const uint32_t *offsets; /* by slot: its first leaf; num_slots + 1 entries */
    ir_ref *leaves;          /* leaves of all slots, then of the returned value */
    uint32_t num_leaves;     /* number of all these leaves */
    unsigned nesting;        /* depth of nested bodies */
    uint32_t budget;         /* number of tree nodes that may still run */
};

struct lower {
    struct lang_unit *unit; /* the unit of the generation */
    struct ir_graph *graph;
    const struct lang_host *host;
    const ir_ref *inputs; /* inputs of an inline expression */
    struct lower_frame *frame;
    unsigned depth;
    uint32_t max_graph_nodes; /* lowering fails if the graph grows beyond this */
    uint32_t num_steps;       /* tree nodes that ran in callees */
    uint32_t num_calls;       /* CALL nodes that were built, or found in the graph */
    bool failed;              /* the function cannot become nodes; its result has no meaning */
};

static inline const struct lang_node *lower_node(const struct lower *lo, lang_ref ref)
{
    return ast_node(lo->frame->layer, ref);
}

/* The value; poison if it is undefined. Closures and shaders may be absent. */
static inline ir_ref lower_defined(struct lower *lo, ir_ref value, ir_type_id type)
{
    bool may_be_absent = ir_type_is_closure(type) || ir_type_is_shader(type);
    return value || may_be_absent ? value : ir_poison(lo->graph, type);
}

static inline uint32_t lower_leaves(const struct lower *lo, ir_type_id type)
{
    return ast_type_leaves(lo->unit, type);
}

/* expression.c */
void lower_expression(struct lower *lo, const struct lang_node *node, ir_ref *out);
ir_ref lower_single(struct lower *lo, const struct lang_node *node); /* for a built-in type */
void lower_assign(struct lower *lo, lang_ref target, const ir_ref *leaves);

/* lower.c */

/* The leaves of a value of the graph: itself, or the leaves of its members. Returns their end. */
ir_ref *lower_split(struct lower *lo, ir_type_id type, ir_ref node, ir_ref *leaves);
/* Names a value after a variable. For a struct or array: names the CALL that returns it. */
void lower_name(struct lower *lo, ir_type_id type, ir_ref first_leaf, str_id name,
                enum ir_name_rank rank);
/* Names the value of a slot after the slot. */
void lower_name_slot(struct lower *lo, uint32_t slot, enum ir_name_rank rank);

/* statement.c. True if the function has returned. */
bool lower_statements(struct lower *lo, lang_ref first);

/*
 * lower.c: leaves of the in and inout parameters to leaves of the returned value and the out and
 * inout parameters.
 */
void lower_call(struct lower *lo, uint32_t id, const ir_ref *in, ir_ref *out);

#endif
