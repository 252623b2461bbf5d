// SPDX-License-Identifier: Apache-2.0
/*
 * Binding again. A state says where matchers match, so it holds as long as there are matchers of
 * the same names. A matcher of new names changes the primitives where it matches, and those below;
 * one that is gone changes no primitive, only the entries of states.
 */
#include "bind/scene_walk.h"

#include "base/hash.h"

#include <assert.h>
#include <stdlib.h>

/* Matchers of equal names. */
struct pair {
    uint32_t before, now;
};

struct again {
    struct state_walk *w;
    const struct bindings *before;
    VEC(struct pair) pairs; /* sorted by `before` */
    uint32_t *first_pair;   /* by matcher of `before`, and one more */
    uint32_t *states;       /* by state of `before`: STATE_UNKNOWN if it is not yet needed */
    bool has_added;
};

/* ---- Matchers ---- */

static bool is_exclusion(const struct look_matcher *m)
{
    return m->kind == MATCHER_EXCLUDE;
}

static uint32_t hash_matcher(const struct bind_look *look, const struct look_matcher *m)
{
    uint32_t hash = hash_pair(is_exclusion(m), m->list != NULL);
    if (!m->list && !m->num_prims)
        return hash;
    if (!m->list)
        return hash_pair(hash, hash_bytes(&look->matched.items[m->first_prim],
                                          m->num_prims * sizeof *look->matched.items));
    hash = hash_pair(hash, hash_bytes(m->prefix, strlen(m->prefix)));
    return hash_pair(hash, hash_bytes(m->list, strlen(m->list)));
}

/* True if two matchers of two looks match the same paths of every scene that has the primitives. */
static bool have_same_names(const struct bind_look *x, const struct look_matcher *a,
                            const struct bind_look *y, const struct look_matcher *b)
{
    if (is_exclusion(a) != is_exclusion(b) || !a->list != !b->list)
        return false;
    if (a->list)
        return strcmp(a->prefix, b->prefix) == 0 && strcmp(a->list, b->list) == 0;
    return a->num_prims == b->num_prims
           && (!a->num_prims
               || memcmp(&x->matched.items[a->first_prim], &y->matched.items[b->first_prim],
                         a->num_prims * sizeof *x->matched.items)
                      == 0);
}

/* The primitives where a matcher of new names matches are unknown. */
static void mark(struct again *a, prim_id prim)
{
    a->w->b->state_of[prim] = STATE_UNKNOWN;
}

/* A path is looked up at once; patterns need a walk. */
static void mark_matches(struct again *a, uint32_t number)
{
    const struct bind_look *look = &a->w->b->look;
    const struct look_matcher *m = &look->matchers.items[number];
    const char *list = m->list;
    struct text whole;
    prim_id instancer;
    int64_t id;
    text_init(&whole, a->w->scratch);
    for (uint32_t i = 0; i < m->num_prims; i++)
        mark(a, look->matched.items[m->first_prim + i]);
    for (struct text_word name; list && (name = look_next_name(&list)).len;) {
        whole.len = 0;
        text_str(&whole, m->prefix);
        text_put(&whole, name);
        if (scene_parse_instance(a->w->b->scene, (struct text_word){whole.data, whole.len},
                                 &instancer, &id))
            continue; /* all primitives of instances are unknown */
        if (!pattern_is_path(text_cstr(&whole), whole.len)) {
            /* a faulty one, which is reported, matches nothing */
            a->has_added |= !pattern_add(&a->w->b->added, text_cstr(&whole), whole.len, number);
            continue;
        }
        size_t len = whole.len - (whole.data[whole.len - 1] == '/');
        prim_id prim = scene_find(a->w->b->scene, whole.data, len);
        if (prim || !len)
            mark(a, prim);
    }
}

static int compare_pairs(const void *x, const void *y)
{
    const struct pair *a = x, *b = y;
    return a->before != b->before ? (a->before < b->before ? -1 : 1)
                                  : (a->now > b->now) - (a->now < b->now);
}

static void pair_matcher(struct again *a, const struct table *known, uint32_t number)
{
    const struct bind_look *look = &a->w->b->look, *old = &a->before->look;
    const struct look_matcher *m = &look->matchers.items[number];
    uint32_t hash = hash_matcher(look, m);
    for (uint32_t at = hash, found; (found = table_next(known, hash, &at));)
        if (have_same_names(look, m, old, &old->matchers.items[found - 1])) {
            vec_push(a->w->scratch, &a->pairs, (struct pair){found - 1, number});
            return;
        }
    mark_matches(a, number);
}

