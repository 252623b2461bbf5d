// SPDX-License-Identifier: Apache-2.0
#include "slabs/slab_nodes.h"

#include "base/hash.h"
#include "base/num.h"
#include "base/table.h"

#include <stdlib.h>

struct finder {
    struct arena *arena;
    struct slab_nodes *nodes;
    struct table known; /* their indices */
};

static void add(struct finder *f, ir_ref ref)
{
    uint32_t hash = hash_bytes(&ref, sizeof ref);
    for (uint32_t at = hash, found; (found = table_next(&f->known, hash, &at));)
        if (f->nodes->items.items[found] == ref)
            return;
    vec_push(f->arena, &f->nodes->items, ref);
    table_add(&f->known, f->arena, hash, f->nodes->items.len - 1);
}

void slabs_find_nodes(const struct ir_graph *g, ir_ref root, struct arena *arena,
                      struct slab_nodes *out)
{
    struct finder f = {.arena = arena, .nodes = out};
    *out = (struct slab_nodes){0};
    vec_push(f.arena, &out->items, 0);
    if (root)
        add(&f, root);
    for (uint32_t i = 1; i < out->items.len; i++) {
        ir_ref ref = out->items.items[i];
        for (uint32_t k = 0; k < ir_get(g, ref)->num_args; k++) {
            ir_ref arg = ir_arg(g, ref, k);
            ir_type_id type = arg ? ir_type_of(g, arg) : IR_TYPE_VOID;
            if (ir_type_is_closure(type) || ir_type_is_shader(type))
                add(&f, arg);
        }
    }
    num_sort(out->items.items, out->items.len);
}

uint32_t slab_node_at(const struct slab_nodes *nodes, ir_ref ref)
{
    uint32_t first = 0, end = nodes->items.len;
    while (first < end) {
        uint32_t middle = first + (end - first) / 2;
        if (nodes->items.items[middle] == ref)
            return middle;
        if (nodes->items.items[middle] < ref)
            first = middle + 1;
        else
            end = middle;
    }
    return 0;
}

/* The operand of a node, or its copy. */
static ir_ref operand_of(const struct ir_graph *g, const struct slab_nodes *nodes, ir_ref ref,
                         uint32_t operand, const ir_ref *copies)
{
    uint32_t at = slab_node_at(nodes, ir_arg(g, ref, operand));
    return at ? copies[at] : ir_arg(g, ref, operand);
}

/* The node with the copies of its operands. */
static ir_ref copy_of(struct ir_graph *g, const struct slab_nodes *nodes, ir_ref ref,
                      const ir_ref *copies, struct arena *scratch)
{
    const struct ir_node node = *ir_get(g, ref);
    bool is_changed = false;
    for (uint32_t i = 0; i < node.num_args && !is_changed; i++)
        is_changed = operand_of(g, nodes, ref, i, copies) != ir_arg(g, ref, i);
    if (!is_changed)
        return ref;
    ir_ref *args = ARENA_ARRAY(scratch, ir_ref, node.num_args);
    for (uint32_t i = 0; i < node.num_args; i++)
        args[i] = operand_of(g, nodes, ref, i, copies);
    return ir_copy(g, ref, args);
}

ir_ref slabs_replace(struct ir_graph *g, const struct slab_nodes *nodes, const ir_ref *by,
                     struct arena *scratch)
{
    ir_ref *copies = ARENA_ARRAY(scratch, ir_ref, nodes->items.len);
    for (uint32_t i = 1; i < nodes->items.len; i++) {
        uint32_t at = by[i] < nodes->items.items[i] ? slab_node_at(nodes, by[i]) : 0;
        if (at)
            copies[i] = copies[at];
        else
            copies[i] = by[i] ? by[i] : copy_of(g, nodes, nodes->items.items[i], copies, scratch);
    }
    return copies[nodes->items.len - 1];
}
