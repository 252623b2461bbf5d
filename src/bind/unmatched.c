// SPDX-License-Identifier: Apache-2.0
/* Geometry names that match no primitive: the commonest mistake of an assignment. */
#include "bind/bind.h"

struct unmatched {
    const struct bindings *b;
    struct arena *scratch;
    struct diag_list *diags;
    bool *has_match; /* by matcher */
};

/* The matchers that match a primitive. */
static void find_matches(struct unmatched *u)
{
    const struct bindings *b = u->b;
    u->has_match = ARENA_ARRAY(u->scratch, bool, b->look.matchers.len);
    for (uint32_t i = 0; i < b->states.len; i++) {
        const struct bind_state *state = &b->states.items[i];
        for (uint32_t k = 0; state->first_prim && k < state->num_entries; k++)
            u->has_match[b->entries.items[state->first_entry + k].matcher] = true;
    }
}

/*
 * Suggests a path with one level in the place of a misspelled one: `path` exists up to `parent`,
 * whose children are looked at.
 */
static const char *suggest(struct unmatched *u, const char *path, prim_id parent, size_t len)
{
    enum { MAX_CANDIDATES = 1000 };
    const struct scene_prim *prims = u->b->scene->prims.items;
    const char *rest = path + len + 1;
    struct diag_guess guess;
    rest += strcspn(rest, "/");
    if (!diag_guess_begin(&guess, u->diags, path))
        return "";
    prim_id child = prims[parent].first_child;
    for (unsigned i = 0; child && i < MAX_CANDIDATES; child = prims[child].next, i++) {
        struct text candidate;
        text_init(&candidate, u->diags->arena);
        scene_path(u->b->scene, child, &candidate);
        if (!glob_is_plain(rest, strlen(rest))
            || scene_find_below(u->b->scene, child, rest, strlen(rest)))
            text_str(&candidate, rest);
        diag_guess_add(&guess, text_cstr(&candidate));
    }
    return diag_guess_text(&guess);
}

/* The suggestion for a name: for its first level that no primitive has. */
static const char *near(struct unmatched *u, const char *path)
{
    const struct scene *scene = u->b->scene;
    prim_id parent = 0;
    size_t len = 0;
    while (path[len] == '/' && path[len + 1] && path[len + 1] != '/') {
        size_t level = strcspn(path + len + 1, "/");
        prim_id child = scene_find_child(scene, parent, path + len + 1, level);
        if (!glob_is_plain(path + len + 1, level))
            return "";
        if (!child)
            return suggest(u, path, parent, len);
        parent = child;
        len += 1 + level;
    }
    return "";
}

/* True if a name matches, as far as the matcher of its whole list, or its path, tells. */
static bool is_matched(const struct unmatched *u, uint32_t matcher, struct text_word name)
{
    while (name.len && name.bytes[name.len - 1] == '/')
        name.len--;
    if (!name.len || !pattern_is_path(name.bytes, name.len))
        return !name.len || u->has_match[matcher];
    return scene_find(u->b->scene, name.bytes, name.len) != 0;
}

static void check_matcher(struct unmatched *u, uint32_t number)
{
    const struct bind_look *look = &u->b->look;
    const struct look_matcher *matcher = &look->matchers.items[number];
    bool is_assign = matcher->kind == MATCHER_ASSIGN;
    if (!matcher->list || matcher->has_fault
        || matcher->owner >= (is_assign ? look->assigns.len : look->collections.len))
        return;
    elem_id element = is_assign ? look->assigns.items[matcher->owner].element
                                : look->collections.items[matcher->owner].element;
    str_id attr = is_assign                          ? STR_geom
                  : matcher->kind == MATCHER_INCLUDE ? STR_includegeom
                                                     : STR_excludegeom;
    const char *list = matcher->list;
    for (struct text_word name; (name = look_next_name(&list)).len;) {
        struct text whole;
        text_init(&whole, u->diags->arena);
        text_str(&whole, matcher->prefix);
        if (!*matcher->prefix && *name.bytes != '/')
            text_char(&whole, '/');
        text_put(&whole, name);
        const char *path = text_cstr(&whole);
        if (!is_matched(u, number, (struct text_word){path, whole.len}))
            diag_add(u->diags, DIAG_ID_pattern_unmatched, doc_attr_place(look->doc, element, attr),
                     path, near(u, path));
    }
}

void bind_warn_unmatched(const struct bindings *b, struct arena *scratch, struct diag_list *diags)
{
    struct unmatched u = {.b = b, .scratch = scratch, .diags = diags};
    if (!b->scene->prims.items[0].first_child || !diag_is_shown(diags, DIAG_ID_pattern_unmatched))
        return;
    find_matches(&u);
    for (uint32_t i = 0; i < b->look.matchers.len; i++)
        check_matcher(&u, i);
}
