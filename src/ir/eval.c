// SPDX-License-Identifier: Apache-2.0
/*
 * eval: the value of a node. The evaluator computes the nodes that it needs in array order. An
 * unknown value makes its users unknown, except a SELECT that does not choose it. So undefined
 * operations behind a condition do no harm. Calls of IR functions are frames on an explicit stack.
 * An evaluator knows the values of earlier runs, so many roots take the time of their nodes once.
 */
#include "ir/ir.h"

#include "base/num.h"

#include <assert.h>
#include <stdlib.h>

static void push_function(struct ir_evaluator *e, const struct ir_function *function, ir_ref call)
{
    const ir_ref *roots = e->graph->function_results.items + function->first_result;
    ir_ref end = 0;
    for (uint32_t i = 0; i < function->num_results; i++)
        end = roots[i] >= end ? roots[i] + 1 : end;
    struct ir_eval_frame frame = {.at = 1, .end = end, .call = call};
    frame.needed = ARENA_ARRAY(e->scratch, uint8_t, end);
    frame.places = ARENA_ARRAY(e->scratch, uint32_t, end);
    for (uint32_t i = 0; i < function->num_results; i++)
        frame.needed[roots[i]] = 1;
    for (ir_ref ref = end; --ref > 0;) {
        const ir_ref *args = ir_args(e->graph, ref);
        for (uint32_t i = 0; frame.needed[ref] && i < ir_get(e->graph, ref)->num_args; i++)
            frame.needed[args[i]] = 1;
    }
    vec_push(e->scratch, &e->frames, frame);
}

static uint32_t store(struct ir_evaluator *e, const struct ir_value *value)
{
    unsigned count = ir_type_info(value->type)->components;
    uint32_t place = e->words.len;
    memcpy(vec_extend(e->scratch, &e->words, count), value->w, count * sizeof *value->w);
    return place;
}

static bool load(const struct ir_evaluator *e, uint32_t place, ir_type_id type,
                 struct ir_value *out)
{
    if (place == 0 || type >= IR_NUM_TYPES)
        return false;
    out->type = type;
    memcpy(out->w, e->words.items + place, ir_type_info(type)->components * sizeof *out->w);
    return true;
}

static bool is_call(const struct ir_graph *graph, ir_ref ref)
{
    return ir_get(graph, ref)->op == IR_CALL || ir_get(graph, ref)->op == IR_GRAPH_CALL;
}

/* The value of an operand that the frame has already visited. */
static bool value_of(const struct ir_evaluator *e, const struct ir_eval_frame *frame, ir_ref ref,
                     struct ir_value *out)
{
    if (ir_get_const(e->graph, ref, out))
        return true;
    uint32_t place = frame->places[ref];
    if (place && is_call(e->graph, ref))
        place = e->results.items[place];
    return load(e, place, ir_type_of(e->graph, ref), out);
}

static bool values_of(const struct ir_evaluator *e, const struct ir_eval_frame *frame, ir_ref ref,
                      struct ir_value *out)
{
    for (uint32_t i = 0; i < ir_get(e->graph, ref)->num_args; i++)
        if (!value_of(e, frame, ir_arg(e->graph, ref, i), &out[i]))
            return false;
    return true;
}

static bool eval_source(const struct ir_evaluator *e, ir_ref ref, struct ir_value *out)
{
    const struct ir_eval_frame *frame = &vec_last(&e->frames);
    const struct ir_node *node = ir_get(e->graph, ref);
    if (node->op == IR_PARAM && frame->call) {
        const struct ir_eval_frame *caller = frame - 1;
        assert((node->attr & 0xffff) < ir_get(e->graph, frame->call)->num_args);
        return value_of(e, caller, ir_arg(e->graph, frame->call, node->attr & 0xffff), out);
    }
    return e->env && e->env->source && e->env->source(e->env->user_data, e->graph, ref, out);
}

