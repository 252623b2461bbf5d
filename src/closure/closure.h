// SPDX-License-Identifier: Apache-2.0
/*
 * From closures to effects: a tree of BSDFs becomes a flat list of leaves with weights, and the
 * list becomes what the pixel stage does: lights, environment, emission, opacity.
 */
#ifndef MXG_CLOSURE_CLOSURE_H
#define MXG_CLOSURE_CLOSURE_H

#include "shader/shader.h"

/*
 * A leaf's functions (lang ids; LANG_NONE: absent), in the order of enum family_member of
 * library/library.h.
 */
enum leaf_function {
    LEAF_EVAL,
    LEAF_ENVIRONMENT,
    LEAF_TRANSMISSION,
    LEAF_THROUGHPUT,
    LEAF_EMISSION,
    LEAF_FACTOR,
    LEAF_ABSORPTION,
    LEAF_SCATTERING,
    LEAF_ANISOTROPY,
    LEAF_ALBEDO,
    LEAF_REFRACTION,
    LEAF_SAMPLE,
    LEAF_PDF,
    NUM_LEAF_FUNCTIONS
};

/* The shaded point in world space, each part made when it is first needed. */
struct closure_point {
    ir_ref position, normal, view; /* unit normal, unit direction to the viewer */
};

/*
 * A target's own closures: closure_emit_tree. Arguments are words that tree.c explains, names of
 * the leaf's inputs for the most part.
 */
struct closure_option { /* further arguments, given where an input says something */
    const char *input;
    const char *unless; /* of a string: the only word that matters */
    const char *arguments;
};

struct closure_row {
    const char *family; /* of the leaf's functions: "mx_dielectric_bsdf" */
    const char *closure, *arguments;
    const struct closure_option *options; /* ends with input NULL; or NULL */
};

struct closure_rows {
    const struct closure_row *rows; /* ends with family NULL */
    const char *emission;           /* takes a radiance */
    const char *medium;             /* takes albedo, extinction, anisotropy */
    const char *transparent;        /* takes nothing */
    const char *output;             /* the variable that a shader writes its closure to */
};

struct closure_host {
    void *user_data;
    struct closure_point *point;
    /* The functions of the family behind a LEAF node's callee. */
    const uint32_t *(*leaf_functions)(void *user_data, uint32_t callee);
    /* The name of the input that operand `index` + 1 of a LEAF node is; NULL beyond the last. */
    const char *(*leaf_input)(void *user_data, uint32_t callee, unsigned index);
    const struct closure_rows *rows; /* the target's; NULL: it has no closures */
    const struct lang_host *lang;
    /*
     * direction from which light comes through layers, which take from it there, too; NULL: only on
     * its way out
     */
    const ir_ref *way_in;
};

/*
 * A leaf of the flattened tree. Its weight is scalar · color; scalar decides whether the leaf is
 * evaluated at all.
 */
struct closure_leaf {
    ir_ref leaf;   /* LEAF node with weight 1 */
    ir_ref scalar; /* float */
    ir_ref color;  /* vec3; 0 = white */
    /* vec3: what a volume behind lets through of the light that the leaf refracts; 0 = all */
    ir_ref medium;
};

struct closure_list {
    VEC(struct closure_leaf) leaves;
};

/*
 * Flattens a BSDF, EDF or VDF: leaves with their total weight, in the order of their nodes, equal
 * leaves merged, leaves of weight 0 gone. root 0: an empty list.
 */
void closure_flatten(struct shader *shader, const struct closure_host *host, ir_ref root,
                     struct closure_list *out);

/* How light reaches the shaded point, decided by the caller's options. */
struct closure_lighting {
    bool lights;      /* light shaders are bound */
    bool environment; /* `--environment` is not none */
    bool two_sided;   /* layers take from light on its way in, too */
};

/*
 * Writes the effects of the pixel stage for a root of any type: a material, a surface or other
 * shader, a closure (seen as a surface's), or a plain value, which is shown as a colour. False
 * where a type has no meaning in a pixel stage (the caller reports it).
 */
bool closure_emit(struct shader *shader, const struct closure_host *host,
                  const struct closure_lighting *lighting, ir_ref root);

/* Whether the root is lit as a surface: then closure_emit does not fail. */
bool closure_is_surface(const struct shader *shader, ir_ref root);

/*
 * closure_emit for targets with closures, which get the tree (host->rows). False, too, where a leaf
 * has no row.
 */
bool closure_emit_tree(struct shader *shader, const struct closure_host *host, ir_ref root);

/*
 * One node of a network: its results become outputs of these names and document types. Closures and
 * shaders of any kind are closures there, those that come from other layers are uniforms; a
 * displacement is the offset. False where a leaf has no row.
 */
struct closure_result {
    ir_ref value;
    str_id name, doc_type;
};
bool closure_emit_node(struct shader *shader, const struct closure_host *host,
                       const struct closure_result *results, unsigned n);

/* Leaves and weights as text: `mxgen inspect --closures`. */
void closure_describe(struct shader *shader, const struct closure_host *host, ir_ref root,
                      struct text *out);

#endif
