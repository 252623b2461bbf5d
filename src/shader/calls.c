// SPDX-License-Identifier: Apache-2.0
/*
 * The shader stands: every call that is left is known. Each portable function now gets the one
 * version that its calls share (specialise/plan.c), and the calls lose the arguments that the
 * version takes for granted.
 */
#include "shader/shader.h"
#include "specialise/specialise.h"

static void mark_roots(const struct shader *shader, uint8_t *needed)
{
    for (unsigned stage = 0; stage < NUM_STAGES; stage++) {
        const struct effect_list *effects = &shader->stages[stage].effects;
        for (uint32_t i = 0; i < effects->len; i++)
            needed[effects->items[i].value] = 1;
    }
}

static void mark_results(const struct ir_graph *graph, uint32_t function, uint8_t *needed)
{
    const struct ir_function *fn = &graph->functions.items[function];
    for (uint32_t i = 0; i < fn->num_results; i++)
        needed[graph->function_results.items[fn->first_result + i]] = 1;
}

struct call {
    ir_ref node;
    uint32_t planned;
};

struct calls { /* a vector */
    struct call *items;
    uint32_t len, cap;
};

/*
 * Those that the stages need, the newest first: operands and the bodies of functions are older than
 * what needs them.
 */
static struct calls find_calls(const struct shader *shader)
{
    const struct ir_graph *graph = shader->graph;
    struct calls calls = {0};
    uint8_t *needed = ARENA_ARRAY(shader->arena, uint8_t, graph->nodes.len);
    mark_roots(shader, needed);
    for (ir_ref ref = graph->nodes.len; --ref > 0;) {
        if (!needed[ref])
            continue;
        const struct ir_node *node = &graph->nodes.items[ref];
        const ir_ref *args = graph->args.items + node->first_arg, *end = args + node->num_args;
        for (; args < end; args++)
            needed[*args] = 1;
        if (node->op == IR_CALL)
            vec_push(shader->arena, &calls, (struct call){.node = ref});
        else if (node->op == IR_GRAPH_CALL)
            mark_results(graph, node->attr, needed);
    }
    return calls;
}

/* `in` and `inout` parameters have an operand each, in order. */
static bool has_operand(const struct lang_unit *layer, const struct lang_function *fn,
                        uint32_t param)
{
    return layer->slots.items[fn->first_slot + param].mode != LANG_OUT;
}

/* Returns what lang_plan_version is asked for. */
static uint32_t tell_plan(struct shader *shader, ir_ref call)
{
    const struct ir_graph *graph = shader->graph;
    const struct lang_unit *layer;
    uint32_t id = shader_callee(shader, call);
    const struct lang_function *fn = lang_function(shader->unit, id, &layer);
    const union ir_word **known = ARENA_ARRAY(shader->arena, const union ir_word *, fn->num_params);
    const ir_ref *args = ir_args(graph, call);
    for (uint32_t i = 0; i < fn->num_params; i++) {
        const struct ir_node *arg = has_operand(layer, fn, i) ? ir_get(graph, *args++) : NULL;
        if (arg && arg->op == IR_CONST)
            known[i] = graph->words.items + arg->attr;
    }
    return lang_plan_call(shader->unit, id, known);
}

/* In place: nothing is built after this, so sharing of equal nodes need not be kept up. */
static void call_version(struct shader *shader, ir_ref call, uint32_t version)
{
    struct ir_graph *graph = shader->graph;
    const struct lang_unit *layer;
    uint32_t given = shader_callee(shader, call);
    if (version == given)
        return;
    const struct lang_function *fn = lang_function(shader->unit, given, &layer);
    struct ir_node *node = &graph->nodes.items[call];
    ir_ref *args = graph->args.items + node->first_arg;
    uint32_t read = 0, kept = 0;
    for (uint32_t i = 0; i < fn->num_params; i++) {
        if (!has_operand(layer, fn, i))
            continue;
        ir_ref arg = args[read++];
        if (!lang_param_dropped(shader->unit, version, given, i))
            args[kept++] = arg;
    }
    node->num_args = kept;
    struct ir_callee callee = graph->callees.items[node->attr];
    uint16_t flags = lang_function(shader->unit, version, NULL)->flags;
    callee.id = version;
    callee.derivative = (flags & LANG_FN_DERIVATIVE) != 0;
    callee.pure = (flags & LANG_FN_PURE) != 0;
    node->attr = ir_add_callee(graph, callee);
}

void shader_specialise_calls(struct shader *shader)
{
    struct calls calls = find_calls(shader);
    if (!calls.len)
        return;
    for (uint32_t i = calls.len; i-- > 0;)
        calls.items[i].planned = tell_plan(shader, calls.items[i].node);
    lang_plan_finish(shader->unit);
    for (uint32_t i = calls.len; i-- > 0;)
        call_version(shader, calls.items[i].node,
                     lang_plan_version(shader->unit, calls.items[i].planned));
}
