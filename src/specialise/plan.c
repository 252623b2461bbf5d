// SPDX-License-Identifier: Apache-2.0
/*
 * Whole-shader specialisation: chooses the constants that a function assumes.
 *
 * One version per set of constant arguments would repeat the text of the function. So the
 * generation first makes calls with all their arguments. When the shader is complete, each function
 * gets one version: a parameter is bound if every remaining call passes the same constant
 * (interprocedural constant propagation). Only strings and flags, which choose code, make several
 * variants of a function. Callees have smaller ids than callers: a pass from the highest id down
 * sees every call of a function before the function, and a pass from the lowest id up has every
 * callee's version before its calls.
 */
#include "specialise/spec.h"

#include <assert.h>

struct lang_plan *plan_of(struct lang_unit *unit)
{
    if (!unit->plan) {
        unit->plan = ARENA_NEW(unit->arena, struct lang_plan);
        unit->plan->num_ids = unit->base_functions + unit->functions.len;
        unit->plan->first_variant = ARENA_ARRAY(unit->arena, uint32_t, unit->plan->num_ids);
        unit->plan->spec = ARENA_NEW(unit->arena, struct spec);
        unit->plan->spec->unit = unit;
    }
    assert(unit->plan->spec->unit == unit);
    return unit->plan;
}

static bool is_bindable(const struct lang_slot *param)
{
    return param->mode == LANG_IN && !ast_is_user_type(param->type);
}

static bool is_key(const struct lang_slot *param)
{
    return param->mode == LANG_IN && (param->type == IR_TYPE_BOOL || param->type == IR_TYPE_STRING);
}

static bool is_same(const struct lang_unit *unit, ir_type_id type, fact a, fact b)
{
    if (a == b || a == FACT_VARIES || b == FACT_VARIES)
        return a == b;
    assert(a - 1 < unit->words.len && b - 1 < unit->words.len);
    const union ir_word *words = unit->words.items - 1;
    return memcmp(words + a, words + b, ir_type_info(type)->components * sizeof *words) == 0;
}

/* Argument `index` of a call. args NULL: all arguments vary. */
static fact argument(const fact *args, uint32_t index)
{
    return args ? args[index] : FACT_VARIES;
}

static bool has_keys(const struct lang_unit *unit, const struct variant *variant,
                     const struct lang_slot *params, uint32_t num_params, const fact *args)
{
    const fact *facts = unit->plan->facts.items + variant->first_fact;
    for (uint32_t i = 0; i < num_params; i++)
        if (is_key(&params[i]) && !is_same(unit, params[i].type, facts[i], argument(args, i)))
            return false;
    return true;
}

static uint32_t add_variant(struct lang_unit *unit, uint32_t function, uint32_t num_params)
{
    struct lang_plan *plan = unit->plan;
    assert(function < plan->num_ids);
    struct variant variant = {.function = function, .first_fact = plan->facts.len};
    fact *facts = vec_extend(unit->arena, &plan->facts, num_params);
    for (uint32_t i = 0; i < num_params; i++)
        facts[i] = FACT_UNSEEN;
    vec_push(unit->arena, &plan->variants, variant);
    return plan->variants.len;
}

uint32_t plan_note_call(struct lang_unit *unit, uint32_t function, const fact *args,
                        bool args_have_effects)
{
    struct lang_plan *plan = unit->plan;
    const struct lang_unit *layer;
    const struct lang_function *fn = lang_function(unit, function, &layer);
    const struct lang_slot *params = ast_slot(layer, fn, 0);
    if (plan->is_open)
        args = NULL;
    uint32_t num_params = fn->num_params, link = plan->first_variant[function], last = 0;
    while (link && !has_keys(unit, &plan->variants.items[link - 1], params, num_params, args)) {
        last = link;
        link = plan->variants.items[link - 1].next;
    }
    if (!link) {
        link = add_variant(unit, function, num_params);
        *(last ? &plan->variants.items[last - 1].next : &plan->first_variant[function]) = link;
    }
    assert(link <= plan->variants.len);
    uint32_t index = link - 1;
    struct variant *variant = &plan->variants.items[index];
    fact *facts = plan->facts.items + variant->first_fact;
    for (uint32_t i = 0; i < num_params; i++)
        if (!is_bindable(&params[i]))
            facts[i] = FACT_VARIES;
        else if (facts[i] == FACT_UNSEEN)
            facts[i] = argument(args, i);
        else if (!is_same(unit, params[i].type, facts[i], argument(args, i)))
            facts[i] = FACT_VARIES;
    assert(variant->function == function && index < plan->variants.len);
    variant->keeps_unused |= plan->is_open || args_have_effects;
    return index;
}

uint32_t lang_plan_call(struct lang_unit *unit, uint32_t id, const union ir_word *const *args)
{
    plan_of(unit);
    const struct lang_unit *layer;
    const struct lang_function *fn = lang_function(unit, id, &layer);
    fact *facts = ARENA_ARRAY(unit->arena, fact, fn->num_params);
    for (uint32_t i = 0; i < fn->num_params; i++) {
        bool is_known = args[i] && i < SPEC_MAX_PARAMS;
        uint32_t count = is_known ? ast_type_words(unit, ast_slot(layer, fn, i)->type) : 0;
        facts[i] = is_known ? unit->words.len + 1 : FACT_VARIES;
        if (count)
            memcpy(vec_extend(unit->arena, &unit->words, count), args[i], count * sizeof **args);
    }
    return plan_note_call(unit, id, facts, false);
}

uint32_t plan_note_any(struct lang_unit *unit, uint32_t function)
{
    plan_of(unit);
    unit->plan->is_open = true;
    return plan_note_call(unit, function, NULL, false);
}

uint32_t lang_plan_version(const struct lang_unit *unit, uint32_t call)
{
    assert(call < unit->plan->variants.len);
    return unit->plan->variants.items[call].version;
}

bool lang_param_dropped(const struct lang_unit *unit, uint32_t version, uint32_t given,
                        unsigned index)
{
    if (version == given || index >= SPEC_MAX_PARAMS)
        return false;
    assert(version - unit->base_functions < unit->versions.len);
    const uint32_t *dropped = unit->versions.items[version - unit->base_functions].dropped;
    return dropped[index / 32] >> index % 32 & 1;
}

const struct lang_version *lang_version_of(const struct lang_unit *unit, uint32_t id)
{
    if (id < unit->base_functions || id - unit->base_functions >= unit->versions.len)
        return NULL;
    const struct lang_version *version = &unit->versions.items[id - unit->base_functions];
    return version->origin == LANG_NONE ? NULL : version;
}

const union ir_word *lang_param_bound(const struct lang_unit *unit, uint32_t version,
                                      unsigned index)
{
    const struct lang_version *record = lang_version_of(unit, version);
    if (!record)
        return NULL;
    const struct variant *variant = &unit->plan->variants.items[record->variant];
    fact known = unit->plan->facts.items[variant->first_fact + index];
    return known == FACT_UNSEEN || known == FACT_VARIES ? NULL : unit->words.items + known - 1;
}
