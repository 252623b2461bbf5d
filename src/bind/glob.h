// SPDX-License-Identifier: Apache-2.0
/*
 * Globs of one level of a geometry path (MaterialX Geometry Extensions, "Geometry Name
 * Expressions"), matched all at once: `*` any characters, `?` one, `[a-z]` one of a set, `{a,b*}`
 * alternatives, which nest.
 *
 * The globs of a set form one automaton over code points. Its deterministic states are made on
 * demand, so a match costs the length of the name, however many globs there are.
 */
#ifndef MXG_BIND_GLOB_H
#define MXG_BIND_GLOB_H

#include "base/table.h"

enum { GLOB_ASCII = 128 };

struct glob_edge; /* of the automaton: consumes a code point, or nothing */
struct glob_state;

struct glob_set {
    struct arena *arena;
    VEC(uint32_t) nodes; /* first edge of each node of the automaton; 0: none */
    VEC(struct glob_edge) edges;
    VEC(struct glob_range) ranges; /* of `[]` */
    VEC(uint32_t) goals;           /* by glob: the node that it ends at */
    VEC(uint32_t) glob_of_goal;    /* by node: 1 + the glob that ends there; 0: none */
    VEC(struct glob_name) texts;   /* by glob */
    struct table table;            /* text → glob */
    /* the deterministic states, dropped when there are too many */
    struct arena state_arena;
    VEC(struct glob_state) states; /* 0 unused, 1: of no node, 2: the first */
    VEC(uint32_t) members;         /* nodes of the states */
    VEC(uint32_t) matches;         /* globs of the states */
    struct table state_table;
    VEC(uint32_t) work; /* nodes to visit */
    VEC(uint32_t) marks;
    uint32_t epoch;
};

struct glob_edge {
    uint8_t kind;
    uint32_t value, count; /* the code point, or the ranges */
    uint32_t to, next;     /* the node; the next edge of the same node, 0: none */
};

struct glob_range {
    uint32_t first, last;
};

struct glob_name {
    const char *text;
    size_t len;
};

struct glob_state {
    uint32_t first_member, num_members;
    uint32_t first_match, num_matches;
    uint32_t next[GLOB_ASCII]; /* 0: not known yet */
};

void glob_set_init(struct glob_set *set, struct arena *arena);
void glob_set_finish(struct glob_set *set); /* frees the deterministic states */

/* True if the text is a name, and no glob. */
bool glob_is_plain(const char *text, size_t len);

/*
 * Adds a glob and gives its number, the same for the same text. Keeps no pointer to `text`. Returns
 * NULL, or the fault: "has a '[' without ']'".
 */
const char *glob_add(struct glob_set *set, const char *text, size_t len, uint32_t *out_glob);

/* The numbers of the globs that match a name, ascending; valid until the next call. */
const uint32_t *glob_match(struct glob_set *set, const char *name, size_t len, uint32_t *out_num);

#endif
