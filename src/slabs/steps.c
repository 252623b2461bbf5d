// SPDX-License-Identifier: Apache-2.0
#include "slabs/steps.h"

#include "slabs/features.h"
#include "slabs/hidden_slabs.h"

/* ---- The tree ---- */

/* Where estimates are made, what serves one tree alone is given back: a search has many. */
static struct arena *scratch_of(const struct slab_saver *s)
{
    return s->host->scratch ? s->host->scratch : s->shader->arena;
}

static void empty_scratch(const struct slab_saver *s)
{
    if (s->host->scratch)
        arena_finish(s->host->scratch);
}

void slab_saver_set_root(struct slab_saver *s, ir_ref root)
{
    s->root = root;
    slabs_find_spots(s->graph, root, s->shader->arena, &s->spots);
    s->cost = slab_saver_cost(s, root);
}

/* Points of an estimate have no footprint, and no surroundings. */
enum { UNSEEN = 1u << SLAB_GLINTS | 1u << SLAB_REFRACTION };

struct slab_saver slab_saver_of(struct shader *shader, const struct slabs_host *host, uint32_t off,
                                ir_ref root)
{
    struct slab_saver s = {.shader = shader,
                           .graph = shader->graph,
                           .host = host,
                           .blend = {shader, host, off},
                           .eye = host->scratch ? slabs_open_eye(shader, host, root) : NULL};
    slab_saver_set_root(&s, root);
    s.unseen = s.cost.features & UNSEEN;
    return s;
}

struct slab_cost slab_saver_cost(const struct slab_saver *s, ir_ref root)
{
    struct slab_cost cost = slabs_cost(s->graph, root, scratch_of(s));
    empty_scratch(s);
    return cost;
}

float slab_saver_error(const struct slab_saver *s, ir_ref root)
{
    if (!s->eye || (s->unseen && s->unseen & ~slab_saver_cost(s, root).features))
        return -1.0f;
    return slabs_estimate(s->eye, root);
}

bool slab_keeps_slabs(const struct slab_budget *budget, struct slab_cost cost)
{
    return !budget->max_slabs || cost.closures <= budget->max_slabs;
}

bool slab_keeps_bytes(const struct slab_budget *budget, struct slab_cost cost)
{
    return !budget->max_bytes || cost.bytes <= budget->max_bytes;
}

bool slab_cost_is_higher(struct slab_cost cost, struct slab_cost than)
{
    return cost.closures > than.closures || cost.bytes > than.bytes;
}

static bool is_lower(struct slab_cost cost, struct slab_cost than)
{
    return !slab_cost_is_higher(cost, than) && slab_cost_is_higher(than, cost);
}

/* ---- Blends ---- */

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

/* The document asks to blend the parameters of two slabs; one slab alone needs no blend. */
static bool is_asked(const struct ir_graph *g, ir_ref ref)
{
    const struct ir_node *node = ir_get(g, ref);
    return (node->op == IR_SLAB_LAYER || node->op == IR_CLOSURE_MIX) && node->attr
           && ir_arg(g, ref, 0) && ir_arg(g, ref, 1);
}

ir_ref slab_find_asked(const struct slab_saver *s)
{
    for (uint32_t i = 0; i < s->spots.items.len; i++)
        if (is_asked(s->graph, s->spots.items.items[i].ref))
            return s->spots.items.items[i].ref;
    return 0;
}

static uint32_t depth_of(const struct slab_saver *s, ir_ref ref)
{
    return s->spots.depth[slab_node_at(&s->spots.nodes, ref)];
}

/*
 * The saver's tree with other closures in the places of some, as far as it is visible; by: per node
 * of its spots.
 */
static ir_ref replaced(const struct slab_saver *s, const ir_ref *by)
{
    ir_ref root = slabs_replace(s->graph, &s->spots.nodes, by, scratch_of(s));
    root = slabs_visible(s->graph, root, scratch_of(s));
    empty_scratch(s);
    return root;
}

static ir_ref *no_replacements(const struct slab_saver *s)
{
    return ARENA_ARRAY(scratch_of(s), ir_ref, s->spots.nodes.items.len);
}

static struct slab_candidate blend_at(const struct slab_saver *s, const struct slab_spot *spot)
{
    struct slab_candidate c = {.depth = depth_of(s, spot->ref)};
    c.step.kind = kind_of(s->graph, spot->ref);
    c.step.node = spot->ref;
    ir_ref slab = slab_blended(&s->blend, spot); /* it may estimate, which empties the scratch */
    ir_ref *by = no_replacements(s);
    by[slab_node_at(&s->spots.nodes, spot->ref)] = slab;
    c.root = replaced(s, by);
    return c;
}

