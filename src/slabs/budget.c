// SPDX-License-Identifier: Apache-2.0
#include "slabs/budget.h"

#include "slabs/blend.h"
#include "slabs/estimate.h"
#include "slabs/recognise.h"
#include "slabs/stack.h"

#include <assert.h>

struct saver {
    struct shader *shader;
    struct ir_graph *graph;
    const struct slabs_host *host;
    const struct slab_budget *budget;
    struct slab_report *report;
    struct slab_blend blend;
    struct slab_look whole; /* of the tree before all steps */
    ir_ref root;
    struct slab_spots spots; /* of the root */
    struct slab_cost cost;   /* of the root */
};

/* A step that could come next. */
struct candidate {
    struct slab_step step;
    ir_ref root; /* after it; 0: there is none */
    uint32_t depth;
};

static void set_root(struct saver *s, ir_ref root)
{
    s->root = root;
    slabs_find_spots(s->shader, root, &s->spots);
    s->cost = slabs_cost(s->shader, &s->spots);
}

static struct slab_cost cost_of(const struct saver *s, ir_ref root)
{
    struct slab_spots spots;
    slabs_find_spots(s->shader, root, &spots);
    return slabs_cost(s->shader, &spots);
}

static float error_of(struct saver *s, ir_ref root)
{
    struct slab_look look;
    if (!s->host->scratch)
        return -1.0f;
    slabs_look(s->shader, s->host, root, &s->whole, &look);
    return slabs_difference(&s->whole, &look);
}

static void record(struct saver *s, struct slab_step step, ir_ref root)
{
    step.before = s->cost;
    set_root(s, root);
    step.after = s->cost;
    step.error = error_of(s, root);
    vec_push(s->shader->arena, &s->report->steps, step);
    s->report->error = step.error;
}

/* ---- Steps ---- */

static enum slab_step_kind kind_of(const struct ir_graph *g, ir_ref ref)
{
    switch (ir_get(g, ref)->op) {
    case IR_LAYER:
    case IR_SLAB_LAYER: return SLAB_STEP_LAYER;
    case IR_CLOSURE_ADD: return SLAB_STEP_SUM;
    case IR_CLOSURE_SCALE: return SLAB_STEP_PRODUCT;
    default: return SLAB_STEP_MIX;
    }
}

static bool is_costlier(struct slab_cost a, struct slab_cost b)
{
    return a.closures > b.closures || a.bytes > b.bytes;
}

static bool is_cheaper(struct slab_cost a, struct slab_cost b)
{
    return !is_costlier(a, b) && is_costlier(b, a);
}

/* The document asks to blend the parameters of an operator. */
static bool is_asked(const struct ir_graph *g, ir_ref ref)
{
    const struct ir_node *node = ir_get(g, ref);
    return (node->op == IR_SLAB_LAYER || node->op == IR_CLOSURE_MIX) && node->attr;
}

static struct candidate blend_at(struct saver *s, const struct slab_spot *spot)
{
    struct candidate c = {.depth = s->spots.depth[spot->ref]};
    c.step.kind = kind_of(s->graph, spot->ref);
    c.step.node = spot->ref;
    ir_ref slab = slab_blended(&s->blend, spot);
    c.root = ir_replace(s->graph, s->root, spot->ref, slab, s->shader->arena);
    return c;
}

/* Every slab without features. */
static ir_ref without(const struct saver *s, uint32_t features)
{
    ir_ref root = s->root;
    for (uint32_t i = 0; i < s->spots.items.len; i++) {
        const struct slab_spot *spot = &s->spots.items.items[i];
        if (slab_features(s->graph, spot) & features) {
            ir_ref slab = slab_without(s->graph, spot, features);
            root = ir_replace(s->graph, root, spot->ref, slab, s->shader->arena);
        }
    }
    return root;
}

/* Which operators of two slabs may become one. */
enum choice {
    CHEAPER, /* if the tree is cheaper then */
    ASKED    /* those that the document asks for, if the tree is not costlier then */
};

static bool is_worth(enum choice choice, struct slab_cost after, struct slab_cost before)
{
    return choice == ASKED ? !is_costlier(after, before) : is_cheaper(after, before);
}

/*
 * The deepest operator of a choice, at any cost or only where it is worth it: another operator may
 * need its slabs, too.
 */
