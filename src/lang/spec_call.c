// SPDX-License-Identifier: Apache-2.0
/* The forward step over calls: evaluated where all arguments are constant, else of a version for those that are. */
#include "lang/specialise.h"

enum { MAX_EVAL_STEPS = 20000 };

static lang_ref evaluate(struct spec *s, const struct lang_node *call, const lang_ref *args, unsigned num_args)
{
    const struct lang_function *callee = lang_function(s->unit, call->a, NULL);
    if (!(callee->flags & LANG_FN_PURE) || ast_is_user_type(call->type) || call->type == IR_TYPE_VOID)
        return 0;
    for (unsigned i = 0; i < num_args; i++)
        if (spec_node(s, args[i])->kind != LANG_CONST)
            return 0;
    struct ir_value *values = arena_alloc(s->unit->arena, num_args * sizeof *values), result;
    for (unsigned i = 0; i < num_args; i++)
        spec_get(s, args[i], &values[i]);
    if (!lang_eval_call(s->unit, call->a, values, &result, MAX_EVAL_STEPS, s->unit->arena) || !spec_is_finite(&result))
        return 0;
    return spec_constant(s, &result, call->place);
}

/* Arguments that the version of the callee still takes. */
static lang_ref chain_arguments(struct spec *s, uint32_t version, uint32_t given, const lang_ref *args, unsigned num_args)
{
    struct chain chain = {0};
    for (unsigned i = 0; i < num_args; i++)
        if (!lang_param_dropped(s->unit, version, given, i)) {
            spec_node(s, args[i])->next = 0;
            spec_append(s, &chain, args[i]);
        }
    return chain.first;
}

/* Is every parameter of a wrapper handed on once, as what it is, and is nothing else computed? */
static bool hands_on(const struct spec *s, const struct lang_function *wrapper, const struct lang_node *inner)
{
    uint32_t handed = 0, index = 0;
    uint64_t seen = 0;
    for (lang_ref ref = inner->b; ref; ref = ast_node(s->unit, ref)->next, index++) {
        const struct lang_node *arg = ast_node(s->unit, ref);
        if (arg->kind == LANG_CONST)
            continue;
        if (arg->kind != LANG_VAR || arg->a >= wrapper->num_params || arg->a >= SPEC_MAX_PARAMS || seen >> arg->a & 1
            || ast_slot(s->unit, wrapper, arg->a)->mode != ast_param_mode(s->unit, inner->a, index))
            return false;
        seen |= 1ull << arg->a;
        handed++;
    }
    return handed == wrapper->num_params;
}

static lang_ref call_inner(struct spec *s, const struct lang_node *call, struct lang_node inner)
{
    lang_ref args[SPEC_MAX_PARAMS];
    struct chain chain = {0};
    ast_list(s->unit, call->b, args, SPEC_MAX_PARAMS);
    for (lang_ref ref = inner.b; ref; ref = spec_node(s, ref)->next) {
        struct lang_node node = *spec_node(s, ref);
        node.c = 0;
        lang_ref arg = node.kind == LANG_VAR ? args[node.a] : spec_add(s, node);
        spec_node(s, arg)->next = 0;
        spec_append(s, &chain, arg);
    }
    inner.b = chain.first;
    inner.place = call->place;
    return spec_add(s, inner);
}

/*
 * A version that was left with `return constant;` or `return g(its parameters, constants);` is not worth a name: the
 * constant, or the call of g, stands in its place. `call` has the version's arguments. 0 where it is none of these.
 */
static lang_ref skip_wrapper(struct spec *s, const struct lang_node *call)
{
    const struct lang_unit *layer;
    struct lang_function wrapper = *lang_function(s->unit, call->a, &layer);
    lang_ref returned = ast_returned(layer, &wrapper);
    if (layer != s->unit || !returned)
        return 0;
    struct lang_node inner = *spec_node(s, returned);
    if (inner.kind == LANG_CONST && wrapper.num_params == 0) {
        inner.c = 0;
        return spec_add(s, inner);
    }
    return inner.kind == LANG_CALL && hands_on(s, &wrapper, &inner) ? call_inner(s, call, inner) : 0;
}