static void pair_matchers(struct again *a)
{
    const struct bind_look *look = &a->w->b->look, *old = &a->before->look;
    struct table known = {0};
    for (uint32_t i = 0; i < old->matchers.len; i++)
        table_add(&known, a->w->scratch, hash_matcher(old, &old->matchers.items[i]), i + 1);
    for (uint32_t i = 0; i < look->matchers.len; i++)
        pair_matcher(a, &known, i);
    if (a->pairs.len > 1)
        qsort(a->pairs.items, a->pairs.len, sizeof *a->pairs.items, compare_pairs);
    a->first_pair = ARENA_ARRAY(a->w->scratch, uint32_t, old->matchers.len + 1);
    for (uint32_t i = 0, pair = 0; i <= old->matchers.len; i++) {
        while (pair < a->pairs.len && a->pairs.items[pair].before < i)
            pair++;
        a->first_pair[i] = pair;
    }
}

/* ---- Primitives ---- */

/* Marks the uppermost primitives where the added patterns match. */
static void mark_patterns(struct again *a)
{
    const struct scene_prim *prims = a->w->b->scene->prims.items;
    struct pattern_walk walk;
    prim_id prim = 0;
    pattern_walk_init(&walk, &a->w->b->added, a->w->scratch);
    for (;;) {
        uint32_t num;
        pattern_walk_matches(&walk, prim && scene_is_leaf(a->w->b->scene, prim), &num);
        if (num)
            mark(a, prim);
        if (!num && prims[prim].first_child && pattern_walk_is_alive(&walk)) {
            prim = prims[prim].first_child;
        } else {
            for (; prim && !prims[prim].next; prim = prims[prim].parent)
                pattern_walk_up(&walk);
            if (!prim)
                return;
            pattern_walk_up(&walk);
            prim = prims[prim].next;
        }
        pattern_walk_down(&walk, prims[prim].name, prims[prim].name_len);
    }
}

/* New primitives, and those that were leaves and have now children. */
static void mark_new(struct again *a)
{
    const struct bindings *b = a->w->b;
    const struct scene_prim *prims = b->scene->prims.items;
    uint32_t num_before = a->before->num_prims;
    for (prim_id prim = num_before; prim < b->num_prims; prim++) {
        prim_id parent = prims[prim].parent;
        mark(a, prim);
        if (parent < num_before && prims[parent].first_child == prim
            && b->look.patterns.has_leaf_patterns)
            mark(a, parent);
    }
}

/* Primitives that are leaves now. */
static void mark_emptied(struct again *a)
{
    const struct scene *scene = a->w->b->scene;
    for (uint32_t i = a->before->num_emptied; i < scene->emptied.len; i++)
        if (a->w->b->look.patterns.has_leaf_patterns && scene_has(scene, scene->emptied.items[i]))
            mark(a, scene->emptied.items[i]);
}

static int compare_entries(const void *x, const void *y)
{
    const struct bind_entry *a = x, *b = y;
    return (a->matcher > b->matcher) - (a->matcher < b->matcher);
}

/* The state of now for one of before. */
static uint32_t take_state(struct again *a, uint32_t number)
{
    if (a->states[number] != STATE_UNKNOWN)
        return a->states[number];
    struct bindings *b = a->w->b;
    const struct bind_state *state = &a->before->states.items[number];
    uint32_t first = b->entries.len;
    for (uint32_t i = 0; i < state->num_entries; i++) {
        const struct bind_entry *entry = &a->before->entries.items[state->first_entry + i];
        for (uint32_t k = a->first_pair[entry->matcher]; k < a->first_pair[entry->matcher + 1]; k++)
            vec_push(b->arena, &b->entries,
                     (struct bind_entry){a->pairs.items[k].now, entry->level});
    }
    if (b->entries.len - first > 1)
        qsort(&b->entries.items[first], b->entries.len - first, sizeof *b->entries.items,
              compare_entries);
    return a->states[number] = walk_intern_state(a->w, first);
}

void walk_take_states(struct state_walk *w, const struct bindings *before)
{
    struct again a = {.w = w, .before = before};
    struct bindings *b = w->b;
    assert(before->scene == b->scene && before->num_prims <= b->num_prims);
    pattern_set_init(&b->added, w->scratch);
    pair_matchers(&a);
    if (a.has_added)
        mark_patterns(&a);
    mark_new(&a);
    mark_emptied(&a);
    for (uint32_t i = 0; i < b->scene->instances.len; i++)
        mark(&a, b->scene->instances.items[i].node);
    a.states = ARENA_ARRAY(w->scratch, uint32_t, before->states.len);
    memset(a.states, 0xff, before->states.len * sizeof *a.states);
    for (prim_id prim = 0; prim < before->num_prims; prim++)
        if (b->state_of[prim] != STATE_UNKNOWN && scene_has(b->scene, prim))
            b->state_of[prim] = take_state(&a, before->state_of[prim]);
}
