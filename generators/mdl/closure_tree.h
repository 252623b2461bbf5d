// SPDX-License-Identifier: Apache-2.0
/*
 * Rewrites the closures of an element as those of MDL. A closure becomes the parts of a material: a
 * bsdf, edfs with their radiance, coefficients of a volume, a hair_bsdf.
 */
#ifndef MXG_GENERATORS_MDL_CLOSURE_TREE_H
#define MXG_GENERATORS_MDL_CLOSURE_TREE_H

#include "generators/mdl/mdl.h"

/* Emission: an edf times a colour, in a list. */
struct mdl_light {
    ir_ref edf;      /* 0: that of even emission */
    ir_ref radiance; /* vec3: exitance of the edf over π */
    struct mdl_light *next;
};

/* A closure; members are 0 where it has no such part. */
struct mdl_parts {
    ir_ref bsdf, hair;
    const struct mdl_light *light;
    ir_ref absorption, scattering; /* vec3, per unit of the scene */
    ir_ref anisotropy;             /* float, of the scattering */
    ir_ref into;                   /* float: the weight of what goes into the body */
};

struct mdl_tree {
    struct shader *shader;
    struct ir_graph *graph;
    const struct closure_host *host;
    struct mdl_parts *of; /* per node of closure type */
    ir_ref ior;           /* vec3 of what light is refracted into; 0: nothing refracts */
    bool has_new_sheen;   /* the version has df::microflake_sheen_bsdf */
    struct table counted; /* the leaves among the shader's closures */
    const char *lacks;    /* what MDL lacks (struct target_closures); NULL: nothing */
};

/* A text that lives as long as the shader. */
const char *mdl_lacks(struct mdl_tree *tree, const char *format, const char *name);

/* ---- combine.c: closures of closures; a bsdf 0 is black and absorbs nothing ---- */

/* A closure by its text, with $0, $1… for arguments. The text lives as long as the shader. */
ir_ref mdl_call(struct mdl_tree *tree, const char *form, ir_type_id type, const ir_ref *args,
                unsigned n);
ir_ref mdl_scaled(struct mdl_tree *tree, ir_ref bsdf, ir_ref factor); /* float or vec3 */
ir_ref mdl_sum(struct mdl_tree *tree, ir_ref a, ir_ref b);
ir_ref mdl_mixed(struct mdl_tree *tree, ir_ref bg, ir_ref fg, ir_ref mix);
/* The top scatters, and the base by what the top lets through at seven angles (vec3 each). */
enum { MDL_ANGLES = 7 };
ir_ref mdl_attenuated(struct mdl_tree *tree, ir_ref base, const ir_ref *through);
/* Straight on, in a colour. */
ir_ref mdl_transparent(struct mdl_tree *tree, ir_ref color);

/*
 * A factor or mix weighs what a surface scatters, not the medium behind it; of closures that are
 * media (`is_medium`) it weighs the coefficients. A body that light enters through several closures
 * has the mean of their media, of which refraction alone has none.
 */
struct mdl_parts mdl_parts_scaled(struct mdl_tree *tree, struct mdl_parts parts, ir_ref factor,
                                  bool is_medium);
struct mdl_parts mdl_parts_sum(struct mdl_tree *tree, struct mdl_parts a, struct mdl_parts b);
struct mdl_parts mdl_parts_mixed(struct mdl_tree *tree, struct mdl_parts bg, struct mdl_parts fg,
                                 ir_ref mix, bool is_medium);
const struct mdl_light *mdl_light(struct mdl_tree *tree, ir_ref edf, ir_ref radiance);

/* ---- leaves.c ---- */

/* The parts of a LEAF over nothing. */
struct mdl_parts mdl_leaf(struct mdl_tree *tree, ir_ref leaf);
/* True if a leaf lies over any base by a closure of MDL, or by its weight. */
bool mdl_leaf_covers(struct mdl_tree *tree, ir_ref leaf);
/* The bsdf of a leaf over a base, for a leaf that covers. */
ir_ref mdl_leaf_over(struct mdl_tree *tree, ir_ref leaf, ir_ref base);
/* The input of a leaf by its name; 0: it has none. */
ir_ref mdl_leaf_input(const struct mdl_tree *tree, ir_ref leaf, const char *name);

#endif
