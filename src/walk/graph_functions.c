// SPDX-License-Identifier: Apache-2.0
/*
 * Functional graphs as functions of the shader. The builder builds a graph anew for each use with
 * other arguments, because this folds best. But definitions that use others twice, to a depth of n,
 * give 2^n uses. So from its INLINE_USES-th use on, a graph becomes a function, built once:
 *
 *     d2(x) = d1(x) + d1(d1(x)),  d1(x) = d0(x) + d0(d0(x)),  …
 */
#include "build/build_priv.h"

enum { INLINE_USES = 16, MAX_FUNCTIONS = 60000 };

/*
 * Numbers become parameters. All other arguments belong to the function, and so do constants that
 * choose (an index, a switch), because nodes may read their values.
 */
static bool is_parameter(const struct builder *b, ir_ref arg)
{
    ir_type_id type = arg ? ir_type_of(b->graph, arg) : IR_TYPE_VOID;
    bool chooses = type == IR_TYPE_BOOL || type == IR_TYPE_INT || type == IR_TYPE_UINT;
    return build_is_number(type) && !(chooses && ir_is_const(b->graph, arg));
}

static bool gives_numbers(const struct builder *b, const struct nodedef *def,
                          const struct port *outputs)
{
    for (uint32_t i = 0; i < def->num_outputs; i++)
        if (!build_is_number(build_type(b, outputs[i].type)))
            return false;
    return true;
}

/* The arguments, with 0 for those that become parameters. */
static ir_ref *fixed_args(struct builder *b, const ir_ref *args, uint32_t n)
{
    ir_ref *fixed = ARENA_ARRAY(b->arena, ir_ref, n);
    for (uint32_t i = 0; i < n; i++)
        fixed[i] = is_parameter(b, args[i]) ? 0 : args[i];
    return fixed;
}

uint32_t build_outlined(struct builder *b, const struct frame *frame)
{
    const struct nodedef *def = library_nodedef(b->lib, frame->node.nodedef);
    const struct port *ports = library_ports(b->lib, frame->node.nodedef, NULL);
    if (b->recorder || !gives_numbers(b, def, ports + def->num_inputs)
        || b->graph->functions.len >= MAX_FUNCTIONS)
        return LIBRARY_NONE;
    /* The complement of an implementation's number is unique among memos. */
    struct memo *memo = build_memo(b, ~frame->impl->ref,
                                   fixed_args(b, frame->args, def->num_inputs), def->num_inputs);
    return memo->uses++ < INLINE_USES ? LIBRARY_NONE : (uint32_t)(memo - b->memos.items);
}

void build_begin_function(struct builder *b, struct frame *frame)
{
    assert(b->memos.items[frame->outline].function == 0);
    const struct nodedef *def = library_nodedef(b->lib, frame->node.nodedef);
    ir_type_id *types = ARENA_ARRAY(b->arena, ir_type_id, def->num_inputs);
    unsigned n = 0;
    for (uint32_t i = 0; i < def->num_inputs; i++)
        if (is_parameter(b, frame->args[i]))
            types[n++] = ir_type_of(b->graph, frame->args[i]);
    frame->function = ir_add_function(b->graph, def->node, types, n);
    ir_ref *args = ARENA_ARRAY(b->arena, ir_ref, def->num_inputs);
    n = 0;
    for (uint32_t i = 0; i < def->num_inputs; i++)
        args[i] = is_parameter(b, frame->args[i]) ? ir_param(b->graph, frame->function, n++)
                                                  : frame->args[i];
    assert(n <= def->num_inputs);
    frame->inner->args = args;
    /* The nodes belong to the definition instead of this use. */
    frame->inner->origin = ir_add_origin(
        b->graph, doc_element(&b->lib->doc, frame->inner->graph)->name, frame->inner->graph, 0);
}

void build_call_function(struct builder *b, const struct frame *frame, uint32_t function,
                         ir_ref *results)
{
    assert(function < b->graph->functions.len);
    const struct nodedef *def = library_nodedef(b->lib, frame->node.nodedef);
    const struct port *outputs = library_ports(b->lib, frame->node.nodedef, NULL) + def->num_inputs;
    ir_ref *args = ARENA_ARRAY(b->arena, ir_ref, def->num_inputs);
    unsigned n = 0;
    for (uint32_t i = 0; i < def->num_inputs; i++)
        if (is_parameter(b, frame->args[i]))
            args[n++] = frame->args[i];
    results[0] =
        ir_build(b->graph, IR_GRAPH_CALL, build_type(b, outputs[0].type), function, args, n);
    ir_ref call = results[0];
    for (uint32_t i = 1; i < def->num_outputs; i++)
        results[i] = ir_build(b->graph, IR_RESULT, build_type(b, outputs[i].type), i, &call, 1);
}
