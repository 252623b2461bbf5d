// SPDX-License-Identifier: Apache-2.0
/*
 * Derivatives along the screen for path tracers, which have no neighbouring pixels. The code writes
 * out the work of a quad of pixels:
 *
 *     dFdx(e) = e over streams one pixel further - e
 *
 * These streams are positionWorld + dx_positionWorld, texcoord_0 + dx_texcoord_0, …
 *
 * The host gives the change of each stream over a pixel (Igehy 1999, "Tracing Ray Differentials").
 * Derivatives inside of e stay unchanged. Functions with derivatives become nodes
 * (inlines_derivatives of lang_host), with both branches of an `if`, and loops round by round. In
 * those that cannot, for example because the rounds of a loop vary, screen derivatives are 0, which
 * the host of the generation is told (flat_calls).
 */
#include "closure/closure_priv.h"

#include <assert.h>

struct differ {
    struct shader *shader;
    struct ir_graph *graph;
    uint32_t num_nodes;
    uint8_t *wanted;        /* per node and axis: a derivative needs its value one pixel further */
    ir_ref *here, *next[2]; /* per node: its value here, and one pixel further along x and y */
};

static void find_wanted(struct differ *d, const uint8_t *needed)
{
    for (ir_ref ref = d->num_nodes; --ref > 0;) {
        const struct ir_node *node = ir_get(d->graph, ref);
        uint8_t axes = ir_is_difference((enum ir_op)node->op) ? 0 : d->wanted[ref];
        if (needed[ref] && (node->op == IR_DFDX || node->op == IR_FWIDTH))
            axes |= 1;
        if (needed[ref] && (node->op == IR_DFDY || node->op == IR_FWIDTH))
            axes |= 2;
        for (uint32_t i = 0; axes && i < node->num_args; i++)
            d->wanted[ir_arg(d->graph, ref, i)] |= axes;
    }
    d->wanted[0] = 0;
}

/* The value of a geometric stream one pixel further; other streams do not change. */
static ir_ref shifted_stream(struct differ *d, ir_ref ref, unsigned axis)
{
    const struct ir_node *node = ir_get(d->graph, ref);
    assert(node->op == IR_STREAM && node->attr < d->shader->interface.variables.len);
    str_id name = d->shader->interface.variables.items[node->attr].name;
    if (name == STR_random || name == STR_viewWorld || name == STR_lightWorld || name == STR_matter
        || ir_type_info(node->type)->scalar != IR_TYPE_FLOAT)
        return ref;
    struct text text;
    text_init(&text, d->shader->arena);
    text_fmt(&text, "%s%s", axis ? "dy_" : "dx_", str_text(d->shader->strings, name));
    ir_ref change = shader_stream(
        d->shader, str_intern(d->shader->strings, text_cstr(&text), text.len), node->type);
    return change ? ir_op2(d->graph, IR_ADD, ref, change) : ref;
}

/* The node over its new operands; the node itself if no operand changed. */
static ir_ref rebuilt(struct differ *d, ir_ref ref, const ir_ref *became)
{
    const struct ir_node node = *ir_get(d->graph, ref);
    ir_ref *args = ARENA_ARRAY(d->shader->arena, ir_ref, node.num_args + 1u);
    bool changed = false;
    for (uint32_t i = 0; i < node.num_args; i++) {
        assert(ir_arg(d->graph, ref, i) < ref);
        args[i] = became[ir_arg(d->graph, ref, i)];
        changed |= args[i] != ir_arg(d->graph, ref, i);
    }
    return changed ? ir_copy(d->graph, ref, args) : ref;
}

static ir_ref difference(struct differ *d, ir_ref arg, unsigned axis)
{
    return ir_op2(d->graph, IR_SUB, d->next[axis][arg], d->here[arg]);
}

static ir_ref derivative(struct differ *d, enum ir_op op, ir_ref arg)
{
    assert(ir_is_difference(op));
    if (op != IR_FWIDTH)
        return difference(d, arg, op == IR_DFDY);
    ir_ref x = ir_op1(d->graph, IR_ABS, difference(d, arg, 0)),
           y = ir_op1(d->graph, IR_ABS, difference(d, arg, 1));
    return ir_op2(d->graph, IR_ADD, x, y);
}

static void visit(struct differ *d, ir_ref ref)
{
    assert(ref < d->num_nodes);
    enum ir_op op = (enum ir_op)ir_get(d->graph, ref)->op;
    bool differs = ir_is_difference(op);
    d->here[ref] = differs ? derivative(d, op, ir_arg(d->graph, ref, 0)) : rebuilt(d, ref, d->here);
    for (unsigned axis = 0; axis < 2; axis++) {
        if (!(d->wanted[ref] & 1u << axis))
            continue;
        d->next[axis][ref] = differs           ? d->here[ref]
                             : op == IR_STREAM ? shifted_stream(d, ref, axis)
                                               : rebuilt(d, ref, d->next[axis]);
    }
}

/* Tells of a call that stays one: nothing differentiates what is inside it. */
static void note_call(struct shader *shader, ir_ref ref)
{
    const struct ir_node *node = ir_get(shader->graph, ref);
    if (node->op != IR_CALL)
        return;
    const struct ir_callee *callee = &shader->graph->callees.items[node->attr];
    struct shader_flat_call call = {node->origin, callee->name};
    if (lang_function(shader->unit, callee->index, NULL)->flags & LANG_FN_DIFFERENCE)
        vec_push(shader->arena, &shader->reflection.flat_calls, call);
}

ir_ref closure_differentials(struct shader *shader, ir_ref root)
{
    struct arena *arena = shader->arena;
    struct differ d = {.shader = shader, .graph = shader->graph, .num_nodes = root + 1};
    const uint8_t *needed = ir_mark(d.graph, &root, 1, arena);
    d.wanted = ARENA_ARRAY(arena, uint8_t, d.num_nodes);
    find_wanted(&d, needed);
    d.here = ARENA_ARRAY(arena, ir_ref, d.num_nodes);
    for (unsigned axis = 0; axis < 2; axis++)
        d.next[axis] = ARENA_ARRAY(arena, ir_ref, d.num_nodes);
    for (ir_ref ref = 1; ref <= root; ref++) {
        d.here[ref] = d.next[0][ref] = d.next[1][ref] = ref;
        if (!needed[ref])
            continue;
        note_call(shader, ref);
        ir_push_origin_of(d.graph, ref);
        visit(&d, ref);
        ir_pop_origin(d.graph);
    }
    assert(ir_type_of(d.graph, d.here[root]) == ir_type_of(d.graph, root));
    return d.here[root];
}
