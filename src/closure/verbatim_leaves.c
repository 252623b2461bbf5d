// SPDX-License-Identifier: Apache-2.0
/*
 * Leaves whose functions are verbatim source. One function answers a question of a context: the
 * response to the current light, to the environment, to light from behind, or the emission; beside
 * the response it gives the throughput (docs/library.md, "Source for one target").
 *
 *     bsdf = BSDF(vec3(0), vec3(1))
 *     f(ClosureData(type, L, V, N, P, occlusion), inputs, bsdf)
 *     response = bsdf.response, throughput = bsdf.throughput
 *
 * Calls for equal contexts are one node, so a light's response and throughput share a call.
 */
#include "closure/closure_priv.h"

#include "ir/arithmetic.h"
#include "shader/formula.h"

#include <assert.h>

const struct source_leaf *closure_source(const struct shader *shader, ir_ref leaf)
{
    const struct ir_node *node = ir_get(shader->graph, leaf);
    if (node->op != IR_LEAF)
        return NULL;
    const struct ir_callee *callee = &shader->graph->callees.items[node->attr];
    if (callee->kind != IR_CALLEE_SOURCE)
        return NULL;
    assert(callee->index < shader->sources.leaves.len);
    return &shader->sources.leaves.items[callee->index];
}

/* The context whose response is a function of a leaf; NUM_SOURCE_CONTEXTS: none. */
static enum source_context context_of(enum leaf_function which)
{
    switch (which) {
    case LEAF_EVAL: return SOURCE_REFLECTION;
    case LEAF_ENVIRONMENT: return SOURCE_INDIRECT;
    case LEAF_TRANSMISSION: return SOURCE_TRANSMISSION;
    case LEAF_EMISSION: return SOURCE_EMISSION;
    default: return NUM_SOURCE_CONTEXTS;
    }
}

bool closure_source_has(const struct source_leaf *source, ir_type_id type, enum leaf_function which)
{
    enum source_context context = context_of(which);
    if (type == IR_TYPE_VDF)
        return which == LEAF_ABSORPTION;
    if (which == LEAF_THROUGHPUT)
        return type == IR_TYPE_BSDF;
    bool is_emission = context == SOURCE_EMISSION;
    return context != NUM_SOURCE_CONTEXTS && is_emission == (type == IR_TYPE_EDF)
           && source->answers >> context & 1;
}

/* ---- Arguments ---- */

struct call {
    struct shader *shader;
    struct ir_graph *graph;
    const struct closure_host *host;
    enum source_context context;
    const ir_ref *light;
    ir_ref *args;
    unsigned num_args;
};

static void put(struct call *c, ir_ref arg)
{
    c->args[c->num_args++] = arg;
}

static ir_ref light_of(struct call *c)
{
    return c->context == SOURCE_REFLECTION && c->light ? *c->light : ir_black(c->graph);
}

static void put_closure_data(struct call *c)
{
    /* the numbers of CLOSURE_TYPE_… */
    static const uint8_t types[NUM_SOURCE_CONTEXTS] = {[SOURCE_REFLECTION] = 1,
                                                       [SOURCE_TRANSMISSION] = 2,
                                                       [SOURCE_INDIRECT] = 3,
                                                       [SOURCE_EMISSION] = 4};
    /* statements fix the order of the nodes; C leaves the order of initialisers open */
    ir_ref normal = closure_normal(c->shader, c->host), view = closure_view(c->shader, c->host),
           point = closure_position(c->shader, c->host);
    ir_ref members[] = {ir_const_int(c->graph, types[c->context]),
                        light_of(c),
                        view,
                        normal,
                        point,
                        ir_const_float(c->graph, 1.0f)};
    ir_type_id type = shader_source_struct(c->shader, SOURCE_STRUCT_CLOSURE_DATA);
    ir_ref data =
        ir_build(c->graph, IR_CONSTRUCT, type, 0, members, sizeof members / sizeof *members);
    ir_suggest_name(c->graph, data, str_intern_z(c->shader->strings, "closure_data"), IR_NAME_ROLE);
    put(c, data);
}

static void put_values(struct call *c)
{
    if (c->context == SOURCE_EMISSION)
        put(c, closure_normal(c->shader, c->host));
    if (c->context == SOURCE_REFLECTION)
        put(c, light_of(c));
    put(c, closure_view(c->shader, c->host));
    if (c->context != SOURCE_REFLECTION)
        return;
    put(c, closure_position(c->shader, c->host));
    put(c, ir_const_float(c->graph, 1.0f));
}

