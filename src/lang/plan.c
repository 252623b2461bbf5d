// SPDX-License-Identifier: Apache-2.0
/*
 * Whole-shader specialisation: which constants a function may take for granted.
 *
 * A version for each set of constant arguments would be text for each. So calls are made with all their arguments first, and when
 * the shader stands, each function gets one version: a parameter is bound where every call that is left passes the
 * same constant (interprocedural constant propagation). Callees have smaller ids than callers, so one pass from the
 * highest id down sees every call of a function before the function. Only strings and flags, which choose what a function *is*, make
 * versions of their own at once (spec_is_worth_binding).
 */
#include "lang/specialise.h"

enum { UNSEEN, CONSTANT, VARIES };

struct fact { /* what is known of a parameter */
    uint8_t state;
    struct ir_value value;
};

struct lang_plan {
    uint32_t *first_fact; /* by function id: 1 + index of its first fact; 0 = not called */
    uint32_t num_ids;
    VEC(struct fact) facts;
    bool collecting;
};

static struct lang_plan *plan_of(struct lang_unit *unit)
{
    if (!unit->plan) {
        unit->plan = ARENA_NEW(unit->arena, struct lang_plan);
        unit->plan->num_ids = unit->base_functions + unit->functions.len;
        unit->plan->first_fact = ARENA_ARRAY(unit->arena, uint32_t, unit->plan->num_ids);
        unit->plan->collecting = true;
    }
    return unit->plan;
}

static struct fact *facts_of(struct lang_unit *unit, uint32_t id)
{
    struct lang_plan *plan = unit->plan;
    if (!plan->first_fact[id]) {
        uint32_t count = lang_function(unit, id, NULL)->num_params;
        struct fact *facts = vec_extend(unit->arena, &plan->facts, count);
        memset(facts, 0, count * sizeof *facts);
        plan->first_fact[id] = plan->facts.len - count + 1;
    }
    return plan->facts.items + plan->first_fact[id] - 1;
}

static void meet(struct fact *fact, const struct ir_value *value)
{
    if (!value) {
        fact->state = VARIES;
    } else if (fact->state == UNSEEN) {
        fact->state = CONSTANT;
        fact->value = *value;
    } else if (fact->state == CONSTANT && !ir_value_equal(&fact->value, value)) {
        fact->state = VARIES;
    }
}

void lang_plan_call(struct lang_unit *unit, uint32_t id, const struct ir_value *const *args)
{
    plan_of(unit);
    struct fact *facts = facts_of(unit, id);
    uint32_t count = lang_function(unit, id, NULL)->num_params;
    for (uint32_t i = 0; i < count; i++)
        meet(&facts[i], args[i]);
}

bool spec_is_planned(const struct lang_unit *unit)
{
    return unit->plan != NULL;
}

bool spec_is_collecting(const struct lang_unit *unit)
{
    return unit->plan && unit->plan->collecting;
}

void spec_planned_params(struct lang_unit *unit, uint32_t id, lang_ref *bound)
{
    const struct lang_unit *layer;
    const struct lang_function fn = *lang_function(unit, id, &layer);
    struct fact *facts = id < unit->plan->num_ids && unit->plan->first_fact[id] ? facts_of(unit, id) : NULL;
    struct spec s = {.unit = unit};
    for (uint32_t i = 0; i < fn.num_params && i < SPEC_MAX_PARAMS; i++) {
        const struct lang_slot *slot = ast_slot(layer, &fn, i);
        bool known = facts && facts[i].state == CONSTANT && slot->mode == LANG_IN && slot->type != IR_TYPE_SAMPLER;
        bound[i] = known ? spec_constant(&s, &facts[i].value, 0) : 0;
    }
}

static void collect_from(struct lang_unit *unit, uint32_t id)
{
    lang_ref bound[SPEC_MAX_PARAMS] = {0};
    uint32_t nodes = unit->nodes.len, words = unit->words.len;
    spec_planned_params(unit, id, bound);
    spec_visit(unit, id, bound);
    unit->nodes.len = nodes; /* only what it says of its callees was wanted */
    unit->words.len = words;
}

void lang_plan_finish(struct lang_unit *unit)
{
    struct lang_plan *plan = plan_of(unit);
    for (uint32_t id = plan->num_ids; id-- > 0;)
        if (plan->first_fact[id])
            collect_from(unit, id);
    plan->collecting = false;
}

uint32_t lang_plan_version(struct lang_unit *unit, uint32_t id)
{
    static const struct lang_bindings no_options = {0};
    lang_ref bound[SPEC_MAX_PARAMS] = {0};
    spec_planned_params(unit, id, bound);
    return spec_function(unit, &no_options, id, bound, false);
}
