// SPDX-License-Identifier: Apache-2.0
/*
 * Declarations that schedule.c and locals.c share: the data of each node from which the scheduler
 * chooses the locals.
 */
#ifndef MXG_SHADER_SCHEDULE_H
#define MXG_SHADER_SCHEDULE_H

#include "shader/shader.h"

#define NO_REGION UINT32_MAX
#define NO_EFFECT UINT32_MAX
#define MANY_EFFECTS (UINT32_MAX - 1)

enum plan_flags {
    PLAN_LOCAL = 1,           /* reads a LOCAL: sharing is limited to one effect */
    PLAN_IN_ARM = 2,          /* some use is in an expression that is evaluated conditionally */
    PLAN_LOOP = IR_NODE_LOOP, /* reads the current light or sample: must stay in its loop */
    PLAN_MOVED = 8,           /* its region is outside the region of a use */
    PLAN_STATEMENT = 16,      /* a call that must be a statement */
    PLAN_LET = 32,
    PLAN_NEIGHBOURS = 64, /* all pixels must evaluate it together */
};

struct plan { /* scheduling data of a reached node, with frequently used data of the node itself */
    uint32_t uses;
    uint32_t region;
    uint32_t first;  /* the first effect that uses it */
    uint32_t effect; /* if it reads a LOCAL: the only effect that uses it, or MANY_EFFECTS */
    uint32_t num_args, first_arg;
    uint16_t cost;  /* instructions to compute it from locals and interface variables */
    uint16_t chars; /* approximate length as an expression */
    ir_type_id type;
    uint8_t op;
    uint8_t flags; /* enum plan_flags */
};

struct region {
    uint32_t parent, header, depth; /* header: the effect that opens it */
    /* the innermost enclosing region outside all loops; the region itself if it is in none */
    uint32_t outside;
};

struct visit { /* a node during the traversal of its operands */
    ir_ref ref;
    const ir_ref *next, *end; /* the remaining operands */
};

struct scheduler {
    struct shader *shader;
    const struct ir_graph *graph;
    struct arena *arena;
    struct shader_stage *stage;
    uint8_t stage_bit;
    bool *is_reached;    /* by node */
    bool *is_needed;     /* by verbatim source */
    bool any_local;      /* some reached node reads a LOCAL */
    struct plan *plans;  /* by node; valid for reached nodes, and for the absent one */
    VEC(ir_ref) reached; /* operands before users; with capacity for all nodes */
    VEC(ir_ref) lets;    /* the reached nodes that become locals */
    VEC(struct visit) visits;
    VEC(struct region) regions;
    VEC(uint32_t) region_of; /* the region of each effect */
    VEC(uint32_t) called;    /* IR functions that the current effects call */
    uint32_t first_discard;
};

static inline struct plan *plan_of(const struct scheduler *s, ir_ref ref)
{
    return &s->plans[ref];
}

static inline const struct ir_node *node_of(const struct scheduler *s, const struct plan *plan)
{
    return ir_get(s->graph, (ir_ref)(plan - s->plans));
}

static inline const ir_ref *args_of(const struct scheduler *s, const struct plan *plan)
{
    return s->graph->args.items + plan->first_arg;
}

static inline bool is_call(enum ir_op op)
{
    return op == IR_CALL || op == IR_VERBATIM || op == IR_GRAPH_CALL;
}

/* locals.c: sets PLAN_LET of the nodes that become locals. */
void choose_locals(struct scheduler *s);

#endif
