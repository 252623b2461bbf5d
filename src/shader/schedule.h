// SPDX-License-Identifier: Apache-2.0
/*
 * Inside the scheduler: what is known of each node (schedule.c), from which its locals are chosen
 * (locals.c).
 */
#ifndef MXG_SHADER_SCHEDULE_H
#define MXG_SHADER_SCHEDULE_H

#include "shader/shader.h"

#define NO_REGION UINT32_MAX
#define NO_EFFECT UINT32_MAX
#define MANY_EFFECTS (UINT32_MAX - 1)

enum plan_flags {
    PLAN_LOCAL = 1,           /* reads a LOCAL: may be shared within one effect only */
    PLAN_IN_ARM = 2,          /* some use stands in an expression that is not always evaluated */
    PLAN_LOOP = IR_NODE_LOOP, /* reads the light or sample at hand: may not leave its loop */
    PLAN_MOVED = 8,           /* its region lies outside of that of a use */
    PLAN_STATEMENT = 16,      /* a call that cannot stand in an expression */
    PLAN_LET = 32,
    PLAN_NEIGHBOURS = 64, /* to be evaluated by all pixels together */
};

struct plan { /* what is known of a reached node, and what of the node itself is often asked for */
    uint32_t uses;
    uint32_t region;
    uint32_t first;  /* the first effect that needs it */
    uint32_t effect; /* where it reads a LOCAL: the only effect that needs it, or MANY_EFFECTS */
    uint32_t num_args, first_arg;
    uint16_t cost;  /* instructions to compute it from locals and interface variables */
    uint16_t chars; /* its length as an expression, about */
    ir_type_id type;
    uint8_t op;
    uint8_t flags; /* enum plan_flags */
};

struct region {
    uint32_t parent, header, depth; /* header: the effect that opens it */
    /* the innermost region around it that is in no loop: itself where it is in none */
    uint32_t outside;
};

struct visit { /* a node whose operands are being collected */
    ir_ref ref;
    const ir_ref *next, *end; /* those that are left */
};

struct scheduler {
    struct shader *shader;
    const struct ir_graph *graph;
    struct arena *arena;
    struct shader_stage *stage;
    uint8_t stage_bit;
    bool *is_reached;    /* by node */
    bool any_local;      /* a node that reads a LOCAL has been reached */
    struct plan *plans;  /* by node; of reached nodes only, and of the absent one */
    VEC(ir_ref) reached; /* operands before users; there is room for all nodes */
    VEC(ir_ref) lets;    /* those of them that become locals */
    VEC(struct visit) visits;
    VEC(struct region) regions;
    VEC(uint32_t) region_of; /* the region that each effect stands in */
    VEC(uint32_t) called;    /* IR functions called from the effects at hand */
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
