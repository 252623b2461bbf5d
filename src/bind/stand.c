// SPDX-License-Identifier: Apache-2.0
/* Which assignments stand where, and which of a name is the strongest. */
#include "bind/bind.h"

#include "base/num.h"

#include <assert.h>
#include <stdlib.h>

/* ---- Levels ---- */

/* The level where a matcher matched last; 0: nowhere. */
static uint32_t level_of(const struct bindings *b, const struct bind_state *state, uint32_t matcher)
{
    const struct bind_entry *entries = &b->entries.items[state->first_entry];
    uint32_t low = 0, high = state->num_entries;
    while (low < high) {
        uint32_t middle = (low + high) / 2;
        if (entries[middle].matcher < matcher)
            low = middle + 1;
        else
            high = middle;
    }
    return low < state->num_entries && entries[low].matcher == matcher ? entries[low].level : 0;
}

/*
 * Membership in a collection of USD is what the deepest of its paths says, and an exclusion beats
 * an inclusion of the same path (UsdCollectionMembershipQuery). The binding stands at its own prim.
 */
static bool has_members(const struct bindings *b, const struct bind_state *state, uint32_t assign)
{
    const struct look_members *members =
        &b->look.members.items[b->look.assigns.items[assign].members - 1];
    return level_of(b, state, members->include) > level_of(b, state, members->exclude);
}

/* ---- Collections ---- */

static void reach(struct stands *work, uint32_t collection)
{
    if (!work->is_reached[collection])
        vec_push(work->scratch, &work->reached, collection);
    work->is_reached[collection] = true;
}

/* Lists the collections that may hold the state, sorted: nested ones stand before their users. */
static void reach_collections(const struct bindings *b, const struct bind_state *state,
                              struct stands *work)
{
    const struct bind_look *look = &b->look;
    const struct look_lists *users = &look->users;
    const struct bind_entry *entries = &b->entries.items[state->first_entry];
    if (!work->levels) {
        work->levels = ARENA_ARRAY(work->scratch, uint32_t, look->collections.len);
        work->is_reached = ARENA_ARRAY(work->scratch, bool, look->collections.len);
    }
    work->reached.len = 0;
    for (uint32_t i = 0; i < state->num_entries; i++) {
        const struct look_matcher *matcher = &look->matchers.items[entries[i].matcher];
        if (matcher->kind == MATCHER_INCLUDE)
            reach(work, matcher->owner);
    }
    for (uint32_t i = 0; i < work->reached.len; i++) {
        uint32_t nested = work->reached.items[i];
        for (uint32_t k = users->first[nested]; k < users->first[nested + 1]; k++)
            reach(work, users->items[k]);
    }
    num_sort(work->reached.items, work->reached.len);
}

/* The level of a collection, from its own geometry and from the level of those that it includes. */
static uint32_t level_of_collection(const struct bindings *b, const struct bind_state *state,
                                    uint32_t number, uint32_t nested_level)
{
    const struct look_collection *c = &b->look.collections.items[number];
    if (c->exclude && level_of(b, state, c->exclude - 1))
        return 0;
    uint32_t own = c->include ? level_of(b, state, c->include - 1) : 0;
    return own > nested_level ? own : nested_level;
}

static void add_stand(const struct bindings *b, struct stands *out, uint32_t assign, uint32_t level)
{
    vec_push(out->scratch, out, (struct stand){b->look.assigns.items[assign].name, level, assign});
}

/* Adds the assignments of collections. `levels` is zero before and after. */
static void add_collections(const struct bindings *b, const struct bind_state *state,
                            struct stands *out)
{
    const struct look_lists *users = &b->look.users, *assigned = &b->look.assigned;
    reach_collections(b, state, out);
    for (uint32_t i = 0; i < out->reached.len; i++) {
        uint32_t number = out->reached.items[i],
                 level = level_of_collection(b, state, number, out->levels[number]);
        for (uint32_t k = users->first[number]; k < users->first[number + 1]; k++)
            if (out->levels[users->items[k]] < level)
                out->levels[users->items[k]] = level;
        for (uint32_t k = assigned->first[number]; level && k < assigned->first[number + 1]; k++)
            add_stand(b, out, assigned->items[k], level);
        out->levels[number] = 0;
        out->is_reached[number] = false;
    }
}

