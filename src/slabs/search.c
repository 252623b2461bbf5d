// SPDX-License-Identifier: Apache-2.0
/*
 * A beam search: of the trees after n steps, those with the least errors go on. Errors need not
 * grow from step to step, so a tree beyond the limit may lead to one within it; MARGIN says how far
 * beyond. Steps in another order often lead to the same tree, which the graph has once. A blend may
 * make a second lobe, which takes a word, so a second pass begins anew with blends that make none.
 */
#include "slabs/search.h"

#include <math.h>

/* Trees that go on for each number of steps: large trees take longer, and have more steps. */
enum { WIDTH = 3, WIDTH_OF_LARGE = 1, LARGE = 8 /* closures */ };
#define MARGIN 1.5f

/* A tree, and the step that leads to it. */
struct state {
    struct slab_candidate by;
    struct slab_cost cost;
    float error;
    uint32_t parent; /* index of the tree before; of the first tree its own */
    bool is_open;    /* no step from it has been tried */
};

struct search {
    struct slab_saver saver; /* at any tree */
    const struct slab_budget *limits;
    VEC(struct state) states;
    uint32_t pass; /* its first state after the tree before all steps */
};

/* ---- Ends ---- */

enum fault { NONE, TOO_FAR, TOO_LARGE };

static enum fault fault_of(const struct search *s, const struct state *state)
{
    if (!slab_keeps_slabs(s->limits, state->cost) || !slab_keeps_bytes(s->limits, state->cost))
        return TOO_LARGE;
    return s->limits->max_error < 0.0f || state->error <= s->limits->max_error ? NONE : TOO_FAR;
}

/* Without a largest error, the end with the least one is the best. */
static bool looks_for_error(const struct search *s, enum fault fault)
{
    return fault == TOO_FAR || (fault == NONE && s->limits->max_error < 0.0f);
}

static uint32_t num_features(const struct state *state)
{
    uint32_t num = 0;
    for (uint32_t bits = state->cost.features; bits; bits &= bits - 1)
        num++;
    return num;
}

/* True if a is the better end. */
static bool is_better(const struct search *s, const struct state *a, const struct state *b)
{
    enum fault of_a = fault_of(s, a), of_b = fault_of(s, b);
    const uint32_t sizes[][2] = {{of_a, of_b},
                                 {a->cost.closures, b->cost.closures},
                                 {a->cost.bytes, b->cost.bytes},
                                 {num_features(a), num_features(b)}};
    size_t num_sizes = looks_for_error(s, of_a) ? 1 : sizeof sizes / sizeof *sizes;
    for (size_t i = 0; i < num_sizes; i++)
        if (sizes[i][0] != sizes[i][1])
            return sizes[i][0] < sizes[i][1];
    return a->error < b->error;
}

/* ---- Levels ---- */

/* The last state with a tree; NULL: it is new. */
static struct state *state_of(const struct search *s, ir_ref root)
{
    for (uint32_t i = s->states.len; i-- > 0;)
        if (s->states.items[i].by.root == root)
            return &s->states.items[i];
    return NULL;
}

static bool is_of_pass(const struct search *s, const struct state *state)
{
    return state == s->states.items || state >= s->states.items + s->pass;
}

/* A tree that a level left behind goes on from the next one, where another way leads to it. */
static void take_up(struct search *s, struct state *state)
{
    struct state next = *state;
    state->is_open = false;
    vec_push(s->saver.shader->arena, &s->states, next);
}

/* Limits alone do not ask for instructions. */
static bool is_useful(const struct search *s, struct slab_cost cost)
{
    return s->limits->max_error >= 0.0f || slab_cost_is_higher(s->saver.cost, cost);
}

static bool is_affordable(const struct search *s)
{
    return slabs_num_steps(s->saver.eye) < SLAB_SEARCH_STEPS;
}