static bool is_worth(enum slab_choice choice, struct slab_cost after, struct slab_cost before)
{
    return choice == SLAB_ANY
           || (choice == SLAB_ASKED ? !slab_cost_is_higher(after, before)
                                    : is_lower(after, before));
}

/* The spot that a choice may blend and that comes after `last`: the deepest first, of equal ones in
 * their order. `last` NULL: the first spot. NULL: there is none. */
static const struct slab_spot *next_deepest(const struct slab_saver *s, enum slab_choice choice,
                                            const struct slab_spot *last)
{
    const struct slab_spot *best = NULL;
    for (uint32_t i = 0; i < s->spots.items.len; i++) {
        const struct slab_spot *spot = &s->spots.items.items[i];
        uint32_t depth = depth_of(s, spot->ref), before = last ? depth_of(s, last->ref) : 0;
        bool is_left = !last || depth < before || (depth == before && spot > last);
        if (is_left && slab_can_blend(s->graph, spot->ref)
            && (choice != SLAB_ASKED || is_asked(s->graph, spot->ref))
            && (!best || depth > depth_of(s, best->ref)))
            best = spot;
    }
    return best;
}

/*
 * The deepest operator of a choice, at any cost or only where it is worth it: another operator may
 * need its slabs, too.
 */
static struct slab_candidate deepest_of(const struct slab_saver *s, enum slab_choice choice,
                                        bool at_any_cost)
{
    const struct slab_spot *spot = next_deepest(s, choice, NULL);
    for (; spot; spot = next_deepest(s, choice, spot)) {
        struct slab_candidate c = blend_at(s, spot);
        if (at_any_cost || is_worth(choice, slab_saver_cost(s, c.root), s->cost))
            return c;
    }
    return (struct slab_candidate){.root = 0};
}

struct slab_candidate slab_next_blend(const struct slab_saver *s, enum slab_choice choice)
{
    struct slab_candidate c = deepest_of(s, choice, false);
    struct slab_saver further = *s;
    while (!c.root) {
        struct slab_candidate next = deepest_of(&further, choice, true);
        if (!next.root)
            return c;
        slab_saver_set_root(&further, next.root);
        if (is_worth(choice, further.cost, s->cost))
            c = next;
    }
    return c;
}

/* ---- Features ---- */

struct slab_candidate slab_feature_step(const struct slab_saver *s, enum slab_feature feature)
{
    struct slab_candidate c = {.step = {.kind = SLAB_STEP_FEATURE, .feature = feature}};
    ir_ref *by = no_replacements(s);
    for (uint32_t i = 0; i < s->spots.items.len; i++) {
        const struct slab_spot *spot = &s->spots.items.items[i];
        ir_ref *slab = &by[slab_node_at(&s->spots.nodes, spot->ref)];
        if (!*slab && slab_features(s->graph, spot) & 1u << feature)
            *slab = slab_without(s->graph, spot, 1u << feature);
    }
    ir_ref root = replaced(s, by);
    c.root = root == s->root ? 0 : root;
    return c;
}

static bool is_below(enum slab_feature feature)
{
    return SLAB_FEATURES_BELOW >> feature & 1u;
}

struct slab_candidate slab_next_feature(const struct slab_saver *s)
{
    struct slab_candidate c = {.root = 0};
    for (int i = 0; i < NUM_SLAB_FEATURES && !c.root; i++)
        if (!is_below((enum slab_feature)i))
            c = slab_feature_step(s, (enum slab_feature)i);
    return c;
}

/* The values that a tree computes after the walk. */
static uint32_t count_walked(const struct slab_saver *s, ir_ref root)
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
static bool saves(const struct slab_saver *s, const struct slab_candidate *c)
{
    struct slab_cost cost = slab_saver_cost(s, c->root);
    if (c->step.kind != SLAB_STEP_FEATURE)
        return is_lower(cost, s->cost);
    return !slab_cost_is_higher(cost, s->cost)
           && (!is_below(c->step.feature) || count_walked(s, c->root) < count_walked(s, s->root));
}

static void add_step(const struct slab_saver *s, struct slab_candidate c,
                     struct slab_candidates *out)
{
    if (c.root && saves(s, &c))
        vec_push(s->shader->arena, &out->items, c);
}

void slab_find_steps(const struct slab_saver *s, struct slab_candidates *out)
{
    for (uint32_t i = 0; i < s->spots.items.len; i++) {
        const struct slab_spot spot = s->spots.items.items[i];
        if (slab_can_blend(s->graph, spot.ref))
            add_step(s, blend_at(s, &spot), out);
    }
    if (!out->items.len)
        add_step(s, slab_next_blend(s, SLAB_CHEAPER), out);
    for (int i = 0; i < NUM_SLAB_FEATURES; i++)
        add_step(s, slab_feature_step(s, (enum slab_feature)i), out);
}
