// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_TREE_USES_H
#define MXG_TREE_USES_H

#include "tree/tree.h"

/* The facts about a body that the record of its function holds. */
struct lang_uses {
    uint32_t num_nodes;
    uint16_t flags;                 /* enum lang_function_flags, of this body alone */
    VEC(uint32_t) callees, globals; /* each once, in the order of the body */
};

/* Forgets the last body. Keeps the memory. */
void lang_uses_init(struct lang_uses *uses);

/* Adds a node without its children. `unit` is the unit of the tree; the arena is for the lists. */
void lang_uses_add(struct lang_uses *uses, const struct lang_unit *unit,
                   const struct lang_node *node, struct arena *arena);

/* Writes the lists to the unit's refs, and all to the record of the function. */
void lang_uses_record(const struct lang_uses *uses, struct lang_unit *unit,
                      struct lang_function *fn);

/* Adds the flags of the callees, which have theirs already. */
void lang_inherit_flags(const struct lang_unit *unit, struct lang_function *fn);

/* True if a list has this id. */
bool lang_has_id(const uint32_t *ids, uint32_t num, uint32_t id);

#endif
