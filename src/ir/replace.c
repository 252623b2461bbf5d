// SPDX-License-Identifier: Apache-2.0
#include "ir/ir.h"

ir_ref ir_replace(struct ir_graph *graph, ir_ref root, ir_ref from, ir_ref to, struct arena *arena)
{
    uint8_t *needed = ir_mark(graph, &root, 1, arena);
    ir_ref *copies = ARENA_ARRAY(arena, ir_ref, root + 1);
    uint32_t before = graph->origin;
    for (ir_ref ref = 1; ref <= root; ref++) {
        copies[ref] = ref == from ? to : ref;
        const struct ir_node node = *ir_get(graph, ref);
        bool changed = false;
        ir_ref *args = needed[ref] && ref > from ? ARENA_ARRAY(arena, ir_ref, node.num_args) : NULL;
        for (uint32_t i = 0; args && i < node.num_args; i++) {
            args[i] = copies[ir_arg(graph, ref, i)];
            changed |= args[i] != ir_arg(graph, ref, i);
        }
        if (!changed)
            continue;
        graph->origin = node.origin;
        copies[ref] = ir_build(graph, (enum ir_op)node.op, node.type, node.attr, args, node.num_args);
    }
    graph->origin = before;
    return copies[root];
}
