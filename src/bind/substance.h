// SPDX-License-Identifier: Apache-2.0
/* The parts of a layer's material whose inputs and tokens outputs and variants may drive. */
#ifndef MXG_BIND_SUBSTANCE_H
#define MXG_BIND_SUBSTANCE_H

#include "library/library.h"

struct substance {
    const struct library *lib;
    struct arena *arena;
    elem_id material;             /* 0: there is none */
    VEC(elem_id) graphs, shaders; /* plain nodegraphs, and nodes that are shaders */
    VEC(elem_id) order;           /* all elements that were visited, also the material */
    struct table met;             /* those in `order` */
    VEC(elem_id) open;            /* nodes to visit */
    struct resolve_out resolved;
    struct diag_list ignored;
};

/* Finds the substance of what an assignment names. */
void substance_find(struct substance *s, const struct library *lib, elem_id target,
                    struct arena *arena);
/* Adds what an input is connected to. */
void substance_follow(struct substance *s, elem_id input);
struct binding substance_resolve(struct substance *s, elem_id port);

/*
 * True if a variant set is for a node: its `node` lists the category, and its `nodedef` the
 * definition that the node has. Without either it is for all nodes.
 */
bool substance_set_takes(struct substance *s, elem_id set, elem_id node);
/* True if a variant set is for the material or one of the shaders. */
bool substance_set_applies(struct substance *s, elem_id set);

/* The node of a material that an assignment names: itself, or in a nodegraph; 0: it has none. */
elem_id bind_material_node(const struct library *lib, elem_id target, struct diag_list *ignored);

#endif
