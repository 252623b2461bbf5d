// SPDX-License-Identifier: Apache-2.0
/*
 * The value of a closure tree as two colours, response and throughput: the operands of source that
 * takes a closure. Such source need not be linear, so its operands cannot become a list of weighted
 * leaves. Operands precede their node, so one pass upwards computes all values.
 */
#include "closure/closure_priv.h"

#include "shader/formula.h"

#include <assert.h>

struct evaluation {
    struct shader *shader;
    struct ir_graph *graph;
    const struct closure_host *host;
    struct closure_value *values; /* per node */
};

static struct closure_value value_of(const struct evaluation *e, ir_ref ref)
{
    return ref ? e->values[ref]
               : (struct closure_value){ir_const_splat(e->graph, IR_TYPE_VEC3, 0.0f),
                                        ir_const_splat(e->graph, IR_TYPE_VEC3, 1.0f)};
}

static ir_ref multiply(struct evaluation *e, ir_ref a, ir_ref b)
{
    return ir_convert(e->graph, IR_TYPE_VEC3, ir_op2(e->graph, IR_MUL, a, b));
}

/* The response of a leaf with portable functions to the context. */
static ir_ref response_of(struct evaluation *e, ir_ref leaf)
{
    static const enum leaf_function functions[NUM_SOURCE_CONTEXTS] = {
        [SOURCE_REFLECTION] = LEAF_EVAL,
        [SOURCE_TRANSMISSION] = LEAF_TRANSMISSION,
        [SOURCE_INDIRECT] = LEAF_ENVIRONMENT,
        [SOURCE_EMISSION] = LEAF_EMISSION,
    };
    ir_ref response =
        closure_call(e->shader, e->host, leaf, functions[e->host->context], e->host->light);
    if (response && e->host->context != SOURCE_REFLECTION)
        response = closure_gathered(e->shader, ir_convert(e->graph, IR_TYPE_VEC3, response));
    return response ? multiply(e, response, ir_arg(e->graph, leaf, 0))
                    : ir_const_splat(e->graph, IR_TYPE_VEC3, 0.0f);
}

static struct closure_value leaf_value(struct evaluation *e, ir_ref leaf)
{
    const struct ir_node node = *ir_get(e->graph, leaf);
    const struct source_leaf *source = closure_source(e->shader, leaf);
    if (source) {
        struct closure_value *operands =
            ARENA_ARRAY(e->shader->arena, struct closure_value, node.num_args);
        const struct source_leaf kept = *source;
        for (uint32_t i = 1; i < node.num_args; i++)
            if (ir_type_is_closure(kept.operand_types[i - 1]))
                operands[i] = value_of(e, ir_arg(e->graph, leaf, i));
        return closure_call_with(e->shader, e->host, leaf, e->host->context, e->host->light,
                                 operands);
    }
    if (closure_has(e->shader, e->host, leaf, LEAF_FACTOR)) {
        struct closure_value base = value_of(e, ir_arg(e->graph, leaf, node.num_args - 1));
        ir_ref factor = closure_call(e->shader, e->host, leaf, LEAF_FACTOR, NULL);
        return (struct closure_value){multiply(e, base.response, factor), base.throughput};
    }
    ir_ref decay;
    return (struct closure_value){response_of(e, leaf),
                                  closure_leaf_throughput(e->shader, e->host, leaf, &decay)};
}

ir_ref closure_operator_throughput(struct shader *shader, ir_ref ref, ir_ref a, ir_ref b)
{
    struct ir_graph *g = shader->graph;
    switch (ir_get(g, ref)->op) {
    case IR_LAYER: return ir_op2(g, IR_MUL, a, b);
    case IR_CLOSURE_MIX: return ir_op3(g, IR_MIX, a, b, ir_arg(g, ref, 2));
    case IR_CLOSURE_ADD: return FORMULA(shader, "mx_added_throughput", a, b);
    default: /* scaling a closure does not change its throughput */ return a;
    }
}

static struct closure_value operator_value(struct evaluation *e, ir_ref ref)
{
    struct ir_graph *g = e->graph;
    const struct ir_node node = *ir_get(g, ref);
    bool has_base = node.op != IR_CLOSURE_SCALE;
    struct closure_value a = value_of(e, ir_arg(g, ref, 0)),
                         b = value_of(e, has_base ? ir_arg(g, ref, 1) : 0), out = {0, 0};
    switch (node.op) {
    case IR_LAYER:
        out.response = ir_op2(g, IR_ADD, a.response, ir_op2(g, IR_MUL, b.response, a.throughput));
        break;
    case IR_CLOSURE_MIX:
        out.response = ir_op3(g, IR_MIX, a.response, b.response, ir_arg(g, ref, 2));
        break;
    case IR_CLOSURE_ADD: out.response = ir_op2(g, IR_ADD, a.response, b.response); break;
    default: out.response = multiply(e, a.response, ir_arg(g, ref, 1));
    }
    if (node.type == IR_TYPE_BSDF)
        out.throughput = closure_operator_throughput(e->shader, ref, a.throughput, b.throughput);
    return out;
}

struct closure_value closure_evaluate(struct shader *shader, const struct closure_host *host,
                                      ir_ref root)
{
    struct closure_host along = *host;
    along.way = 1; /* light meets media at right angles: source sees no leaves with ways */
    struct evaluation e = {shader, shader->graph, &along, NULL};
    if (!root)
        return value_of(&e, 0);
    e.values = ARENA_ARRAY(shader->arena, struct closure_value, root + 1);
    uint8_t *needed = ir_mark(shader->graph, &root, 1, shader->arena);
    for (ir_ref ref = 1; ref <= root; ref++) {
        const struct ir_node *node = ir_get(shader->graph, ref);
        if (!needed[ref] || !(node->flags & IR_NODE_CLOSURE))
            continue;
        ir_push_origin_of(shader->graph, ref);
        e.values[ref] = node->op == IR_LEAF ? leaf_value(&e, ref) : operator_value(&e, ref);
        ir_pop_origin(shader->graph);
    }
    return e.values[root];
}
