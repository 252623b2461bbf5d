// SPDX-License-Identifier: Apache-2.0
/*
 * steps.c: what a budget may do next to a tree of slabs: blend the parameters of an operator, or
 * turn a feature off. No step raises the number of closures or of bytes.
 */
#ifndef MXG_SLABS_STEPS_H
#define MXG_SLABS_STEPS_H

#include "slabs/blend.h"
#include "slabs/budget.h"
#include "slabs/estimate.h"

/* A tree that becomes cheaper. */
struct slab_saver {
    struct shader *shader;
    struct ir_graph *graph;
    const struct slabs_host *host;
    struct slab_blend blend;
    struct slab_eye *eye; /* sees the tree before all steps; NULL: nobody estimates */
    uint32_t unseen;      /* features of that tree that estimates do not see */
    ir_ref root;
    struct slab_spots spots; /* of the root */
    struct slab_cost cost;   /* of the root */
};

/* A step that could come next. */
struct slab_candidate {
    struct slab_step step; /* without costs and error */
    ir_ref root;           /* after it; 0: there is none */
    uint32_t depth;
};

/* Prepares a saver for a tree before all steps; off: features that blends do not make. */
struct slab_saver slab_saver_of(struct shader *shader, const struct slabs_host *host, uint32_t off,
                                ir_ref root);
/* Goes on with another tree. */
void slab_saver_set_root(struct slab_saver *saver, ir_ref root);
/* Returns what another tree costs. */
struct slab_cost slab_saver_cost(const struct slab_saver *saver, ir_ref root);
/* The estimated error of a tree against the one before all steps; below 0: unknown. */
float slab_saver_error(const struct slab_saver *saver, ir_ref root);

/* True if a tree keeps to the most closures of a budget, and to the most bytes. */
bool slab_keeps_slabs(const struct slab_budget *budget, struct slab_cost cost);
bool slab_keeps_bytes(const struct slab_budget *budget, struct slab_cost cost);
/* True if a tree takes more closures or more bytes. */
bool slab_cost_is_higher(struct slab_cost cost, struct slab_cost than);

/* Which operators of two slabs may become one. */
enum slab_choice {
    SLAB_CHEAPER, /* if the tree is cheaper then */
    SLAB_ASKED,   /* those that the document asks for, if the tree is not costlier then */
    SLAB_ANY      /* all, whatever the tree costs then */
};
/* The deepest of them; where operators share slabs, several may go in one step. */
struct slab_candidate slab_next_blend(const struct slab_saver *saver, enum slab_choice choice);
/* An operator that the document asks to blend; 0: there is none. */
ir_ref slab_find_asked(const struct slab_saver *saver);

/* The tree without a feature. */
struct slab_candidate slab_feature_step(const struct slab_saver *saver, enum slab_feature feature);
/* Without the first feature that is stored. */
struct slab_candidate slab_next_feature(const struct slab_saver *saver);

/* All steps that make the tree cheaper; the caller gives an empty vector. */
struct slab_candidates {
    VEC(struct slab_candidate) items;
};
void slab_find_steps(const struct slab_saver *saver, struct slab_candidates *out);

#endif