static struct candidate deepest_of(struct saver *s, enum choice choice, bool at_any_cost)
{
    struct candidate best = {.root = 0};
    for (uint32_t i = 0; i < s->spots.items.len; i++) {
        const struct slab_spot spot = s->spots.items.items[i];
        if (!slab_can_blend(s->graph, spot.ref)
            || (choice == ASKED && !is_asked(s->graph, spot.ref))
            || (best.root && s->spots.depth[spot.ref] <= best.depth))
            continue;
        struct candidate c = blend_at(s, &spot);
        if (at_any_cost || is_worth(choice, cost_of(s, c.root), s->cost))
            best = c;
    }
    return best;
}

/* Where operators share slabs, several blends together make the tree cheaper. */
static struct candidate deepest_blend(struct saver *s, enum choice choice)
{
    struct candidate c = deepest_of(s, choice, false);
    struct saver further = *s;
    while (!c.root) {
        struct candidate next = deepest_of(&further, choice, true);
        if (!next.root)
            return c;
        set_root(&further, next.root);
        if (is_worth(choice, further.cost, s->cost))
            c = next;
    }
    return c;
}

static struct candidate feature_step(const struct saver *s, enum slab_feature feature)
{
    struct candidate c = {.step = {.kind = SLAB_STEP_FEATURE, .feature = feature}};
    c.root = s->cost.features & 1u << feature ? without(s, 1u << feature) : 0;
    return c;
}

static bool is_below(int feature)
{
    return SLAB_FEATURES_BELOW >> feature & 1u;
}

/* The first feature that the tree has and stores. */
static struct candidate next_feature(const struct saver *s)
{
    struct candidate c = {.root = 0};
    for (int feature = 0; feature < NUM_SLAB_FEATURES && !c.root; feature++)
        if (!is_below(feature))
            c = feature_step(s, (enum slab_feature)feature);
    return c;
}

/* The values that a tree computes after the walk. */
static uint32_t count_walked(const struct saver *s, ir_ref root)
{
    root = slabs_walk(s->shader, s->host, root);
    const uint8_t *needed = ir_mark(s->graph, &root, 1, s->shader->arena);
    uint32_t num = 0;
    for (ir_ref ref = 1; ref <= root; ref++)
        num += needed[ref] && !ir_is_const(s->graph, ref);
    return num;
}

/*
 * A feature of what lies below saves nothing where the roughness there is a constant with it, too.
 * All others save instructions at least.
 */
static bool saves(const struct saver *s, const struct candidate *c)
{
    struct slab_cost cost = cost_of(s, c->root);
    if (c->step.kind != SLAB_STEP_FEATURE)
        return is_cheaper(cost, s->cost);
    return !is_costlier(cost, s->cost)
           && (!is_below((int)c->step.feature)
               || count_walked(s, c->root) < count_walked(s, s->root));
}

static void consider(struct saver *s, struct candidate c, struct candidate *best)
{
    if (!c.root || !saves(s, &c))
        return;
    c.step.error = error_of(s, c.root);
    if (c.step.error >= 0.0f && (!best->root || c.step.error < best->step.error))
        *best = c;
}

/* The step that costs least. */
static struct candidate best_step(struct saver *s)
{
    struct candidate best = {.root = 0};
    for (uint32_t i = 0; i < s->spots.items.len; i++)
        if (slab_can_blend(s->graph, s->spots.items.items[i].ref)) {
            const struct slab_spot spot = s->spots.items.items[i];
            consider(s, blend_at(s, &spot), &best);
        }
    for (int feature = 0; feature < NUM_SLAB_FEATURES; feature++)
        consider(s, feature_step(s, (enum slab_feature)feature), &best);
    return best;
}

/* ---- Limits ---- */

/* False: the steps that the budget wants to see are done. */
static bool goes_on(const struct saver *s)
{
    return s->budget->max_steps < 0 || s->report->steps.len < (uint32_t)s->budget->max_steps;
}

static bool keeps_closures(const struct saver *s)
{
    return !s->budget->max_closures || s->cost.closures <= s->budget->max_closures;
}

static bool keeps_bytes(const struct saver *s)
{
    return !s->budget->max_bytes || s->cost.bytes <= s->budget->max_bytes;
}

static bool keeps(const struct saver *s)
{
    return keeps_closures(s) && keeps_bytes(s);
}