/* What of the arguments the version is to take for granted. */
static void choose_bound(struct spec *s, uint32_t id, const lang_ref *args, unsigned num_args, lang_ref *bound)
{
    if (spec_is_planned(s->unit)) {
        spec_planned_params(s->unit, id, bound);
        return;
    }
    for (unsigned i = 0; i < num_args && i < SPEC_MAX_PARAMS; i++) {
        struct ir_value value;
        if (spec_get(s, args[i], &value) && spec_is_worth_binding(&value))
            bound[i] = args[i];
    }
}

static lang_ref call_version(struct spec *s, struct lang_node node, const lang_ref *args, unsigned num_args)
{
    lang_ref bound[SPEC_MAX_PARAMS] = {0};
    bool keeps_unused = false;
    if (s->unit->versions->depth < SPEC_MAX_DEPTH)
        choose_bound(s, node.a, args, num_args, bound);
    for (unsigned i = 0; i < num_args; i++)
        keeps_unused |= !(i < SPEC_MAX_PARAMS && bound[i]) && spec_has_effects(s, args[i]);
    uint32_t given = node.a;
    node.a = spec_function(s->unit, s->options, given, bound, keeps_unused);
    s->changed |= node.a != given;
    node.b = chain_arguments(s, node.a, given, args, num_args);
    lang_ref shorter = skip_wrapper(s, &node);
    if (!shorter && spec_is_planned(s->unit))
        shorter = spec_inline(s, &node);
    s->changed |= shorter != 0;
    return shorter ? shorter : spec_add(s, node);
}

/* The plan learns what the callee is passed; the call itself stays as it is. */
static lang_ref note_call(struct spec *s, struct lang_node node, const lang_ref *args, unsigned num_args)
{
    struct ir_value values[SPEC_MAX_PARAMS];
    const struct ir_value **known = ARENA_ARRAY(s->unit->arena, const struct ir_value *, num_args);
    for (unsigned i = 0; i < num_args && i < SPEC_MAX_PARAMS; i++)
        known[i] = spec_get(s, args[i], &values[i]) ? &values[i] : NULL;
    lang_plan_call(s->unit, node.a, known);
    struct chain chain = {0};
    for (unsigned i = 0; i < num_args; i++) {
        spec_node(s, args[i])->next = 0;
        spec_append(s, &chain, args[i]);
    }
    node.b = chain.first;
    return spec_add(s, node);
}

lang_ref spec_call(struct spec *s, struct lang_node node)
{
    uint32_t num_args = lang_function(s->unit, node.a, NULL)->num_params;
    lang_ref few[SPEC_MAX_PARAMS];
    lang_ref *args = num_args <= SPEC_MAX_PARAMS ? few : ARENA_ARRAY(s->unit->arena, lang_ref, num_args);
    bool has_outputs = false;
    uint32_t i = 0;
    for (lang_ref ref = node.b; ref; ref = ast_node(s->layer, ref)->next, i++) {
        bool is_input = ast_param_mode(s->unit, node.a, i) == LANG_IN;
        args[i] = is_input ? spec_expression(s, ref) : spec_target(s, ref);
        has_outputs |= !is_input;
    }
    i = 0;
    for (lang_ref ref = node.b; ref && has_outputs; ref = ast_node(s->layer, ref)->next, i++)
        if (ast_param_mode(s->unit, node.a, i) != LANG_IN)
            s->known[ast_target_slot(s->layer, ref)] = 0;
    lang_ref constant = has_outputs ? 0 : evaluate(s, &node, args, num_args);
    s->changed |= constant != 0;
    if (constant)
        return constant;
    return (spec_is_collecting(s->unit) ? note_call : call_version)(s, node, args, num_args);
}
