// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_SPECIALISE_SPECIALISE_H
#define MXG_SPECIALISE_SPECIALISE_H

#include "tree/tree.h"

/*
 * plan.c (specialise.c): one version per function for a whole shader. First lang_plan_call for
 * every call in the IR, then lang_plan_finish, then lang_plan_version with each result of
 * lang_plan_call.
 *
 * A version has some parameters bound to constants: parameters with equal arguments in all calls,
 * and strings and flags. These choose code, so calls with other strings or flags get other
 * versions. Options become constants. The version folds code, drops dead branches, locals and
 * assignments, and inlines small functions. It lacks bound parameters and unused `in` parameters:
 * its callers pass only the parameters that lang_param_dropped keeps. If nothing changes, the
 * version is the function itself.
 */
/* a constant's words, or NULL */
uint32_t lang_plan_call(struct lang_unit *generated, uint32_t id, const union ir_word *const *args);
void lang_plan_finish(struct lang_unit *generated);
uint32_t lang_plan_version(const struct lang_unit *generated, uint32_t call);

/* True if the version lacks parameter `index` of the function that lang_plan_call received. */
bool lang_param_dropped(const struct lang_unit *generated, uint32_t version, uint32_t given,
                        unsigned index);

/* The constant that a version has compiled in for parameter `index` of its origin; NULL: none. */
const union ir_word *lang_param_bound(const struct lang_unit *generated, uint32_t version,
                                      unsigned index);

/* The version's record; NULL: the function is no version. */
const struct lang_version *lang_version_of(const struct lang_unit *generated, uint32_t id);

/*
 * canonical.c: replaces the trees of a layer's functions by specialised trees without constant
 * arguments. For a library, after its last parse and before its first generation.
 */
void lang_make_canonical(struct lang_unit *unit);

#endif
