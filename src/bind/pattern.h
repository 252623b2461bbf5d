// SPDX-License-Identifier: Apache-2.0
/*
 * Geometry expressions: paths of globs (docs/slots.md, "Patterns"). All patterns of a look are one
 * trie, which a walk down the paths of a scene matches at once.
 *
 * A pattern belongs to a *matcher*, a number of the caller's: several patterns may share one.
 */
#ifndef MXG_BIND_PATTERN_H
#define MXG_BIND_PATTERN_H

#include "bind/glob.h"

struct pattern_node {
    uint32_t any;  /* below one level of any name; 0: none */
    uint32_t deep; /* below any number of levels; 0: none */
    uint32_t first_end;
    bool is_deep; /* stays behind any name */
};

struct pattern_edge {
    uint32_t from, to;
    uint32_t glob; /* 1 + the glob; 0: a plain name */
    const char *name;
    size_t len;
};

struct pattern_end {
    uint32_t matcher, next;
    bool only_leaves;
};

struct pattern_set {
    struct arena *arena;
    struct glob_set globs;
    VEC(struct pattern_node) nodes; /* 0: the root of all paths */
    VEC(struct pattern_edge) edges;
    VEC(struct pattern_end) ends; /* 0 unused */
    struct table table;           /* (node, name or glob) → edge */
    bool has_leaf_patterns;       /* a pattern ends with a `*` that matches leaves only */
};

void pattern_set_init(struct pattern_set *set, struct arena *arena);
void pattern_set_finish(struct pattern_set *set);

/*
 * Adds one expression, without blanks around it: "/a/b", "/a//c*". It begins at the root,
 * with or without '/'. Keeps no pointer to `text`. Returns NULL, or its fault.
 */
const char *pattern_add(struct pattern_set *set, const char *text, size_t len, uint32_t matcher);

/* The end of the name that begins at `text` in a list with commas; one in brackets is its own. */
const char *pattern_name_end(const char *text);

/* Adds one path, whose names are not read as patterns. */
void pattern_add_path(struct pattern_set *set, const char *path, size_t len, uint32_t matcher);

/* True if an expression is a path: it matches at most there. */
bool pattern_is_path(const char *text, size_t len);

/* A walk down a scene: the nodes of the trie that the current path reaches, for each level. */
struct pattern_walk {
    struct pattern_set *set;
    struct arena *arena;
    VEC(uint32_t) active;
    VEC(uint32_t) levels; /* first of `active` for each level from the root's on */
    VEC(uint32_t) marks;
    uint32_t epoch;
    VEC(uint32_t) matched;
};

/* Begins at the root, "/". */
void pattern_walk_init(struct pattern_walk *walk, struct pattern_set *set, struct arena *arena);
void pattern_walk_down(struct pattern_walk *walk, const char *name, size_t len);
void pattern_walk_up(struct pattern_walk *walk);
/* False if no pattern matches at or below the current path. */
static inline bool pattern_walk_is_alive(const struct pattern_walk *walk)
{
    return walk->active.len > vec_last(&walk->levels);
}
/* The matchers that match the current path, ascending; valid until the next call. */
const uint32_t *pattern_walk_matches(struct pattern_walk *walk, bool is_leaf, uint32_t *out_num);

#endif
