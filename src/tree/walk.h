// SPDX-License-Identifier: Apache-2.0
/*
 * The walk over a tree, and the copy of a tree. Both visit children in source order and recurse:
 * the parser bounds the depth of statements and expressions (PARSE_MAX_DEPTH).
 */
#ifndef MXG_TREE_WALK_H
#define MXG_TREE_WALK_H

#include "tree/tree.h"

/* How a tree uses the value of an expression. */
enum lang_access {
    LANG_READ = 1,
    LANG_WRITE = 2, /* the target of an assignment, or an `out` argument */
    /* with LANG_WRITE: the assignment replaces only a part of the value, and keeps the others */
    LANG_PART = 4
};

/*
 * Receives a node before its children; false ends the walk. It may change the node, but not add
 * nodes.
 */
typedef bool lang_visitor(void *user_data, lang_ref ref, unsigned access);

/* Visits `root` and all nodes below it. False if the visitor ended the walk; true for root 0. */
bool lang_walk(const struct lang_unit *unit, lang_ref root, unsigned access, lang_visitor *visit,
               void *user_data);

/*
 * Receives a copy of a node, whose children are already in the new tree; returns its place there.
 */
typedef lang_ref lang_maker(void *user_data, struct lang_node node);

/* Copies `root` and all nodes below it from one unit to another; 0 for root 0. */
lang_ref lang_copy(const struct lang_unit *from, lang_ref root, struct lang_unit *to,
                   lang_maker *make, void *user_data);

/* True if an expression calls a function that assigns to its arguments. */
bool lang_has_effects(const struct lang_unit *unit, lang_ref expression);

/* True if an expression reads or writes the variable of a slot. */
bool lang_names_slot(const struct lang_unit *unit, lang_ref expression, uint32_t slot);

#endif
