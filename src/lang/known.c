// SPDX-License-Identifier: Apache-2.0
/*
 * Versions of the library's functions that were made when it was packed. Shading models call the
 * same functions with the same constants in every shader: what became of these in a rehearsal
 * (api/rehearse.c) is copied behind the library's functions, with what it was made for. A plan
 * (plan.c) takes such a version for a variant with equal facts as long as its calls get the
 * versions that it was made with.
 */
#include "lang/specialise.h"

/* ---- Facts ---- */

static bool is_same_fact(const struct lang_unit *a_unit, fact a, const struct lang_unit *b_unit,
                         fact b, ir_type_id type)
{
    if (a == FACT_VARIES || a == FACT_UNSEEN || b == FACT_VARIES)
        return (a == FACT_VARIES || a == FACT_UNSEEN) && b == FACT_VARIES;
    return memcmp(a_unit->words.items + a - 1, b_unit->words.items + b - 1,
                  ir_type_info(type)->components * sizeof(union ir_word))
           == 0;
}

/* A value that is known in one unit, known in another. */
static fact copy_fact(const struct lang_unit *from, fact known, ir_type_id type,
                      struct lang_unit *to)
{
    if (known == FACT_VARIES || known == FACT_UNSEEN)
        return FACT_VARIES;
    uint32_t count = ir_type_info(type)->components, at = to->words.len;
    memcpy(vec_extend(to->arena, &to->words, count), from->words.items + known - 1,
           count * sizeof(union ir_word));
    return at + 1;
}

static const fact *facts_of(const struct spec *s)
{
    const struct lang_plan *plan = s->unit->plan;
    return plan->facts.items + plan->variants.items[s->variant].first_fact;
}

/*
 * What a call says: the function, its version, and what is passed. Returns where the next one
 * stands.
 */
static const uint32_t *next_call(const struct lang_unit *unit, const uint32_t *call)
{
    return call + 2 + lang_function(unit, call[0], NULL)->num_params;
}

/* ---- Use ---- */

static bool fits(const struct spec *s, const struct lang_known *known)
{
    const struct variant *v = &s->unit->plan->variants.items[s->variant];
    const fact *have = facts_of(s), *want = s->layer->known_facts.items + known->first_fact;
    if (known->function != v->function || known->choice != s->unit->host.choice)
        return false;
    for (uint32_t i = 0; i < s->fn.num_params; i++)
        if (!is_same_fact(s->unit, have[i], s->layer, want[i], ast_slot(s->layer, &s->fn, i)->type))
            return false;
    return !v->keeps_unused;
}

/* Do its calls get the versions that it was made with? */
static bool has_callees(const struct spec *s, const struct lang_known *known)
{
    const struct lang_plan *plan = s->unit->plan;
    const uint32_t *call = s->layer->known_facts.items + known->first_fact + s->fn.num_params;
    const uint32_t *variants = plan->calls.items + plan->variants.items[s->variant].first_call;
    for (uint32_t i = 0; i < known->num_calls; i++, call = next_call(s->layer, call)) {
        const struct variant *called = &plan->variants.items[variants[i]];
        if (called->function != call[0] || called->version != call[1])
            return false;
    }
    return true;
}

static const struct lang_known *find(const struct spec *s, const struct lang_known *from,
                                     bool with_callees)
{
    const struct lang_known *end = s->layer->known.items + s->layer->known.len;
    for (; from < end; from++)
        if (fits(s, from) && (!with_callees || has_callees(s, from)))
            return from;
    return NULL;
}

bool known_begin(struct spec *s)
{
    struct lang_unit *unit = s->unit;
    const struct lang_known *known =
        s->layer->known.len ? find(s, s->layer->known.items, false) : NULL;
    if (!known)
        return false;
    const uint32_t *call = s->layer->known_facts.items + known->first_fact + s->fn.num_params,
                   *next;
    uint32_t first_call = unit->plan->calls.len;
    for (uint32_t i = 0; i < known->num_calls; i++, call = next) {
        const struct lang_unit *layer;
        const struct lang_function *callee = lang_function(s->layer, call[0], &layer);
        fact args[SPEC_MAX_PARAMS];
        next = next_call(s->layer, call);
        for (uint32_t k = 0; k < callee->num_params; k++)
            args[k] = copy_fact(s->layer, call[2 + k], ast_slot(layer, callee, k)->type, unit);
        uint32_t called = plan_note_call(unit, call[0], args, false);
        vec_push(unit->arena, &unit->plan->calls, called);
    }
    unit->plan->variants.items[s->variant].first_call = first_call;
    unit->plan->variants.items[s->variant].is_known = true;
    return true;
}

uint32_t known_version(const struct spec *s)
{
    const struct lang_known *known =
        s->layer->known.len ? find(s, s->layer->known.items, true) : NULL;
    return known ? s->layer->base_functions + s->layer->functions.len - s->layer->known.len
                       + (uint32_t)(known - s->layer->known.items)
                 : LANG_NONE;
}

/* ---- Taking down ---- */