/* ---- Strength ---- */

static int compare_stands(const void *a, const void *b)
{
    const struct stand *x = a, *y = b;
    if (x->name != y->name)
        return x->name < y->name ? -1 : 1;
    if (x->level != y->level)
        return x->level > y->level ? -1 : 1;
    return x->assign > y->assign ? -1 : x->assign < y->assign;
}

/* True if `a` steps back behind `b` at one path: its collection includes that of `b`. */
static bool steps_back(const struct bind_look *look, const struct stand *a, const struct stand *b)
{
    uint32_t outer = look->assigns.items[a->assign].collection,
             inner = look->assigns.items[b->assign].collection;
    return outer && inner && look_contains(look, outer, inner);
}

/* True if the collection of a stand contains others: only then it steps back. */
static bool may_step_back(const struct bind_look *look, const struct stand *stand)
{
    uint32_t collection = look->assigns.items[stand->assign].collection;
    return collection && look->rows[collection - 1];
}

/*
 * Counts for each stand behind how many others it steps back, and keeps the stands in `rest`. The
 * number of those that step back at all.
 */
static uint32_t count_behind(const struct bind_look *look, const struct stand *stands, uint32_t num,
                             struct stands *work)
{
    uint32_t num_back = 0;
    work->rest.len = work->behind.len = 0;
    for (uint32_t i = 0; i < num; i++) {
        uint32_t behind = 0;
        for (uint32_t k = 0; k < num && may_step_back(look, &stands[i]); k++)
            behind += steps_back(look, &stands[i], &stands[k]);
        num_back += behind != 0;
        vec_push(work->scratch, &work->rest, stands[i]);
        vec_push(work->scratch, &work->behind, behind);
    }
    return num_back;
}

/*
 * Sorts the stands of one name at one path, which are sorted by look and place in the file: again
 * and again the first of those that step back behind none of the rest.
 */
static void sort_by_collections(const struct bind_look *look, struct stand *stands, uint32_t num,
                                struct stands *work)
{
    enum { PLACED = UINT32_MAX / 2 };
    uint32_t first = 0;
    if (!count_behind(look, stands, num, work))
        return;
    for (uint32_t placed = 0; placed < num; placed++) {
        while (work->behind.items[first] == PLACED)
            first++;
        uint32_t best = first;
        while (work->behind.items[best])
            best++;
        assert(best < num); /* inclusion has no cycle */
        stands[placed] = work->rest.items[best];
        for (uint32_t i = first; i < num; i++)
            if (work->behind.items[i] && work->behind.items[i] < PLACED)
                work->behind.items[i] -=
                    steps_back(look, &work->rest.items[i], &work->rest.items[best]);
        work->behind.items[best] = PLACED;
    }
}

/* ---- Bindings of the scene ---- */

static const struct scene_binding *binding_of(const struct bind_look *look, const struct stand *s)
{
    uint32_t binding = look->assigns.items[s->assign].binding;
    return binding ? &look->scene->bindings.items[binding - 1] : NULL;
}

/* True if `a` beats `b` by UsdShade's rules: purpose, then strength from above, then depth. */
static bool beats(const struct scene_binding *a, const struct stand *x,
                  const struct scene_binding *b, const struct stand *y)
{
    if (a->is_purpose != b->is_purpose)
        return a->is_purpose;
    if (x->level == y->level)
        return x->assign > y->assign;
    /* the upper one if it is strong, else the deeper one */
    bool is_above = x->level < y->level;
    return is_above == (is_above ? a : b)->is_strong;
}

/* Moves the strongest of the scene's bindings from `from` on to `from`. */
static void select_binding(const struct bind_look *look, struct stand *list, uint32_t from,
                           uint32_t num)
{
    uint32_t best = from;
    for (uint32_t i = from + 1; i < num; i++)
        if (beats(binding_of(look, &list[i]), &list[i], binding_of(look, &list[best]), &list[best]))
            best = i;
    struct stand strongest = list[best];
    memmove(&list[from + 1], &list[from], (best - from) * sizeof *list);
    list[from] = strongest;
}

