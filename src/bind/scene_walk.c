// SPDX-License-Identifier: Apache-2.0
/* The walk down the scene, and the states that it finds. */
#include "bind/scene_walk.h"

#include "base/hash.h"

#include <assert.h>

/* ---- States ---- */

uint32_t walk_intern_state(struct state_walk *w, uint32_t first)
{
    struct bindings *b = w->b;
    uint32_t num = b->entries.len - first;
    size_t size = num * sizeof *b->entries.items;
    uint32_t hash = num ? hash_bytes(&b->entries.items[first], size) : 0;
    for (uint32_t at = hash, found; (found = table_next(&w->states_table, hash, &at));) {
        const struct bind_state *state = &b->states.items[found - 1];
        if (state->num_entries == num
            && (!num
                || memcmp(&b->entries.items[state->first_entry], &b->entries.items[first], size)
                       == 0)) {
            b->entries.len = first;
            return found - 1;
        }
    }
    vec_push(b->arena, &b->states, (struct bind_state){.first_entry = first, .num_entries = num});
    table_add(&w->states_table, w->scratch, hash, b->states.len);
    return b->states.len - 1;
}

/* The entry of a matcher that matches now. */
static struct bind_entry entry_of(const struct state_walk *w, uint32_t matcher, uint32_t level,
                                  const struct bind_entry *before)
{
    bool is_exclusion = w->b->look.matchers.items[matcher].kind == MATCHER_EXCLUDE;
    return before && is_exclusion ? *before : (struct bind_entry){matcher, level};
}

/* The entries of a state, with the matches of one more level. */
static void merge_entries(struct state_walk *w, uint32_t from, const uint32_t *matches,
                          uint32_t num, uint32_t level)
{
    struct bindings *b = w->b;
    uint32_t at = b->states.items[from].first_entry, end = at + b->states.items[from].num_entries;
    /* so that the entries do not move while they are read */
    vec_reserve(b->arena, &b->entries, end - at + num);
    for (uint32_t i = 0; i < num; i++) {
        while (at < end && b->entries.items[at].matcher < matches[i])
            vec_push(b->arena, &b->entries, b->entries.items[at++]);
        bool had = at < end && b->entries.items[at].matcher == matches[i];
        struct bind_entry entry =
            entry_of(w, matches[i], level, had ? &b->entries.items[at] : NULL);
        vec_push(b->arena, &b->entries, entry);
        at += had;
    }
    while (at < end)
        vec_push(b->arena, &b->entries, b->entries.items[at++]);
}

static uint32_t hash_step(uint32_t from, const uint32_t *matches, uint32_t num, uint32_t level)
{
    return hash_pair(hash_pair(from, level), hash_bytes(matches, num * sizeof *matches));
}

/* The state of a primitive with these matches, below a primitive of the state `from`. */
static uint32_t step_to(struct state_walk *w, uint32_t from, const uint32_t *matches, uint32_t num,
                        uint32_t level)
{
    uint32_t hash = hash_step(from, matches, num, level);
    for (uint32_t at = hash, found; (found = table_next(&w->steps_table, hash, &at));) {
        const struct state_step *step = &w->steps.items[found];
        if (step->from == from && step->level == level && step->num_matches == num
            && memcmp(&w->matches.items[step->first_match], matches, num * sizeof *matches) == 0)
            return step->to;
    }
    struct state_step step = {from, level, w->matches.len, num, 0};
    uint32_t first = w->b->entries.len;
    merge_entries(w, from, matches, num, level);
    step.to = walk_intern_state(w, first);
    for (uint32_t i = 0; i < num; i++)
        vec_push(w->scratch, &w->matches, matches[i]);
    vec_push(w->scratch, &w->steps, step);
    table_add(&w->steps_table, w->scratch, hash, w->steps.len - 1);
    return step.to;
}

/* ---- The walk ---- */

