// SPDX-License-Identifier: Apache-2.0
/*
 * Rewrites the closures of an element as OSL closures and keeps the tree. A leaf becomes a call of
 * a closure of stdosl.h, and a shader becomes one closure:
 *
 *     surface(bsdf, edf, opacity)   →   mix(transparent, bsdf + edf, opacity)
 */
#ifndef MXG_GENERATORS_OSL_CLOSURE_TREE_H
#define MXG_GENERATORS_OSL_CLOSURE_TREE_H

#include "spell/target.h"

struct osl_tree {
    struct shader *shader;
    struct ir_graph *graph;
    const struct closure_host *host;
    ir_ref *of;           /* per node of closure or shader type: its closure in OSL; 0: none */
    uint8_t *slabs;       /* per node: it has a slab, whose layers do not weigh as those of OSL */
    ir_ref thin;          /* true if the surface is a thin-walled shell; 0: false */
    bool seen_through;    /* rays come straight through the surface, and see it from behind */
    uint32_t *aovs;       /* the outputs of the shader's AOVs */
    struct table counted; /* the leaves among the shader's closures */
    const char *lacks;    /* what OSL lacks for a leaf (struct target_closures); NULL: nothing */
};

/*
 * combine.c: closures of closures. 0 is no closure, the neutral element of these functions. They
 * simplify for constants.
 */
ir_ref osl_call(struct osl_tree *tree, const char *name, ir_type_id type, const ir_ref *args,
                unsigned n);
ir_ref osl_transparent(struct osl_tree *tree);
ir_ref osl_emission(struct osl_tree *tree, ir_ref radiance); /* emission of a vec3 */
ir_ref osl_scaled(struct osl_tree *tree, ir_ref closure, ir_ref factor);
ir_ref osl_sum(struct osl_tree *tree, ir_ref a, ir_ref b);
ir_ref osl_mixed(struct osl_tree *tree, ir_ref bg, ir_ref fg, ir_ref mix);
ir_ref osl_layered(struct osl_tree *tree, ir_ref top, ir_ref base);

/* leaves.c: the closure of a LEAF node; 0, and tree->lacks, if it has none. */
ir_ref osl_leaf(struct osl_tree *tree, ir_ref leaf);

/* True if closures stand for BSDFs of a family with these functions, which has no row of
 * closures.def. */
bool osl_fits_family(const char *family, const uint32_t *functions);
/* True for a BSDF whose value is known, but no closure: fitted.c makes closures for it. */
bool osl_is_fitted(const struct osl_tree *tree, ir_ref leaf);
/* fitted.c: the sum of closures that is closest to such a leaf; 0, and tree->lacks, if none is. */
ir_ref osl_fitted(struct osl_tree *tree, ir_ref leaf);

/* combine.c: true if the ray comes from behind the surface. */
ir_ref osl_behind(struct osl_tree *tree);

/* True if an input is false or absent. */
bool osl_is_false(const struct osl_tree *tree, ir_ref value);

/* closures.c: hooks of the target. */
extern const struct target_closures osl_closures;
bool osl_emit_node(struct shader *shader, const struct closure_host *host,
                   const struct network_output *outputs, unsigned n, const char **out_lacks);

#endif
