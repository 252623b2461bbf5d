// SPDX-License-Identifier: Apache-2.0
#include "slabs/budget.h"

#include "slabs/features.h"
#include "slabs/hidden_slabs.h"
#include "slabs/recognise.h"
#include "slabs/search.h"
#include "slabs/joined_surfaces.h"

#include <assert.h>

struct spender {
    struct slab_saver saver;
    const struct slab_budget *budget;
    struct slab_report *report;
};

/* Takes a step whose error is known. */
static void record(struct spender *s, struct slab_step step, ir_ref root)
{
    step.before = s->saver.cost;
    slab_saver_set_root(&s->saver, root);
    step.after = s->saver.cost;
    vec_push(s->saver.shader->arena, &s->report->steps, step);
    s->report->error = step.error;
}

/* After a search that was cut short, steps in order may take as long again. */
static bool affords_estimates(const struct spender *s)
{
    return s->saver.eye && slabs_num_steps(s->saver.eye) < 2 * (uint64_t)SLAB_SEARCH_STEPS;
}

static void take(struct spender *s, struct slab_step step, ir_ref root)
{
    step.error = affords_estimates(s) ? slab_saver_error(&s->saver, root) : -1.0f;
    record(s, step, root);
}

/* The error of all steps, which is told in any case. */
static void estimate_result(struct spender *s)
{
    if (!s->report->steps.len || s->report->error >= 0.0f)
        return;
    s->report->error = slab_saver_error(&s->saver, s->saver.root);
    vec_last(&s->report->steps).error = s->report->error;
}

/* False: the steps that the budget wants to see are done. */
static bool goes_on(const struct spender *s)
{
    return s->budget->max_steps < 0 || s->report->steps.len < (uint32_t)s->budget->max_steps;
}

/* ---- Limits ---- */

static bool has_limits(const struct slab_budget *budget)
{
    return budget->max_slabs || budget->max_bytes || budget->max_error >= 0.0f;
}

static bool keeps_slabs(const struct spender *s)
{
    return slab_keeps_slabs(s->budget, s->saver.cost);
}

static bool keeps_bytes(const struct spender *s)
{
    return slab_keeps_bytes(s->budget, s->saver.cost);
}

static bool keeps_error(const struct spender *s)
{
    float error = s->report->error;
    return s->budget->max_error < 0.0f || (error >= 0.0f && error <= s->budget->max_error);
}

/* Blends, and then features, until closures and bytes are few enough. */
static void take_in_order(struct spender *s)
{
    while ((!keeps_slabs(s) || !keeps_bytes(s)) && goes_on(s)) {
        struct slab_candidate c = slab_next_blend(&s->saver, SLAB_CHEAPER);
        if (!c.root && keeps_slabs(s))
            c = slab_next_feature(&s->saver);
        if (!c.root)
            return;
        take(s, c.step, c.root);
    }
}

/* Blends within the largest error, if there is one. */
static void take_within_error(struct spender *s)
{
    while (s->budget->max_error >= 0.0f && keeps_error(s) && goes_on(s) && affords_estimates(s)) {
        struct slab_candidate c = slab_next_blend(&s->saver, SLAB_CHEAPER);
        c.step.error = c.root ? slab_saver_error(&s->saver, c.root) : -1.0f;
        if (c.step.error < 0.0f || c.step.error > s->budget->max_error)
            return;
        record(s, c.step, c.root);
    }
}

/* The order of steps matters: for an error, and for bytes that features or blends may save. */
static bool searches(const struct spender *s)
{
    return s->saver.eye && (s->budget->max_error >= 0.0f || !keeps_bytes(s));
}

static void take_best(struct spender *s)
{
    struct slab_candidates steps = {0};
    bool is_whole = slabs_search(&s->saver, s->budget, &steps);
    for (uint32_t i = 0; i < steps.items.len && goes_on(s); i++)
        record(s, steps.items.items[i].step, steps.items.items[i].root);
    if (!is_whole || !keeps_bytes(s))
        take_in_order(s);
    if (!is_whole)
        take_within_error(s);
}

/* ---- Before the limits ---- */