static void go_down(struct state_walk *w, prim_id prim)
{
    const struct scene_prim *p = &w->b->scene->prims.items[prim];
    pattern_walk_down(&w->patterns, p->name, p->name_len);
    vec_push(w->scratch, &w->path, prim);
}

static void go_up(struct state_walk *w)
{
    pattern_walk_up(&w->patterns);
    (void)vec_pop(&w->path);
}

/* Goes to a primitive from any other one, over the last one above both. */
static void go_to(struct state_walk *w, prim_id prim)
{
    const struct scene_prim *prims = w->b->scene->prims.items;
    VEC(prim_id) down = {0};
    uint32_t depth = scene_depth(w->b->scene, prim);
    while (w->path.len > depth)
        go_up(w);
    for (; depth > w->path.len; depth--, prim = prims[prim].parent)
        vec_push(w->scratch, &down, prim);
    for (; w->path.len && vec_last(&w->path) != prim; prim = prims[prim].parent) {
        vec_push(w->scratch, &down, prim);
        go_up(w);
    }
    while (down.len)
        go_down(w, vec_pop(&down));
}

/* The matchers that name an instance; patterns match its prototype alone. */
static const uint32_t *instance_matches(struct state_walk *w, prim_id prim, uint32_t *out_num)
{
    uint32_t num;
    const struct look_instance *named = look_instances_of(&w->b->look, prim, &num);
    w->named.len = 0;
    for (uint32_t i = 0; i < num; i++)
        if (!i || named[i].matcher != named[i - 1].matcher)
            vec_push(w->scratch, &w->named, named[i].matcher);
    *out_num = w->named.len;
    return w->named.items;
}

/* Finds the state of the primitive where the walk is, from that of the one above. */
static void find_state(struct state_walk *w, prim_id prim)
{
    const struct scene *scene = w->b->scene;
    uint32_t num, from = prim ? w->b->state_of[scene->prims.items[prim].parent]
                              : walk_intern_state(w, w->b->entries.len);
    const uint32_t *matches =
        scene_is_instance(scene, prim)
            ? instance_matches(w, prim, &num)
            : pattern_walk_matches(&w->patterns, prim && scene_is_leaf(scene, prim), &num);
    assert(from != STATE_UNKNOWN);
    w->b->state_of[prim] = num ? step_to(w, from, matches, num, w->path.len + 1) : from;
    w->b->num_resolved += prim != 0;
}

/* Finds the states of a primitive and all below it. */
static void find_below(struct state_walk *w, prim_id top)
{
    const struct scene_prim *prims = w->b->scene->prims.items;
    go_to(w, top);
    find_state(w, top);
    for (prim_id prim = prims[top].first_child; prim;) {
        go_down(w, prim);
        find_state(w, prim);
        if (prims[prim].first_child) {
            prim = prims[prim].first_child;
            continue;
        }
        for (; prim != top && !prims[prim].next; prim = prims[prim].parent)
            go_up(w);
        if (prim == top)
            return;
        go_up(w);
        prim = prims[prim].next;
    }
}

void bind_find_states(struct bindings *b, const struct bindings *before, struct arena *scratch)
{
    struct state_walk w = {.b = b, .scratch = scratch};
    b->num_prims = b->scene->prims.len;
    b->num_emptied = b->scene->emptied.len;
    b->state_of = ARENA_ARRAY(b->arena, uint32_t, b->num_prims);
    vec_push(scratch, &w.steps, (struct state_step){0});
    pattern_walk_init(&w.patterns, &b->look.patterns, scratch);
    look_sort_instances(&b->look);
    if (before)
        walk_take_states(&w, before);
    else
        find_below(&w, 0);
    /* a primitive stands behind the one above it, whose walk finds both */
    for (prim_id prim = 0; prim < b->num_prims; prim++)
        if (b->state_of[prim] == STATE_UNKNOWN && scene_has(b->scene, prim))
            find_below(&w, prim);
}
