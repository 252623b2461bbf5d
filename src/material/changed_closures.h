// SPDX-License-Identifier: Apache-2.0
/* changed_closures.c: trees of closures that change, from the leaves up. */
#ifndef MXG_MATERIAL_CHANGED_CLOSURES_H
#define MXG_MATERIAL_CHANGED_CLOSURES_H

#include "build/build_priv.h"

/*
 * An operator, closure or shader over what is left of its operands, by node: the node itself,
 * another one, or 0 where nothing is left. 0: nothing is left of a closure.
 */
ir_ref build_over(struct builder *builder, ir_ref ref, const ir_ref *left);

/*
 * A closure whose leaves and slabs are others. `part` returns what takes the place of a LEAF or a
 * SLAB: itself, another closure, or 0. root 0: 0.
 */
ir_ref build_with_parts(struct builder *builder, ir_ref root,
                        ir_ref (*part)(void *user_data, ir_ref ref), void *user_data);

/* The operand of a LEAF for an input by name; 0: it has none. leaf 0: 0. */
ir_ref build_leaf_operand(struct builder *builder, ir_ref leaf, const char *name);
/* The LEAF with another value for an input; without the input it stays as it is. */
ir_ref build_with_operand(struct builder *builder, ir_ref leaf, const char *name, ir_ref value);

#endif