/* Calls a function of the library. */
static void eval_call(struct ir_evaluator *e, ir_ref call)
{
    struct ir_eval_frame *frame = &vec_last(&e->frames);
    struct ir_value results[IR_MAX_RESULTS];
    e->args.len = 0;
    vec_extend(e->scratch, &e->args, ir_get(e->graph, call)->num_args + 1u);
    if (!e->env || !e->env->call || !values_of(e, frame, call, e->args.items))
        return;
    uint32_t num = e->env->call(e->env->user_data, e->graph, call, e->args.items, results),
             first = e->results.len;
    for (uint32_t i = 0; i < num; i++)
        vec_push(e->scratch, &e->results, store(e, &results[i]));
    frame->places[call] = num ? first : 0;
}

static bool eval_result(const struct ir_evaluator *e, ir_ref ref, struct ir_value *out)
{
    const struct ir_node *node = ir_get(e->graph, ref);
    uint32_t place = vec_last(&e->frames).places[ir_arg(e->graph, ref, 0)];
    return place && load(e, e->results.items[place + node->attr], node->type, out);
}

static bool eval_texture(const struct ir_evaluator *e, ir_ref ref, struct ir_value *out)
{
    struct ir_value place;
    bool is_known = value_of(e, &vec_last(&e->frames), ir_arg(e->graph, ref, 1), &place);
    return e->env && e->env->texture
           && e->env->texture(e->env->user_data, e->graph, ref, is_known ? &place : NULL, out);
}

/* SELECT, LAND and LOR can have a value although an operand is unknown. */
static bool eval_choice(const struct ir_evaluator *e, ir_ref ref, struct ir_value *out)
{
    const struct ir_eval_frame *frame = &vec_last(&e->frames);
    const ir_ref *args = ir_args(e->graph, ref);
    unsigned op = ir_get(e->graph, ref)->op;
    bool first = value_of(e, frame, args[0], out);
    if (op == IR_SELECT)
        return first && value_of(e, frame, args[out->w[0].u ? 1 : 2], out);
    uint32_t decisive = op == IR_LOR;
    if (first && out->w[0].u == decisive)
        return true;
    bool second = value_of(e, frame, args[1], out);
    return second && (first || out->w[0].u == decisive);
}

static bool eval_node(const struct ir_evaluator *e, ir_ref ref, struct ir_value *out)
{
    const struct ir_node *node = ir_get(e->graph, ref);
    struct ir_value args[16];
    switch (node->op) {
    case IR_UNIFORM:
    case IR_STREAM:
    case IR_PARAM:
    case IR_LOCAL:
    case IR_CONTEXT:
    case IR_SAMPLE:
    case IR_DFDX:
    case IR_DFDY:
    case IR_FWIDTH: return eval_source(e, ref, out);
    case IR_TEX:
    case IR_TEX_LOD:
    case IR_TEX_GRAD:
    case IR_TEX_FETCH: return eval_texture(e, ref, out);
    case IR_TEX_SIZE: return false;
    case IR_RESULT: return eval_result(e, ref, out);
    case IR_SELECT:
    case IR_LAND:
    case IR_LOR: return eval_choice(e, ref, out);
    default:
        return node->num_args <= 16 && values_of(e, &vec_last(&e->frames), ref, args)
               && ir_eval_op((enum ir_op)node->op, node->type, node->attr, args, node->num_args,
                             out);
    }
}

/* The frame reached the end of a function: its results go to the call, and the frame ends. */
static void return_to_caller(struct ir_evaluator *e)
{
    const struct ir_eval_frame *frame = &vec_last(&e->frames);
    struct ir_eval_frame *caller = &e->frames.items[e->frames.len - 2];
    assert(e->frames.len >= 2 && frame->at == frame->end && caller->at > frame->call);
    const struct ir_function *function =
        &e->graph->functions.items[ir_get(e->graph, frame->call)->attr];
    caller->places[frame->call] = e->results.len;
    for (uint32_t i = 0; i < function->num_results; i++) {
        struct ir_value value;
        ir_ref result = e->graph->function_results.items[function->first_result + i];
        vec_push(e->scratch, &e->results,
                 value_of(e, frame, result, &value) ? store(e, &value) : 0);
    }
    arena_release(e->scratch, frame->needed, frame->end * sizeof *frame->needed);
    arena_release(e->scratch, frame->places, frame->end * sizeof *frame->places);
    e->frames.len--;
}

