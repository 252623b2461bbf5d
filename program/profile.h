// SPDX-License-Identifier: Apache-2.0
/*
 * Profiles of platforms: options of generation in a file (docs/slabs.md). A line of TOML has a key
 * and its value: a number, a string, true or false, or an array of strings.
 */
#ifndef MXG_PROGRAM_PROFILE_H
#define MXG_PROGRAM_PROFILE_H

#include "program/store.h"

#include <mxgen/mxgen.h>
#include <stdbool.h>

/* Names and texts in turn, then NULL. */
extern const char *const profile_texts[];

/* The pairs of a profile, in the order of its lines. */
struct profile {
    const char *name; /* NULL: none */
    struct store store;
    struct profile_pair *pairs;
    size_t num_pairs;
};

/*
 * Sets the options of a profile: the name of one in profile_texts, or a file, whose name ends with
 * ".toml". False after a message. Call profile_finish in both cases.
 */
bool profile_apply(struct profile *profile, mxg_options *options, const char *name);
void profile_finish(struct profile *profile);

/* Tells that somebody else set an option since; a list still has the items of the profile. */
void profile_override(struct profile *profile, const char *key);

/* The line of the profile that gave an option `value`, or a list this item; 0: none. */
uint32_t profile_line(const struct profile *profile, const char *key, const char *value);

#endif
