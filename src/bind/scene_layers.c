// SPDX-License-Identifier: Apache-2.0
/* A look on a scene: the layers of all primitives, and warnings about them. */
#include "bind/bind.h"

#include <assert.h>

struct resolver {
    struct bindings *b;
    struct arena *scratch;
    struct diag_list *diags;
    struct layer_notes notes;
    bool is_filtered; /* by --solo or --mute: names may be missing on purpose */
};

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
    enum { MAX_LISTED = 50 };
    struct diag_guess guess;
    const char *near = "";
    struct text list;
    text_init(&list, r->diags->arena);
    for (uint32_t i = 0; i < r->b->look.names.len && i < MAX_LISTED; i++)
        text_fmt(&list, "%s%s", i ? ", " : "", r->b->look.names.items[i].text);
    text_str(&list, r->b->look.names.len > MAX_LISTED ? ", ..." : "");
    if (diag_guess_begin(&guess, r->diags, text)) {
        for (uint32_t i = 0; i < r->b->look.names.len; i++)
            diag_guess_add(&guess, r->b->look.names.items[i].text);
        near = diag_guess_text(&guess);
    }
    diag_add(
        r->diags, DIAG_ID_unknown_slot,
        doc_place(r->b->look.doc, r->b->look.element ? r->b->look.element : r->b->look.doc->root),
        text, near, list.len ? text_cstr(&list) : "none");
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

/* The primitives of a state: those that are drawn, and groups. */
struct tally {
    uint32_t num[2];
};

/* States by the first primitive that has them, which is any, drawn, or a group. */
struct met_states {
    VEC(uint32_t) all, by_kind[2];
};

static void count_primitives(struct resolver *r, struct tally *tallies, struct met_states *met)
{
    struct bindings *b = r->b;
    const uint8_t *kinds = b->scene->kinds.items;
    for (prim_id prim = 1; prim < b->num_prims; prim++) {
        unsigned kind = kinds[prim];
        if (kind == PRIM_GONE)
            continue;
        uint32_t number = b->state_of[prim];
        struct tally *tally = &tallies[number];
        if (!tally->num[PRIM_DRAWN] && !tally->num[PRIM_GROUP]) {
            b->states.items[number].first_prim = prim;
            vec_push(r->scratch, &met->all, number);
        }
        if (!tally->num[kind]++)
            vec_push(r->scratch, &met->by_kind[kind], number);
    }
}

static void add_to_stack(struct resolver *r, uint32_t number, bool is_drawn, uint32_t num)
{
    struct bindings *b = r->b;
    struct bind_state *state = &b->states.items[number];
    if (state->stack == STACK_NONE)
        bind_stack(b, number, is_drawn);
    if (state->stack != STACK_NONE)
        b->stacks.items[state->stack].num_prims += num;
}

/*
 * The layers of each state that a primitive has, and the stacks. The order of the primitives
 * decides that of the stacks, whatever the order of the states is. The primitives that are drawn
 * make the stacks that there are; groups may share them.
 */
static void make_layers(struct resolver *r)
{
    struct bindings *b = r->b;
    struct stands stands = {.scratch = r->scratch};
    struct met_states met = {0};
    struct tally *tallies = ARENA_ARRAY(r->scratch, struct tally, b->states.len);
    r->notes.sleeps_at = ARENA_ARRAY(r->scratch, uint32_t, b->look.names.len);
    r->notes.has_layer = ARENA_ARRAY(r->scratch, bool, b->look.names.len);
    count_primitives(r, tallies, &met);
    for (uint32_t i = 0; i < met.all.len; i++)
        bind_layers(b, met.all.items[i], &stands, &r->notes);
    for (unsigned kind = PRIM_DRAWN; kind <= PRIM_GROUP; kind++)
        for (uint32_t i = 0; i < met.by_kind[kind].len; i++) {
            uint32_t number = met.by_kind[kind].items[i];
            add_to_stack(r, number, kind == PRIM_DRAWN, tallies[number].num[kind]);
        }
}

void bind_resolve(struct bindings *b, const struct library *lib, elem_id look,
                  const struct scene *scene, const struct bindings *before,
                  const struct bind_options *options, struct arena *arena, struct arena *scratch,
                  struct diag_list *diags)
{
    *b = (struct bindings){.arena = arena, .scene = scene};
    struct resolver r = {.b = b, .scratch = scratch, .diags = diags};
    look_read(&b->look, lib, look, scene, arena, diags);
    mute_names(&r, options);
    bind_find_states(b, before, scratch);
    make_layers(&r);
    warn(&r);
    bind_warn_unmatched(b, scratch, diags);
}

void bindings_finish(struct bindings *b)
{
    look_finish(&b->look);
    pattern_set_finish(&b->added);
}

prim_id bind_prim_at(const struct bindings *b, prim_id prim, uint32_t level)
{
    uint32_t depth = scene_depth(b->scene, prim);
    assert(level > 0 && level <= depth + 1);
    for (; depth >= level; depth--)
        prim = b->scene->prims.items[prim].parent;
    return prim;
}