/* Operators of a choice, the deepest first. */
static void blend_while_any(struct spender *s, enum slab_choice choice)
{
    while (goes_on(s)) {
        struct slab_candidate c = slab_next_blend(&s->saver, choice);
        if (!c.root)
            return;
        c.step.kind = choice == SLAB_ASKED ? SLAB_STEP_ASKED : c.step.kind;
        take(s, c.step, c.root);
    }
}

bool slabs_is_asked(const struct slab_budget *budget)
{
    return has_limits(budget) || budget->recognises || budget->off;
}

static void recognise(struct spender *s)
{
    if (!goes_on(s) || !s->saver.cost.others || !(s->budget->recognises || has_limits(s->budget)))
        return;
    const struct slab_saver *saver = &s->saver;
    ir_ref root = slabs_recognise(saver->shader, saver->host, has_limits(s->budget), saver->root);
    root = slabs_visible(saver->graph, root, saver->shader->arena);
    if (root != saver->root)
        take(s, (struct slab_step){.kind = SLAB_STEP_RECOGNISE}, root);
}

static void turn_off(struct spender *s)
{
    for (int i = 0; i < NUM_SLAB_FEATURES; i++) {
        struct slab_candidate c = slab_feature_step(&s->saver, (enum slab_feature)i);
        if (c.root && s->budget->off & 1u << i && goes_on(s))
            take(s, c.step, c.root);
    }
}

ir_ref slabs_budget(struct shader *shader, const struct slabs_host *host,
                    const struct slab_budget *budget, ir_ref root, struct slab_report *out)
{
    *out = (struct slab_report){.is_met = true};
    if (!root || (!slabs_is_asked(budget) && !slabs_has(shader, root)))
        return root;
    if (has_limits(budget))
        root = slabs_join_stacks(shader, host, root);
    root = slabs_visible(shader->graph, root, shader->arena);
    struct spender s = {slab_saver_of(shader, host, budget->off, root), budget, out};
    out->before = out->after = s.saver.cost;
    out->is_too_much = slabs_has(shader, root)
                       && slabs_num_closures(shader->graph, root, shader->arena) > SLABS_MAX;
    if (out->is_too_much)
        return root;
    if (!s.saver.cost.closures || (!slabs_is_asked(budget) && !slab_find_asked(&s.saver)))
        return root;
    recognise(&s);
    blend_while_any(&s, SLAB_ASKED);
    turn_off(&s);
    if (searches(&s))
        take_best(&s);
    else
        take_in_order(&s);
    if (budget->blends_all)
        blend_while_any(&s, SLAB_ANY);
    estimate_result(&s);
    out->is_met = !goes_on(&s) || (keeps_slabs(&s) && keeps_bytes(&s) && keeps_error(&s));
    out->unblended = goes_on(&s) ? slab_find_asked(&s.saver) : 0;
    out->after = s.saver.cost;
    out->num_steps = s.saver.eye ? slabs_num_steps(s.saver.eye) : 0;
    return s.saver.root;
}

const char *slabs_name(const struct shader *shader, ir_ref ref)
{
    const struct ir_graph *g = shader->graph;
    str_id name = g->origins.items[ir_get(g, ref)->origin].name;
    return name ? str_text(shader->strings, name) : "?";
}

void slabs_describe_step(const struct shader *shader, const struct slab_step *step,
                         struct text *out)
{
    static const char *const kinds[NUM_SLAB_STEPS] = {
        [SLAB_STEP_RECOGNISE] = "all closures become slabs",
        [SLAB_STEP_ASKED] = "one slab for",
        [SLAB_STEP_LAYER] = "one slab for the layer",
        [SLAB_STEP_MIX] = "one slab for the mix",
        [SLAB_STEP_SUM] = "one slab for the sum",
        [SLAB_STEP_PRODUCT] = "one slab for the product",
        [SLAB_STEP_FEATURE] = "no",
    };
    text_str(out, kinds[step->kind]);
    if (step->kind == SLAB_STEP_FEATURE)
        text_fmt(out, " %s", slab_feature_names[step->feature]);
    else if (step->node)
        text_fmt(out, " '%s'", slabs_name(shader, step->node));
}
