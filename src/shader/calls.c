// SPDX-License-Identifier: Apache-2.0
/*
 * The shader stands: every call that is left is known. Each portable function now gets the one version that its calls share
 * (lang/plan.c), and the calls lose the arguments that the version takes for granted.
 */
#include "shader/shader.h"

static uint8_t *mark_calls(struct shader *shader)
{
    uint32_t num_roots = 0;
    for (unsigned stage = 0; stage < NUM_STAGES; stage++)
        num_roots += shader->stages[stage].effects.len;
    ir_ref *roots = ARENA_ARRAY(shader->arena, ir_ref, num_roots);
    uint32_t n = 0;
    for (unsigned stage = 0; stage < NUM_STAGES; stage++)
        for (uint32_t i = 0; i < shader->stages[stage].effects.len; i++)
            if (shader->stages[stage].effects.items[i].value)
                roots[n++] = shader->stages[stage].effects.items[i].value;
    return ir_mark(shader->graph, roots, n, shader->arena);
}

/* `in` and `inout` parameters have an operand each, in order. */
static bool has_operand(const struct lang_unit *layer, const struct lang_function *fn, uint32_t param)
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

struct call {
    ir_ref node;
    uint32_t planned;
};

void shader_specialise_calls(struct shader *shader)
{
    const uint8_t *needed = mark_calls(shader);
    VEC(struct call) calls = {0};
    for (ir_ref ref = 1; ref < shader->graph->nodes.len; ref++)
        if (needed[ref] && ir_get(shader->graph, ref)->op == IR_CALL)
            vec_push(shader->arena, &calls, (struct call){ref, tell_plan(shader, ref)});
    if (!calls.len)
        return;
    lang_plan_finish(shader->unit);
    for (uint32_t i = 0; i < calls.len; i++)
        call_version(shader, calls.items[i].node, lang_plan_version(shader->unit, calls.items[i].planned));
}
