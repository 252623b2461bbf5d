// SPDX-License-Identifier: Apache-2.0
/* Budgets of slabs: the options, and what they led to. */
#include "api/generation.h"

#include "base/json.h"
#include "slabs/budget.h"
#include "slabs/difference.h"
#include "slabs/features.h"

#include <assert.h>

double mxg_color_difference(const float a[3], const float b[3])
{
    return a && b ? color_difference(a, b) : -1.0;
}

/* ---- The options ---- */

/* The bit of "-fuzz". */
static uint32_t feature_bit(const char *word)
{
    unsigned i = 0;
    while (i < NUM_SLAB_FEATURES && strcmp(slab_feature_keys[i], word + 1) != 0)
        i++;
    assert(i < NUM_SLAB_FEATURES);
    return 1u << i;
}

void generation_slab_features(struct generation *g)
{
    const struct option_value *features = &g->options[OPTION_features];
    for (uint32_t i = 0; i < features->list.len; i++)
        g->slab_features_off |= feature_bit(features->list.items[i]);
}

struct slab_budget generation_slab_budget(const struct generation *g)
{
    bool packs_one = g->role->returns == RETURNS_PAYLOAD;
    return (struct slab_budget){
        .max_slabs = packs_one ? 1 : (uint32_t)g->options[OPTION_max_slabs].number,
        .max_bytes = (uint32_t)g->options[OPTION_max_bytes].number,
        .max_error = g->options[OPTION_max_error].real,
        .off = g->slab_features_off,
        .recognises = g->options[OPTION_slabs].number != 0 || packs_one,
        .max_steps = packs_one ? -1 : (int32_t)g->options[OPTION_max_steps].number,
    };
}

/* ---- The report ---- */

void generation_write_error(struct text *out, float error)
{
    if (error < 0.0f)
        text_str(out, "unknown");
    else
        text_float(out, (float)(int)(error * 100.0f + 0.5f) / 100.0f);
}

static void report_step(struct generation *g, const struct slab_step *step)
{
    struct text what, error;
    const struct document *doc = &g->document->layer.doc;
    text_init(&what, &g->scratch);
    text_init(&error, &g->scratch);
    slabs_describe_step(&g->result->shader, step, &what);
    generation_write_error(&error, step->error);
    diag_add(diags_of(g), DIAG_ID_budget_step, doc_place(doc, g->element), text_cstr(&what),
             (unsigned)step->before.closures, (unsigned)step->after.closures,
             (unsigned)step->before.bytes, (unsigned)step->after.bytes, text_cstr(&error));
}

static void report_failure(struct generation *g, const struct slab_budget *budget)
{
    const struct slab_report *report = &g->result->slabs;
    struct text limits, error;
    const struct document *doc = &g->document->layer.doc;
    text_init(&limits, &g->scratch);
    text_init(&error, &g->scratch);
    generation_write_error(&error, report->error);
    if (g->role->returns == RETURNS_PAYLOAD)
        text_str(&limits, "a payload, which is one slab");
    else if (budget->max_slabs)
        text_count(&limits, budget->max_slabs, "slab", "slabs");
    if (budget->max_bytes)
        text_fmt(&limits, "%s%u bytes", limits.len ? ", " : "", (unsigned)budget->max_bytes);
    if (budget->max_error >= 0.0f) {
        text_fmt(&limits, "%san error of ", limits.len ? ", " : "");
        generation_write_error(&limits, budget->max_error);
    }
    diag_add(diags_of(g), DIAG_ID_budget_impossible, doc_place(doc, g->element), text_cstr(&limits),
             (unsigned)report->after.closures, (unsigned)report->after.bytes, text_cstr(&error));
}

/* ---- Estimates ---- */

static void spend_budget(struct generation *g, struct arena *estimates)
{
    const struct slab_budget budget = generation_slab_budget(g);
    g->root = build_budget_slabs(g->builder, &g->closure_host, estimates, &budget, g->root,
                                 &g->result->slabs);
}

static void estimate(struct generation *g)
{
    if (!generation_start(g) || !generation_build(g))
        return;
    generation_start_closures(g);
    generation_hide_misfits(g);
    spend_budget(g, &g->estimates);
}

/*
 * Estimates for messages alone. They add nodes to a graph and may read textures, so a generation of
 * their own makes them: a message that is shown does not change the shader.
 */
static void estimate_apart(struct generation *g)
{
    struct slab_report *report = &g->result->slabs;
    mxg_result *apart = NULL;
    if (generation_run(g->result->object.context, g->document, &g->desc, estimate, NULL, &apart)
            == MXG_OK
        && apart->slabs.steps.len == report->steps.len) {
        report->error = apart->slabs.error;
        for (uint32_t i = 0; i < report->steps.len; i++)
            report->steps.items[i].error = apart->slabs.steps.items[i].error;
    }
    mxg_result_destroy(apart);
}

static bool is_error_shown(struct generation *g)
{
    const struct slab_report *report = &g->result->slabs;
    return !report->is_met
           || (report->steps.len && diag_is_shown(diags_of(g), DIAG_ID_budget_step));
}

bool generation_slabs_are_few(struct generation *g, const struct slab_report *report)
{
    if (report->is_too_much)
        diag_add(diags_of(g), DIAG_ID_too_many_slabs,
                 doc_place(&g->document->layer.doc, g->element),
                 str_text(g->result->shader.strings, g->result->shader.reflection.name),
                 (unsigned)SLABS_MAX);
    return !report->is_too_much;
}

bool generation_budget_slabs(struct generation *g)
{
    if (role_is_pass(g->role)) /* it has the lobes of all slabs */
        return true;
    struct slab_budget budget = generation_slab_budget(g);
    struct slab_report *report = &g->result->slabs;
    bool has_estimates = budget.max_error >= 0.0f || budget.max_bytes;
    spend_budget(g, has_estimates ? &g->estimates : NULL);
    ir_assert_valid(&g->result->graph, "after the budget of slabs");
    if (!generation_slabs_are_few(g, report))
        return false;
    if (!has_estimates && is_error_shown(g))
        estimate_apart(g);
    for (uint32_t i = 0; i < report->steps.len; i++)
        report_step(g, &report->steps.items[i]);
    if (report->unblended)
        diag_add(diags_of(g), DIAG_ID_not_blended, doc_place(&g->document->layer.doc, g->element),
                 slabs_name(&g->result->shader, report->unblended));
    if (!report->is_met)
        report_failure(g, &budget);
    return report->is_met;
}

void generation_tell_media(struct generation *g)
{
    const struct shader *shader = &g->result->shader;
    if (shader->reflection.not_walked)
        diag_add(diags_of(g), DIAG_ID_media_not_walked,
                 doc_place(&g->document->layer.doc, g->element),
                 str_text(shader->strings, shader->reflection.name), shader->reflection.not_walked);
}
