// SPDX-License-Identifier: Apache-2.0
/*
 * budget.c: makes a tree of slabs cheaper, step by step, until it keeps to limits. A step never
 * raises the number of closures or of bytes.
 */
#ifndef MXG_SLABS_BUDGET_H
#define MXG_SLABS_BUDGET_H

#include "slabs/cost.h"

/* Operators that share slabs have a closure for each way to a slab, which may be 2^depth. */
enum { SLABS_MAX = 1000 };

struct slab_budget {
    uint32_t max_slabs, max_bytes; /* 0: no limit */
    float max_error; /* mean CIEDE2000; cheaper until the next step is above it. Below 0: none */
    uint32_t off;    /* features that are turned off before, as bits */
    bool recognises; /* all closures become slabs before */
    bool blends_all; /* in the end all operators, until a slab is left */
    /* the first steps alone, those of the document too, whatever the limits; below 0: all */
    int32_t max_steps;
};

enum slab_step_kind {
    SLAB_STEP_RECOGNISE, /* other closures become slabs */
    SLAB_STEP_ASKED,     /* the document asks to blend the parameters of an operator */
    SLAB_STEP_LAYER,     /* one slab for a layer */
    SLAB_STEP_MIX,       /* one slab for slabs side by side */
    SLAB_STEP_SUM,       /* one slab for a sum */
    SLAB_STEP_PRODUCT,   /* one slab for a slab times a colour */
    SLAB_STEP_FEATURE,
    NUM_SLAB_STEPS
};

struct slab_step {
    enum slab_step_kind kind;
    ir_ref node;               /* the operator; 0: the whole tree */
    enum slab_feature feature; /* of SLAB_STEP_FEATURE */
    struct slab_cost before, after;
    float error; /* of all steps so far, against the whole tree; below 0: unknown */
};

struct slab_report {
    VEC(struct slab_step) steps;
    struct slab_cost before, after;
    float error;        /* below 0: unknown; 0 without steps */
    bool is_met;        /* the limits hold */
    bool is_too_much;   /* more than SLABS_MAX closures: nobody may walk the tree */
    uint64_t num_steps; /* of the evaluator, for all estimates */
    ir_ref unblended;   /* an operator that the document asks to blend in vain; 0: none */
};

/* The cheaper tree. root: of any type; without slabs it stays as it is. */
ir_ref slabs_budget(struct shader *shader, const struct slabs_host *host,
                    const struct slab_budget *budget, ir_ref root, struct slab_report *out);

/* True if the budget asks for steps. */
bool slabs_is_asked(const struct slab_budget *budget);

/* The name of the node that an operator or a slab comes from. */
const char *slabs_name(const struct shader *shader, ir_ref ref);

/* "layer 'coated'", "second lobe": what a step removes. */
void slabs_describe_step(const struct shader *shader, const struct slab_step *step,
                         struct text *out);

#endif
