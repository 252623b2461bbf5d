// SPDX-License-Identifier: Apache-2.0
/*
 * The forward step over calls: evaluates a call if all arguments are constant, else records it in
 * the plan.
 */
#include "specialise/spec.h"
#include "tree/interpret.h"

#include <assert.h>

static lang_ref evaluate(struct spec *s, const struct lang_node *call, const lang_ref *args,
                         unsigned num_args)
{
    const struct lang_function *callee = lang_function(s->unit, call->a, NULL);
    if (!(callee->flags & LANG_FN_PURE) || ast_is_user_type(call->type)
        || call->type == IR_TYPE_VOID)
        return 0;
    assert(num_args == callee->num_params);
    for (unsigned i = 0; i < num_args; i++)
        if (spec_node(s, args[i])->kind != LANG_CONST)
            return 0;
    struct ir_value *values = arena_alloc(s->unit->arena, num_args * sizeof *values), result;
    for (unsigned i = 0; i < num_args; i++)
        spec_get(s, args[i], &values[i]);
    if (!lang_eval_constant(s->unit, call->a, values, &result, s->unit->arena))
        return 0;
    return spec_constant(s, &result);
}

/* Records the arguments of the call in the plan. */
static lang_ref note_call(struct spec *s, struct lang_node node, const lang_ref *args,
                          unsigned num_args, bool have_effects)
{
    fact *facts = ARENA_ARRAY(s->unit->arena, fact, num_args);
    struct chain chain = {0};
    for (unsigned i = 0; i < num_args; i++) {
        const struct lang_node *arg = spec_node(s, args[i]);
        facts[i] = arg->kind == LANG_CONST && i < SPEC_MAX_PARAMS ? arg->a + 1 : FACT_VARIES;
        spec_append(s, &chain, args[i]);
    }
    node.b = chain.first;
    node.c = 1 + plan_note_call(s->unit, node.a, facts, have_effects);
    assert(node.c - 1 < s->unit->plan->variants.len);
    lang_ref call = spec_add(s, node);
    vec_push(s->unit->arena, &s->unit->plan->calls, call);
    return call;
}

lang_ref spec_call(struct spec *s, struct lang_node node)
{
    const struct lang_unit *layer;
    const struct lang_function *fn = lang_function(s->unit, node.a, &layer);
    const struct lang_slot *params = ast_slot(layer, fn, 0);
    uint32_t num_args = fn->num_params, num_effects = s->num_effects, i = 0;
    lang_ref *args = ARENA_ARRAY(s->unit->arena, lang_ref, num_args);
    bool has_outputs = false;
    for (lang_ref ref = node.b; ref; ref = ast_node(s->layer, ref)->next, i++) {
        bool is_input = params[i].mode == LANG_IN;
        args[i] = is_input ? spec_expression(s, ref) : spec_target(s, ref);
        has_outputs |= !is_input;
    }
    assert(i == num_args);
    bool args_have_effects = s->num_effects != num_effects;
    if (has_outputs) {
        i = 0;
        for (lang_ref ref = node.b; ref; ref = ast_node(s->layer, ref)->next, i++)
            if (params[i].mode != LANG_IN)
                s->known[ast_target_slot(s->layer, ref)] = 0;
        s->num_effects++;
    } else {
        lang_ref constant = evaluate(s, &node, args, num_args);
        s->changed |= constant != 0;
        if (constant)
            return constant;
    }
    return note_call(s, node, args, num_args, args_have_effects);
}