/* The number that a function of the generation has in the library; LANG_NONE: it is not there. */
static uint32_t id_in_library(const struct lang_unit *made, uint32_t id)
{
    const struct lang_recorder *recorder = made->recorder;
    if (id < made->base_functions)
        return id;
    id -= made->base_functions;
    return id < recorder->version_ids.len ? recorder->version_ids.items[id] : LANG_NONE;
}

static bool take_call(const struct spec *s, const struct lang_node *call, struct lang_unit *to)
{
    const struct variant *called = &s->unit->plan->variants.items[call->c - 1];
    uint32_t version = id_in_library(s->unit, called->version);
    vec_push(to->arena, &to->known_facts, call->a);
    vec_push(to->arena, &to->known_facts, version);
    for (lang_ref ref = call->b; ref; ref = ast_node(s->unit, ref)->next) {
        const struct lang_node *arg = ast_node(s->unit, ref);
        fact known =
            copy_fact(s->unit, arg->kind == LANG_CONST ? arg->a + 1 : FACT_VARIES, arg->type, to);
        vec_push(to->arena, &to->known_facts, known);
    }
    return version != LANG_NONE && !called->keeps_unused
           && lang_function(s->unit, call->a, NULL)->num_params <= SPEC_MAX_PARAMS;
}

void known_take_calls(struct spec *s)
{
    struct lang_recorder *recorder = s->unit->recorder;
    struct lang_unit *to = &recorder->library;
    const struct variant v = s->unit->plan->variants.items[s->variant];
    recorder->first_fact = to->known_facts.len;
    recorder->first_word = to->words.len;
    recorder->is_known = !s->layer->base && !v.keeps_unused && s->fn.num_params <= SPEC_MAX_PARAMS
                         && s->unit->host.choice != LANG_NONE;
    for (uint32_t i = 0; i < s->fn.num_params && recorder->is_known; i++) {
        fact known = copy_fact(s->unit, facts_of(s)[i], ast_slot(s->layer, &s->fn, i)->type, to);
        vec_push(to->arena, &to->known_facts, known);
    }
    for (uint32_t i = 0; i < v.num_calls && recorder->is_known; i++)
        recorder->is_known =
            take_call(s, spec_node(s, s->unit->plan->calls.items[v.first_call + i]), to);
}

/*
 * Two versions of a function with equal facts, whose calls are the same then, got the same callees.
 */
static bool is_equal(const struct lang_unit *unit, const struct lang_known *a,
                     const struct lang_known *b)
{
    const struct lang_function *fn = lang_function(unit, a->function, NULL);
    const uint32_t *x = unit->known_facts.items + a->first_fact,
                   *y = unit->known_facts.items + b->first_fact;
    if (a->function != b->function || a->choice != b->choice || a->num_calls != b->num_calls)
        return false;
    for (uint32_t i = 0; i < fn->num_params; i++)
        if (!is_same_fact(unit, x[i], unit, y[i], ast_slot(unit, fn, i)->type))
            return false;
    x += fn->num_params;
    y += fn->num_params;
    for (uint32_t i = 0; i < a->num_calls; i++, x = next_call(unit, x), y = next_call(unit, y))
        if (x[0] != y[0] || x[1] != y[1])
            return false;
    return true;
}

/* Whether everything that the version calls is in the library. */
static bool has_its_callees(const struct lang_unit *made, uint32_t version)
{
    const struct lang_function *fn = lang_function(made, version, NULL);
    for (uint32_t i = 0; i < fn->num_callees; i++)
        if (id_in_library(made, made->refs.items[fn->first_callee + i]) == LANG_NONE)
            return false;
    return true;
}

static uint32_t add_known(struct lang_unit *library, const struct lang_unit *made, uint32_t version,
                          struct lang_known known)
{
    for (uint32_t i = 0; i < library->known.len; i++)
        if (is_equal(library, &library->known.items[i], &known))
            return library->functions.len - library->known.len + i;
    uint32_t id = lang_copy_version(library, made, version, made->recorder->version_ids.items);
    vec_push(library->arena, &library->known, known);
    return id;
}

void known_take_version(struct spec *s)
{
    struct lang_unit *made = s->unit;
    struct lang_recorder *recorder = made->recorder;
    const struct variant *v = &made->plan->variants.items[s->variant];
    uint32_t num_known = recorder->library.known.len;
    if (v->version >= made->base_functions) {
        while (recorder->version_ids.len <= v->version - made->base_functions)
            vec_push(recorder->arena, &recorder->version_ids, LANG_NONE);
        struct lang_known known = {.function = v->function,
                                   .choice = made->host.choice,
                                   .first_fact = recorder->first_fact,
                                   .num_calls = v->num_calls};
        memcpy(known.dropped, made->versions.items[v->version - made->base_functions].dropped,
               sizeof known.dropped);
        if (recorder->is_known && has_its_callees(made, v->version))
            recorder->version_ids.items[v->version - made->base_functions] =
                add_known(&recorder->library, made, v->version, known);
    }
    if (recorder->library.known.len > num_known)
        return;
    recorder->library.known_facts.len = recorder->first_fact;
    recorder->library.words.len = recorder->first_word;
}