/* end: of the level */
static void expand(struct search *s, uint32_t from, uint32_t end)
{
    struct slab_candidates steps = {0};
    slab_saver_set_root(&s->saver, s->states.items[from].by.root);
    slab_find_steps(&s->saver, &steps);
    for (uint32_t i = 0; i < steps.items.len && is_affordable(s); i++) {
        struct state next = {.by = steps.items.items[i], .parent = from, .is_open = true};
        struct state *known = state_of(s, next.by.root);
        bool is_there = known && is_of_pass(s, known);
        if (is_there && known->is_open && known < s->states.items + end)
            take_up(s, known);
        if (is_there)
            continue;
        next.error = known ? known->error : slab_saver_error(&s->saver, next.by.root);
        next.by.step.error = next.error;
        next.cost = slab_saver_cost(&s->saver, next.by.root);
        if (next.error >= 0.0f && is_useful(s, next.cost))
            vec_push(s->saver.shader->arena, &s->states, next);
    }
}

/* Errors decide; on the way to a limit, errors for what they saved. */
static float price_of(const struct search *s, const struct state *state)
{
    if (s->limits->max_error >= 0.0f)
        return state->error;
    uint32_t saved = s->states.items[0].cost.bytes - state->cost.bytes;
    return saved ? state->error / (float)saved : INFINITY;
}

/* The open tree with the least price from `first` on; the number of trees: there is none. */
static uint32_t next_open(const struct search *s, uint32_t first, uint32_t end)
{
    uint32_t best = end;
    for (uint32_t i = first; i < end; i++) {
        const struct state *state = &s->states.items[i];
        enum fault fault = fault_of(s, state);
        bool is_lost = fault == TOO_FAR && state->error > MARGIN * s->limits->max_error,
             is_end = fault == NONE && looks_for_error(s, fault);
        if (state->is_open && !is_lost && !is_end
            && (best == end || price_of(s, state) < price_of(s, &s->states.items[best])))
            best = i;
    }
    return best;
}

/* Searches from the tree before all steps on. off: features that blends do not make. */
static void search_levels(struct search *s, uint32_t off)
{
    int width = s->states.items[0].cost.closures > LARGE ? WIDTH_OF_LARGE : WIDTH;
    s->saver.blend.off = off;
    s->states.items[0].is_open = true;
    s->pass = s->states.len;
    for (uint32_t first = 0, end = 1; first < end;) {
        uint32_t next = s->states.len;
        for (int i = 0; i < width; i++) {
            uint32_t at = next_open(s, first, end);
            if (at == end)
                break;
            s->states.items[at].is_open = false;
            expand(s, at, end);
        }
        first = next;
        end = s->states.len;
    }
}

bool slabs_search(const struct slab_saver *saver, const struct slab_budget *limits,
                  struct slab_candidates *out)
{
    struct search s = {.saver = *saver, .limits = limits};
    struct arena *arena = saver->shader->arena;
    struct state start = {.by.root = saver->root, .cost = saver->cost, .is_open = true};
    start.error = slab_saver_error(&s.saver, saver->root);
    vec_push(arena, &s.states, start);
    uint32_t off = saver->blend.off, one_lobe = off | 1u << SLAB_SECOND_LOBE;
    search_levels(&s, off);
    if (one_lobe != off)
        search_levels(&s, one_lobe);
    uint32_t best = 0, num = 0;
    for (uint32_t i = 1; i < s.states.len; i++)
        if (is_better(&s, &s.states.items[i], &s.states.items[best]))
            best = i;
    for (uint32_t i = best; i != 0; i = s.states.items[i].parent, num++)
        vec_push(arena, &out->items, s.states.items[i].by);
    for (uint32_t i = 0; i < num / 2; i++) {
        struct slab_candidate last = out->items.items[num - 1 - i];
        out->items.items[num - 1 - i] = out->items.items[i];
        out->items.items[i] = last;
    }
    return is_affordable(&s);
}
