// SPDX-License-Identifier: Apache-2.0
#include "material/changed_closures.h"

ir_ref build_over(struct builder *b, ir_ref ref, const ir_ref *left)
{
    const struct ir_node node = *ir_get(b->graph, ref);
    ir_ref *args = ARENA_ARRAY(b->arena, ir_ref, node.num_args);
    bool is_same = true, has_operand = false;
    for (uint32_t i = 0; i < node.num_args; i++) {
        ir_ref arg = ir_arg(b->graph, ref, i);
        bool is_tree = ir_is_closure(b->graph, arg);
        args[i] = arg ? left[arg] : 0;
        is_same &= args[i] == arg;
        has_operand |= is_tree && args[i];
    }
    if (is_same)
        return ref;
    if ((node.op == IR_LAYER || node.op == IR_SLAB_LAYER || node.op == IR_CLOSURE_ADD)
        && (!args[0] || !args[1]))
        return ir_other_operand(b->graph, (enum ir_op)node.op, args[0], args[1]);
    if (ir_type_is_closure(node.type) && !has_operand)
        return 0;
    return ir_copy(b->graph, ref, args);
}

ir_ref build_with_parts(struct builder *b, ir_ref root, ir_ref (*part)(void *user_data, ir_ref ref),
                        void *user_data)
{
    const uint8_t *needed = ir_mark(b->graph, &root, 1, b->arena);
    ir_ref *left = ARENA_ARRAY(b->arena, ir_ref, root + 1);
    for (ir_ref ref = 1; ref <= root; ref++) {
        left[ref] = ref;
        if (!needed[ref] || !ir_is_closure(b->graph, ref))
            continue;
        uint8_t op = ir_get(b->graph, ref)->op;
        ir_push_origin_of(b->graph, ref);
        left[ref] =
            op == IR_LEAF || op == IR_SLAB ? part(user_data, ref) : build_over(b, ref, left);
        ir_pop_origin(b->graph);
    }
    return root ? left[root] : 0;
}

ir_ref build_leaf_operand(struct builder *b, ir_ref leaf, const char *name)
{
    const char *input;
    if (!leaf)
        return 0;
    if (strcmp(name, "weight") == 0)
        return ir_arg(b->graph, leaf, 0);
    for (unsigned i = 0; (input = build_leaf_input(b, ir_get(b->graph, leaf)->attr, i)); i++)
        if (strcmp(input, name) == 0)
            return ir_arg(b->graph, leaf, i + 1);
    return 0;
}

ir_ref build_with_operand(struct builder *b, ir_ref leaf, const char *name, ir_ref value)
{
    const struct ir_node node = *ir_get(b->graph, leaf);
    ir_ref *args = ARENA_ARRAY(b->arena, ir_ref, node.num_args);
    const char *input;
    memcpy(args, ir_args(b->graph, leaf), node.num_args * sizeof *args);
    for (unsigned i = 0; (input = build_leaf_input(b, node.attr, i)); i++)
        if (strcmp(input, name) == 0)
            args[i + 1] = value;
    return ir_build(b->graph, IR_LEAF, node.type, node.attr, args, node.num_args);
}
