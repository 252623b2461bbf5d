// SPDX-License-Identifier: Apache-2.0
/*
 * Profiles of platforms: options of generation in a file (docs/slabs.md). A line of TOML has a key
 * and its value: a number, a string, true or false, or an array of strings.
 */
#ifndef MXG_PROGRAM_PROFILE_H
#define MXG_PROGRAM_PROFILE_H

#include <mxgen/mxgen.h>
#include <stdbool.h>

/* Names and texts in turn, then NULL. */
extern const char *const profile_texts[];

/*
 * Sets the options of a profile: the name of one in profile_texts, or a file, whose name ends with
 * ".toml". False after a message.
 */
bool profile_apply(mxg_options *options, const char *name);

/* The line of a profile's file that sets an option to `value`, or to a list with it; 0: none. */
uint32_t profile_line(const char *name, const char *key, const char *value);

#endif
