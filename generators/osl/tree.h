// SPDX-License-Identifier: Apache-2.0
/*
 * From the closures of an element to those of OSL: the tree stays. A leaf becomes a call of one of
 * stdosl.h's closures, and a shader becomes one closure:
 *
 *     surface(bsdf, edf, opacity)   mix(transparent, bsdf + edf, opacity)
 */
#ifndef MXG_GENERATORS_OSL_TREE_H
#define MXG_GENERATORS_OSL_TREE_H

#include "spell/target.h"

struct osl_tree {
    struct shader *shader;
    struct ir_graph *graph;
    const struct closure_host *host;
    ir_ref *of;     /* per node of closure or shader type: its closure in OSL; 0: nothing */
    ir_ref thin;    /* whether the surface is a shell without an inside; 0: it is none */
    str_id unknown; /* the functions of a leaf that OSL has no closure for; 0: there is none */
};

/*
 * combine.c: closures of closures. 0 is no closure, and the neutral element of all of these; what a
 * constant decides is decided here.
 */
ir_ref osl_call(struct osl_tree *tree, const char *name, ir_type_id type, const ir_ref *args,
                unsigned n);
ir_ref osl_transparent(struct osl_tree *tree);
ir_ref osl_emission(struct osl_tree *tree, ir_ref radiance); /* of a vec3 */
ir_ref osl_scaled(struct osl_tree *tree, ir_ref closure, ir_ref factor);
ir_ref osl_sum(struct osl_tree *tree, ir_ref a, ir_ref b);
ir_ref osl_mixed(struct osl_tree *tree, ir_ref bg, ir_ref fg, ir_ref mix);
ir_ref osl_layered(struct osl_tree *tree, ir_ref top, ir_ref base);

/*
 * fresnel.c: an interface by Schlick's colours, as a conductor (`extinction`), or as a dielectric;
 * 0: it has no such input.
 */
struct osl_interface {
    ir_ref color0, color90, exponent, ior, extinction;
};
/* The reflectance at a cosine over the one head-on. */
ir_ref osl_fresnel_rise(struct ir_graph *graph, const struct osl_interface *of, ir_ref cosine);

/* leaves.c: the closure of a LEAF node; 0 where it has none, with tree->unknown set. */
ir_ref osl_leaf(struct osl_tree *tree, ir_ref leaf);

/* Is an input false, or absent? */
bool osl_is_false(const struct osl_tree *tree, ir_ref value);

/* closures.c: hooks of the target. */
extern const struct target_closures osl_closures;
bool osl_emit_node(struct shader *shader, const struct closure_host *host,
                   const struct network_output *outputs, unsigned n, str_id *out_unknown);

#endif