/*
 * Sorts the stands of one name again, if the scene's own bindings follow other rules among
 * themselves than depth. A binding that another one of the scene beats from above is not stronger
 * than a look's at the level of that one.
 */
static void sort_by_scene(const struct bind_look *look, struct stand *stands, uint32_t num,
                          struct stands *work)
{
    uint32_t num_look = 0, num_scene = 0;
    work->rest.len = 0;
    vec_reserve(work->scratch, &work->rest, num);
    for (uint32_t i = 0; i < num; i++)
        if (!binding_of(look, &stands[i]))
            work->rest.items[num_look++] = stands[i];
    struct stand *scene = work->rest.items + num_look;
    for (uint32_t i = 0; i < num; i++)
        if (binding_of(look, &stands[i]))
            scene[num_scene++] = stands[i];
    assert(num_look + num_scene == num);
    uint32_t level = UINT32_MAX, next_look = 0;
    for (uint32_t i = 0; i < num_scene; i++) {
        select_binding(look, scene, i, num_scene);
        level = scene[i].level < level ? scene[i].level : level;
        while (next_look < num_look && work->rest.items[next_look].level >= level)
            *stands++ = work->rest.items[next_look++];
        *stands++ = scene[i];
    }
    while (next_look < num_look)
        *stands++ = work->rest.items[next_look++];
}

/* True if a binding of the scene is not ranked by depth alone. */
static bool has_own_rules(const struct bind_look *look, const struct stand *stands, uint32_t num)
{
    for (uint32_t i = 0; i < num; i++) {
        const struct scene_binding *binding = binding_of(look, &stands[i]);
        if (binding && (binding->is_strong || binding->is_purpose))
            return true;
    }
    return false;
}

static void sort_names_by_scene(const struct bind_look *look, struct stands *stands)
{
    for (uint32_t i = 0, end; i < stands->len; i = end) {
        for (end = i; end < stands->len && stands->items[end].name == stands->items[i].name; end++)
            continue;
        if (has_own_rules(look, &stands->items[i], end - i))
            sort_by_scene(look, &stands->items[i], end - i, stands);
    }
}

static void sort_stands(const struct bind_look *look, struct stands *stands)
{
    if (stands->len > 1)
        qsort(stands->items, stands->len, sizeof *stands->items, compare_stands);
    for (uint32_t i = 0, end; i < stands->len; i = end) {
        uint32_t num_collections = 0;
        const struct stand *first = &stands->items[i];
        for (end = i; end < stands->len && stands->items[end].name == first->name
                      && stands->items[end].level == first->level;
             end++)
            num_collections += look->assigns.items[stands->items[end].assign].collection != 0;
        if (num_collections > 1)
            sort_by_collections(look, &stands->items[i], end - i, stands);
    }
    if (look->scene->num_bindings)
        sort_names_by_scene(look, stands);
}

void bind_stands(const struct bindings *b, const struct bind_state *state, struct stands *out)
{
    const struct bind_look *look = &b->look;
    const struct bind_entry *entries = &b->entries.items[state->first_entry];
    out->len = 0;
    for (uint32_t i = 0; i < state->num_entries; i++) {
        const struct look_matcher *matcher = &look->matchers.items[entries[i].matcher];
        if (matcher->kind == MATCHER_ASSIGN
            || (matcher->kind == MATCHER_BOUND && has_members(b, state, matcher->owner)))
            add_stand(b, out, matcher->owner, entries[i].level);
    }
    if (look->collections.len)
        add_collections(b, state, out);
    sort_stands(look, out);
}

bool bind_is_excluded(const struct bindings *b, const struct bind_state *state, uint32_t collection)
{
    const struct look_collection *c = &b->look.collections.items[collection - 1];
    return c->exclude && level_of(b, state, c->exclude - 1);
}