/* The next step towards the limits; root 0: there is none. */
static struct candidate next_step(struct saver *s)
{
    if (s->budget->max_error >= 0.0f) {
        struct candidate best = best_step(s);
        if (best.root)
            return best;
    }
    struct candidate c = deepest_blend(s, CHEAPER);
    return !c.root && keeps_closures(s) ? next_feature(s) : c;
}

static void meet_limits(struct saver *s)
{
    while (!keeps(s) && goes_on(s)) {
        struct candidate c = next_step(s);
        if (!c.root)
            return;
        assert(!is_costlier(cost_of(s, c.root), s->cost));
        record(s, c.step, c.root);
    }
}

/* Cheaper steps until the next one is above the error. */
static void spend_error(struct saver *s)
{
    while (s->budget->max_error >= 0.0f && goes_on(s)) {
        struct candidate c = best_step(s);
        if (!c.root || c.step.error > s->budget->max_error)
            return;
        record(s, c.step, c.root);
    }
}

/* ---- Before the limits ---- */

/* The operators that the document asks to blend, the deepest first. */
static void blend_asked(struct saver *s)
{
    while (goes_on(s)) {
        struct candidate c = deepest_blend(s, ASKED);
        if (!c.root)
            return;
        c.step.kind = SLAB_STEP_ASKED;
        record(s, c.step, c.root);
    }
}

static bool has_limits(const struct slab_budget *budget)
{
    return budget->max_closures || budget->max_bytes || budget->max_error >= 0.0f;
}

bool slabs_is_asked(const struct slab_budget *budget)
{
    return has_limits(budget) || budget->recognises || budget->off;
}

/* An operator that the document asks to blend; 0: there is none. */
static ir_ref find_asked(const struct saver *s)
{
    for (uint32_t i = 0; i < s->spots.items.len; i++)
        if (is_asked(s->graph, s->spots.items.items[i].ref))
            return s->spots.items.items[i].ref;
    return 0;
}

static void recognise(struct saver *s)
{
    if (!goes_on(s) || !s->cost.others || !(s->budget->recognises || has_limits(s->budget)))
        return;
    ir_ref root = slabs_recognise(s->shader, s->host, has_limits(s->budget), s->root);
    if (root != s->root)
        record(s, (struct slab_step){.kind = SLAB_STEP_RECOGNISE}, root);
}

static void turn_off(struct saver *s)
{
    for (int feature = 0; feature < NUM_SLAB_FEATURES; feature++) {
        struct candidate c = feature_step(s, (enum slab_feature)feature);
        if (c.root && s->budget->off & 1u << feature && goes_on(s))
            record(s, c.step, c.root);
    }
}

ir_ref slabs_budget(struct shader *shader, const struct slabs_host *host,
                    const struct slab_budget *budget, ir_ref root, struct slab_report *out)
{
    struct saver s = {.shader = shader,
                      .graph = shader->graph,
                      .host = host,
                      .budget = budget,
                      .report = out,
                      .blend = {shader, host, budget->off}};
    *out = (struct slab_report){.is_met = true};
    if (!root || (!slabs_is_asked(budget) && !slabs_has(shader, root)))
        return root;
    set_root(&s, has_limits(budget) ? slabs_join_stacks(shader, host, root) : root);
    out->before = out->after = s.cost;
    if (!s.cost.closures || (!slabs_is_asked(budget) && !find_asked(&s)))
        return s.root;
    if (host->scratch && goes_on(&s))
        slabs_look(shader, host, s.root, NULL, &s.whole);
    recognise(&s);
    blend_asked(&s);
    turn_off(&s);
    meet_limits(&s);
    out->is_met = !goes_on(&s)
                  || (keeps(&s) && (budget->max_error < 0.0f || out->error <= budget->max_error));
    if (out->is_met)
        spend_error(&s);
    out->unblended = goes_on(&s) ? find_asked(&s) : 0;
    out->after = s.cost;
    return s.root;
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
    static const char *const features[NUM_SLAB_FEATURES] = {
#define SLAB_FEATURE(id, key, doc) doc,
#include "slabs/features.def"
#undef SLAB_FEATURE
    };
    text_str(out, kinds[step->kind]);
    if (step->kind == SLAB_STEP_FEATURE)
        text_fmt(out, " %s", features[step->feature]);
    else if (step->node)
        text_fmt(out, " '%s'", slabs_name(shader, step->node));
}
