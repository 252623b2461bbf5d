// SPDX-License-Identifier: Apache-2.0
/*
 * slab_nodes.c: the closures and shaders of a tree. A search of trees makes the graph large, but
 * each tree has few nodes, so work on one goes through this list.
 */
#ifndef MXG_SLABS_SLAB_NODES_H
#define MXG_SLABS_SLAB_NODES_H

#include "shader/shader.h"

struct slab_nodes {
    VEC(ir_ref) items; /* [0] is 0; operands before their operators, so the root is the last one */
};

/* root 0: there are none. The arena keeps the list. */
void slabs_find_nodes(const struct ir_graph *graph, ir_ref root, struct arena *arena,
                      struct slab_nodes *out);

/* The index of a node; 0: the tree does not have it. */
uint32_t slab_node_at(const struct slab_nodes *nodes, ir_ref ref);

/*
 * The tree with other closures in the places of some. by: per node; 0: it stays. An operand that
 * takes the place of its operator has its own replacements.
 */
ir_ref slabs_replace(struct ir_graph *graph, const struct slab_nodes *nodes, const ir_ref *by,
                     struct arena *scratch);

#endif