static void step(struct ir_evaluator *e)
{
    struct ir_eval_frame *frame = &vec_last(&e->frames);
    ir_ref ref = frame->at++;
    assert(ref < frame->end);
    const struct ir_node *node = ir_get(e->graph, ref);
    e->num_steps++;
    if (!frame->needed[ref] || node->op == IR_CONST)
        return;
    if (node->op == IR_CALL) {
        eval_call(e, ref);
        return;
    }
    if (node->op == IR_GRAPH_CALL) {
        const struct ir_function *function = &e->graph->functions.items[node->attr];
        push_function(e, function, ref);
        return;
    }
    struct ir_value value;
    if (eval_node(e, ref, &value))
        frame->places[ref] = store(e, &value);
}

/* Adds a node to those that the next run visits, unless a run has visited it. */
static void visit(struct ir_evaluator *e, ir_ref ref)
{
    if (e->needed.items[ref])
        return;
    e->needed.items[ref] = 1;
    vec_push(e->scratch, &e->visits, ref);
}

/* The nodes that `root` needs, in array order, but for those with a known fate. */
static void find_visits(struct ir_evaluator *e, ir_ref root)
{
    uint32_t known = e->needed.len, more = root < known ? 0 : root + 1 - known;
    if (more) {
        memset(vec_extend(e->scratch, &e->needed, more), 0, more);
        memset(vec_extend(e->scratch, &e->places, more), 0, more * sizeof(uint32_t));
    }
    e->visits.len = 0;
    visit(e, root);
    for (uint32_t i = 0; i < e->visits.len; i++) {
        ir_ref ref = e->visits.items[i];
        const ir_ref *args = ir_args(e->graph, ref);
        for (uint32_t k = 0; k < ir_get(e->graph, ref)->num_args; k++)
            visit(e, args[k]);
    }
    num_sort(e->visits.items, e->visits.len);
}

static void run(struct ir_evaluator *e)
{
    for (;;) {
        const struct ir_eval_frame *frame = &vec_last(&e->frames);
        if (frame->at < frame->end)
            step(e);
        else if (frame->call)
            return_to_caller(e);
        else
            return;
    }
}

void ir_evaluator_init(struct ir_evaluator *e, const struct ir_graph *graph,
                       const struct ir_eval_env *env, struct arena *scratch)
{
    *e = (struct ir_evaluator){.graph = graph, .env = env, .scratch = scratch};
    vec_push(scratch, &e->words, (union ir_word){.u = 0});
    vec_push(scratch, &e->results, 0);
    vec_push(scratch, &e->frames, (struct ir_eval_frame){0});
}

void ir_evaluator_forget(struct ir_evaluator *e)
{
    e->words.len = e->results.len = 1;
    e->needed.len = e->places.len = 0;
}

bool ir_evaluate(struct ir_evaluator *e, ir_ref root, struct ir_value *out)
{
    find_visits(e, root);
    struct ir_eval_frame *outermost = &e->frames.items[0];
    outermost->needed = e->needed.items;
    outermost->places = e->places.items;
    for (uint32_t i = 0; i < e->visits.len; i++) {
        e->frames.items[0].at = e->visits.items[i];
        e->frames.items[0].end = e->visits.items[i] + 1;
        run(e);
    }
    return value_of(e, &e->frames.items[0], root, out);
}

bool ir_eval(const struct ir_graph *graph, ir_ref root, const struct ir_eval_env *env,
             struct arena *scratch, struct ir_value *out)
{
    /* Many callers have a root without operands. */
    unsigned op = ir_get(graph, root)->op;
    if (ir_get_const(graph, root, out))
        return true;
    if (op == IR_UNIFORM || op == IR_STREAM)
        return env && env->source && env->source(env->user_data, graph, root, out);
    struct ir_evaluator e;
    ir_evaluator_init(&e, graph, env, scratch);
    return ir_evaluate(&e, root, out);
}