/* A closure's result: lets all light through, and adds none. */
static ir_ref struct_of(struct call *c, ir_type_id type, struct closure_value value)
{
    ir_ref members[] = {value.response, value.throughput, ir_const_float(c->graph, 0.0f),
                        ir_const_float(c->graph, 1.5f)};
    if (type == IR_TYPE_VEC3)
        return value.response;
    const struct ir_user_type *user = &c->graph->user_types.items[type - IR_TYPE_FIRST_USER];
    assert(user->num_members >= 2 && user->num_members <= sizeof members / sizeof *members);
    return ir_build(c->graph, IR_CONSTRUCT, type, 0, members, user->num_members);
}

/* ---- Calls ---- */

static struct closure_value nothing(struct call *c)
{
    return (struct closure_value){ir_black(c->graph), ir_white(c->graph)};
}

struct closure_value closure_call_with(struct shader *shader, const struct closure_host *host,
                                       ir_ref leaf, enum source_context context,
                                       const ir_ref *light, const struct closure_value *operands)
{
    enum { MAX_LEADING = 4, INITIAL = 1 };
    struct ir_graph *g = shader->graph;
    const struct source_leaf source = *closure_source(shader, leaf);
    const struct ir_node node = *ir_get(g, leaf);
    struct call c = {shader, g, host, context, light, NULL, 0};
    uint32_t index = source.verbatim[context];
    if (index == UINT32_MAX)
        return nothing(&c);
    c.args = ARENA_ARRAY(shader->arena, ir_ref, MAX_LEADING + node.num_args + INITIAL);
    if (source_has_closure_data(source.convention))
        put_closure_data(&c);
    else if (source.convention == SOURCE_VALUES)
        put_values(&c);
    for (unsigned i = 1; i < node.num_args; i++) {
        ir_type_id type = source.operand_types[i - 1];
        put(&c, ir_type_is_closure(type) ? struct_of(
                    &c, shader_closure_struct(shader, source.convention, type), operands[i])
                                         : ir_arg(g, leaf, i));
    }
    const struct shader_verbatim *verbatim = &shader->sources.calls.items[index];
    assert(verbatim->num_results == 1 && verbatim->has_initial);
    ir_type_id type = shader->sources.result_types.items[verbatim->first_result];
    put(&c, struct_of(&c, type, nothing(&c)));
    ir_push_origin(g, node.origin);
    uint32_t callee =
        ir_add_callee(g, (struct ir_callee){.kind = IR_CALLEE_VERBATIM,
                                            .index = index,
                                            .name = verbatim->function,
                                            .derivative = verbatim->needs_neighbours});
    ir_ref call = ir_build(g, IR_VERBATIM, IR_TYPE_VOID, callee, c.args, c.num_args);
    ir_ref result = ir_build(g, IR_RESULT, type, 1, &call, 1);
    struct closure_value value = {result, 0};
    if (type != IR_TYPE_VEC3)
        value = (struct closure_value){ir_build(g, IR_MEMBER, IR_TYPE_VEC3, 0, &result, 1),
                                       ir_build(g, IR_MEMBER, IR_TYPE_VEC3, 1, &result, 1)};
    ir_pop_origin(g);
    return value;
}

/* The values of the closure operands of a leaf; NULL: it has none. */
static const struct closure_value *operands_of(struct shader *shader,
                                               const struct closure_host *host, ir_ref leaf)
{
    const struct source_leaf source = *closure_source(shader, leaf);
    const uint32_t num_args = ir_get(shader->graph, leaf)->num_args;
    struct closure_value *values = NULL;
    for (uint32_t i = 1; i < num_args; i++) {
        if (!ir_type_is_closure(source.operand_types[i - 1]))
            continue;
        if (!values)
            values = ARENA_ARRAY(shader->arena, struct closure_value, num_args);
        values[i] = closure_evaluate(shader, host, ir_arg(shader->graph, leaf, i));
    }
    return values;
}

ir_ref closure_call_source(struct shader *shader, const struct closure_host *host, ir_ref leaf,
                           enum leaf_function which, const ir_ref *light)
{
    if (!closure_has(shader, host, leaf, which))
        return 0;
    struct closure_host at = *host;
    if (context_of(which) != NUM_SOURCE_CONTEXTS)
        at.context = context_of(which);
    if (which == LEAF_ABSORPTION)
        at.context = SOURCE_TRANSMISSION;
    at.light = light ? light : host->light;
    struct closure_value value =
        closure_call_with(shader, &at, leaf, at.context, at.light, operands_of(shader, &at, leaf));
    if (which == LEAF_THROUGHPUT)
        return value.throughput;
    if (which != LEAF_ABSORPTION)
        return value.response;
    /* a throughput over the unit of length is a transmittance */
    return FORMULA(shader, "mx_absorption", value.throughput);
}
