// SPDX-License-Identifier: Apache-2.0
/* Redirects calls to the versions of their callees, or replaces them by simpler expressions. */
#include "specialise/spec.h"

#include <assert.h>

/* The arguments that the callee's version still takes. */
static lang_ref remaining_arguments(struct spec *s, uint32_t given, uint32_t version,
                                    lang_ref first)
{
    struct chain chain = {0};
    unsigned i = 0;
    for (lang_ref ref = first, next; ref; ref = next, i++) {
        next = spec_node(s, ref)->next;
        if (lang_param_dropped(s->unit, version, given, i))
            continue;
        spec_node(s, ref)->next = 0;
        spec_append(s, &chain, ref);
    }
    assert(i == lang_function(s->unit, given, NULL)->num_params);
    return chain.first;
}

/* True if a wrapper passes every parameter on once, unchanged, and computes nothing else. */
static bool passes_through(const struct spec *s, const struct lang_unit *layer,
                           const struct lang_function *wrapper, const struct lang_node *inner)
{
    uint32_t passed = 0, index = 0;
    uint64_t seen = 0;
    for (lang_ref ref = inner->b; ref; ref = ast_node(layer, ref)->next, index++) {
        const struct lang_node *arg = ast_node(layer, ref);
        if (arg->kind == LANG_CONST)
            continue;
        if (arg->kind != LANG_VAR || arg->a >= wrapper->num_params || arg->a >= SPEC_MAX_PARAMS
            || seen >> arg->a & 1
            || ast_slot(layer, wrapper, arg->a)->mode != ast_param_mode(s->unit, inner->a, index))
            return false;
        seen |= 1ull << arg->a;
        passed++;
    }
    return passed == wrapper->num_params;
}

/* Copies a constant of the layer to the generation's unit. */
static lang_ref copy_constant(struct spec *s, const struct lang_unit *layer,
                              const struct lang_node *constant)
{
    struct ir_value value = ast_value(constant->type, ast_words(layer, constant));
    return spec_constant(s, &value);
}

static lang_ref call_inner(struct spec *s, const struct lang_unit *layer,
                           const struct lang_node *call, struct lang_node inner)
{
    lang_ref args[SPEC_MAX_PARAMS];
    struct chain chain = {0};
    ast_list(s->unit, call->b, args, SPEC_MAX_PARAMS);
    assert(inner.kind == LANG_CALL);
    for (lang_ref ref = inner.b; ref; ref = ast_node(layer, ref)->next) {
        const struct lang_node node = *ast_node(layer, ref);
        lang_ref arg = node.kind == LANG_VAR ? args[node.a] : copy_constant(s, layer, &node);
        spec_node(s, arg)->next = 0;
        spec_append(s, &chain, arg);
    }
    inner.b = chain.first;
    return spec_add(s, inner);
}

/*
 * A version that shrank to `return constant;` or `return g(its parameters, constants);` needs no
 * name: the constant or the call of g replaces the call. `call` has the version's arguments. 0 for
 * other versions.
 */
static lang_ref skip_wrapper(struct spec *s, const struct lang_node *call)
{
    const struct lang_unit *layer;
    struct lang_function wrapper = *lang_function(s->unit, call->a, &layer);
    lang_ref returned = ast_returned(layer, &wrapper);
    if (layer != s->unit || !returned)
        return 0;
    const struct lang_node inner = *ast_node(layer, returned);
    if (inner.kind == LANG_CONST && wrapper.num_params == 0)
        return copy_constant(s, layer, &inner);
    return inner.kind == LANG_CALL && passes_through(s, layer, &wrapper, &inner)
               ? call_inner(s, layer, call, inner)
               : 0;
}

static void resolve(struct spec *s, lang_ref ref)
{
    struct lang_node call = *spec_node(s, ref);
    const struct variant *variant = &s->unit->plan->variants.items[call.c - 1];
    assert(call.kind == LANG_CALL && variant->function == call.a);
    call.c = 0;
    if (variant->version != call.a) {
        s->changed = true;
        call.b = remaining_arguments(s, call.a, variant->version, call.b);
        call.a = variant->version;
    }
    lang_ref shorter = skip_wrapper(s, &call);
    if (!shorter)
        shorter = spec_inline(s, &call);
    s->changed |= shorter != 0;
    struct lang_node node = shorter ? *spec_node(s, shorter) : call;
    if (shorter && node.kind == LANG_OP && !node.c)
        node.c = lang_function(s->unit, call.a, NULL)->name | LANG_OF_FUNCTION;
    node.next = call.next;
    *spec_node(s, ref) = node;
}

void spec_resolve(struct spec *s)
{
    const struct variant *variant = &s->unit->plan->variants.items[s->variant];
    assert(variant->first_call + variant->num_calls <= s->unit->plan->calls.len);
    for (uint32_t i = 0; i < variant->num_calls; i++)
        resolve(s, s->unit->plan->calls.items[variant->first_call + i]);
}
