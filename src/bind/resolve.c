// SPDX-License-Identifier: Apache-2.0
/* The walk down the scene, and the states that it finds. */
#include "base/hash.h"
#include "bind/bind.h"

#include <assert.h>

/* A step from a state to the state of a primitive below. */
struct step {
    uint32_t from, level, first_match, num_matches, to;
};

struct resolver {
    struct bindings *b;
    struct arena *scratch;
    struct diag_list *diags;
    struct pattern_walk walk;
    VEC(struct step) steps; /* 0 unused */
    VEC(uint32_t) matches;  /* of the steps */
    struct table steps_table;
    struct table states_table;
    struct layer_notes notes;
    bool is_filtered; /* by --solo or --mute: names may be missing on purpose */
};

/* ---- States ---- */

/* Adds a state of the entries from `first` on, or finds an equal one and drops them. */
static uint32_t intern_state(struct resolver *r, uint32_t first)
{
    struct bindings *b = r->b;
    uint32_t num = b->entries.len - first;
    size_t size = num * sizeof *b->entries.items;
    uint32_t hash = num ? hash_bytes(&b->entries.items[first], size) : 0;
    for (uint32_t at = hash, found; (found = table_next(&r->states_table, hash, &at));) {
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
    table_add(&r->states_table, r->scratch, hash, b->states.len);
    return b->states.len - 1;
}

/* The entry of a matcher that matches now. An exclusion counts from its first match on. */
static struct bind_entry entry_of(const struct resolver *r, uint32_t matcher, uint32_t level,
                                  const struct bind_entry *before)
{
    bool is_exclusion = r->b->look.matchers.items[matcher].kind == MATCHER_EXCLUDE;
    return before && is_exclusion ? *before : (struct bind_entry){matcher, level};
}

/* The entries of a state, with the matches of one more level. */
static void merge_entries(struct resolver *r, uint32_t from, const uint32_t *matches, uint32_t num,
                          uint32_t level)
{
    struct bindings *b = r->b;
    uint32_t at = b->states.items[from].first_entry, end = at + b->states.items[from].num_entries;
    /* so that the entries do not move while they are read */
    vec_reserve(b->arena, &b->entries, end - at + num);
    for (uint32_t i = 0; i < num; i++) {
        while (at < end && b->entries.items[at].matcher < matches[i])
            vec_push(b->arena, &b->entries, b->entries.items[at++]);
        bool had = at < end && b->entries.items[at].matcher == matches[i];
        struct bind_entry entry =
            entry_of(r, matches[i], level, had ? &b->entries.items[at] : NULL);
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
static uint32_t step_to(struct resolver *r, uint32_t from, const uint32_t *matches, uint32_t num,
                        uint32_t level)
{
    uint32_t hash = hash_step(from, matches, num, level);
    for (uint32_t at = hash, found; (found = table_next(&r->steps_table, hash, &at));) {
        const struct step *step = &r->steps.items[found];
        if (step->from == from && step->level == level && step->num_matches == num
            && memcmp(&r->matches.items[step->first_match], matches, num * sizeof *matches) == 0)
            return step->to;
    }
    struct step step = {from, level, r->matches.len, num, 0};
    uint32_t first = r->b->entries.len;
    merge_entries(r, from, matches, num, level);
    step.to = intern_state(r, first);
    for (uint32_t i = 0; i < num; i++)
        vec_push(r->scratch, &r->matches, matches[i]);
    vec_push(r->scratch, &r->steps, step);
    table_add(&r->steps_table, r->scratch, hash, r->steps.len - 1);
    return step.to;
}

/* ---- The walk ---- */

static void enter(struct resolver *r, prim_id prim, uint32_t from, uint32_t level)
{
    const struct scene_prim *p = &r->b->scene->prims.items[prim];
    uint32_t num;
    const uint32_t *matches = pattern_walk_matches(&r->walk, prim && !p->first_child, &num);
    uint32_t state = num ? step_to(r, from, matches, num, level) : from;
    r->b->state_of[prim] = state;
    if (!r->b->states.items[state].first_prim)
        r->b->states.items[state].first_prim = prim;
}

static void walk_scene(struct resolver *r)
{
    const struct scene *scene = r->b->scene;
    const struct scene_prim *prims = scene->prims.items;
    uint32_t level = 1;
    enter(r, 0, intern_state(r, 0), level);
    for (prim_id prim = prims[0].first_child; prim;) {
        pattern_walk_down(&r->walk, prims[prim].name, prims[prim].name_len);
        enter(r, prim, r->b->state_of[prims[prim].parent], ++level);
        if (prims[prim].first_child) {
            prim = prims[prim].first_child;
            continue;
        }
        for (; prim && !prims[prim].next; prim = prims[prim].parent, level--)
            pattern_walk_up(&r->walk);
        if (!prim)
            return;
        pattern_walk_up(&r->walk);
        level--;
        prim = prims[prim].next;
    }
}

static void find_states(struct resolver *r)
{
    struct bindings *b = r->b;
    b->state_of = ARENA_ARRAY(b->arena, uint32_t, b->scene->prims.len);
    vec_push(r->scratch, &r->steps, (struct step){0});
    pattern_walk_init(&r->walk, &b->look.patterns, r->scratch);
    walk_scene(r);
}

void bind_find_states(struct bindings *b, struct arena *scratch)
{
    struct resolver r = {.b = b, .scratch = scratch};
    find_states(&r);
}

/* ---- Solo and mute ---- */

static bool is_part_of(const struct look_name *name, const struct slot_name *whole)
{
    for (unsigned part = 0; part < NUM_SLOT_PARTS; part++) {
        struct text_word a = name->name.parts[part], b = whole->parts[part];
        if (b.len && (a.len != b.len || memcmp(a.bytes, b.bytes, a.len) != 0))
            return false;
    }
    return true;
}

/* True if a name is `whole`, hangs on it, or carries it. */
static bool belongs(const struct look_name *name, const struct slot_name *whole)
{
    for (unsigned part = 0; part < NUM_SLOT_PARTS; part++) {
        struct text_word a = name->name.parts[part], b = whole->parts[part];
        if (a.len && b.len && (a.len != b.len || memcmp(a.bytes, b.bytes, a.len) != 0))
            return false;
    }
    /* an override of the slot itself carries no vertical layer, and the other way round */
    bool name_hangs = is_part_of(name, whole);
    struct look_name other = {.name = *whole};
    return name_hangs || is_part_of(&other, &name->name);
}

static void report_unknown_slot(struct resolver *r, const char *text)
{
    struct diag_guess guess;
    const char *near = "";
    if (diag_guess_begin(&guess, r->diags, text)) {
        for (uint32_t i = 0; i < r->b->look.names.len; i++)
            diag_guess_add(&guess, r->b->look.names.items[i].text);
        near = diag_guess_text(&guess);
    }
    diag_add(
        r->diags, DIAG_ID_unknown_slot,
        doc_place(r->b->look.doc, r->b->look.element ? r->b->look.element : r->b->look.doc->root),
        text, near);
}

/* Reads a name of the options; false after an error. */
static bool read_name(struct resolver *r, const char *text, struct slot_name *out)
{
    struct diag_place nowhere = {0};
    const char *fault = slot_parse(text, strlen(text), out);
    if (fault) {
        diag_add(r->diags, DIAG_ID_bad_slot, nowhere, text, fault);
        return false;
    }
    bool found = false;
    for (uint32_t i = 0; i < r->b->look.names.len; i++)
        found |= is_part_of(&r->b->look.names.items[i], out);
    if (!found)
        report_unknown_slot(r, text);
    return found;
}

static void mute_names(struct resolver *r, const struct bind_options *options)
{
    struct slot_name name;
    struct look_name *names = r->b->look.names.items;
    uint32_t num = r->b->look.names.len;
    r->is_filtered = options->num_solo || options->num_mute;
    for (uint32_t i = 0; i < num; i++)
        names[i].is_muted = options->num_solo != 0;
    for (size_t k = 0; k < options->num_solo; k++)
        if (read_name(r, options->solo[k], &name))
            for (uint32_t i = 0; i < num; i++)
                names[i].is_muted &= !belongs(&names[i], &name);
    for (size_t k = 0; k < options->num_mute; k++)
        if (read_name(r, options->mute[k], &name))
            for (uint32_t i = 0; i < num; i++)
                names[i].is_muted |= is_part_of(&names[i], &name);
}

/* ---- Warnings, once per name or assignment ---- */

static const char *path_text(const struct resolver *r, prim_id prim)
{
    struct text path;
    text_init(&path, r->scratch);
    scene_path(r->b->scene, prim, &path);
    return text_cstr(&path);
}

static void warn_assign(struct resolver *r, const struct look_assign *a, bool *is_told)
{
    const struct bind_look *look = &r->b->look;
    const struct look_name *name = &look->names.items[a->name];
    struct diag_place place = look_slot_place(look, a);
    struct text owner;
    text_init(&owner, r->scratch);
    if (!a->target)
        return;
    struct slot_name over = name->name;
    over.parts[SLOT_OVERRIDE].len = 0;
    slot_write(&over, &owner);
    if (name->name.parts[SLOT_OVERRIDE].len && !r->notes.has_layer[name->layer])
        diag_add(r->diags, DIAG_ID_override_unused, place, name->text, text_cstr(&owner));
    uint32_t asleep = r->notes.sleeps_at[a->name];
    if (!name->name.parts[SLOT_VERTICAL].len || name->name.parts[SLOT_OVERRIDE].len || !asleep
        || is_told[a->name])
        return;
    is_told[a->name] = true;
    over.parts[SLOT_VERTICAL].len = 0;
    owner.len = 0;
    slot_write(&over, &owner);
    diag_add(r->diags, DIAG_ID_vertical_asleep, place, name->text,
             path_text(r, r->b->states.items[asleep - 1].first_prim), text_cstr(&owner));
}

static void warn(struct resolver *r)
{
    const struct bind_look *look = &r->b->look;
    bool *is_told = ARENA_ARRAY(r->scratch, bool, look->names.len);
    for (uint32_t i = 0; i < look->assigns.len && !r->is_filtered; i++)
        warn_assign(r, &look->assigns.items[i], is_told);
}

/* ---- The whole ---- */

static void make_layers(struct resolver *r)
{
    struct bindings *b = r->b;
    struct stands stands = {.scratch = r->scratch};
    r->notes.sleeps_at = ARENA_ARRAY(r->scratch, uint32_t, b->look.names.len);
    r->notes.has_layer = ARENA_ARRAY(r->scratch, bool, b->look.names.len);
    for (uint32_t i = 0; i < b->states.len; i++)
        if (b->states.items[i].first_prim)
            bind_layers(b, i, &stands, &r->notes);
    for (prim_id prim = 1; prim < b->scene->prims.len; prim++)
        b->stacks.items[bind_state_of(b, prim)->stack].num_prims++;
}

void bind_resolve(struct bindings *b, const struct document *doc, elem_id look,
                  const struct scene *scene, const struct bind_options *options,
                  struct arena *arena, struct arena *scratch, struct diag_list *diags)
{
    *b = (struct bindings){.arena = arena, .scene = scene};
    struct resolver r = {.b = b, .scratch = scratch, .diags = diags};
    look_read(&b->look, doc, look, scene, arena, diags);
    mute_names(&r, options);
    find_states(&r);
    make_layers(&r);
    warn(&r);
}

void bindings_finish(struct bindings *b)
{
    look_finish(&b->look);
}

prim_id bind_prim_at(const struct bindings *b, prim_id prim, uint32_t level)
{
    uint32_t depth = scene_depth(b->scene, prim);
    assert(level > 0 && level <= depth + 1);
    for (; depth >= level; depth--)
        prim = b->scene->prims.items[prim].parent;
    return prim;
}
