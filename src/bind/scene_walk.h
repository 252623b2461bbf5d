// SPDX-License-Identifier: Apache-2.0
/* A walk down a scene that gives primitives their states, for the files of the room. */
#ifndef MXG_BIND_SCENE_WALK_H
#define MXG_BIND_SCENE_WALK_H

#include "bind/bind.h"

/* A step from a state to the state of a primitive below. */
struct state_step {
    uint32_t from, level, first_match, num_matches, to;
};

struct state_walk {
    struct bindings *b;
    struct arena *scratch;
    struct pattern_walk patterns;
    VEC(prim_id) path;            /* from below the root to the current primitive */
    VEC(struct state_step) steps; /* 0 unused */
    VEC(uint32_t) matches;        /* of the steps */
    VEC(uint32_t) named;          /* of instance_matches */
    struct table steps_table;
    struct table states_table;
};

#define STATE_UNKNOWN UINT32_MAX /* in state_of: this one must be found */

/* Makes a state of the last entries, from `first` on; drops them if there is an equal one. */
uint32_t walk_intern_state(struct state_walk *walk, uint32_t first);

/*
 * again.c: the states that primitives had in `before`, in terms of the look of now. Those at a
 * difference are STATE_UNKNOWN, and so are new primitives; what lies below an unknown state must be
 * found again, too.
 */
void walk_take_states(struct state_walk *walk, const struct bindings *before);

#endif
