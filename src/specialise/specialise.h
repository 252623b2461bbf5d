// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_SPECIALISE_SPECIALISE_H
#define MXG_SPECIALISE_SPECIALISE_H

#include "tree/tree.h"

/*
 * plan.c (specialise.c): one version per function for a whole shader. First lang_plan_call for
 * every call in the IR, then lang_plan_finish, then lang_plan_version of what each lang_plan_call
 * returned.
 *
 * A version has some parameters bound to constants: those that all calls agree on, and strings and
 * flags, which choose what a function is, so that calls with others get versions of their own.
 * Options have their values. Code is folded, branches that are never taken, locals and assignments
 * nobody needs are dropped, small functions put in place of their calls. Bound parameters are gone,
 * and `in` parameters that turn out to be unused: whoever calls a version passes what
 * lang_param_dropped leaves. The version is the function itself where nothing changes.
 */
/* a constant's words, or NULL */
uint32_t lang_plan_call(struct lang_unit *generated, uint32_t id, const union ir_word *const *args);
void lang_plan_finish(struct lang_unit *generated);
uint32_t lang_plan_version(const struct lang_unit *generated, uint32_t call);

/* Is parameter `index` of the function that was given to lang_plan_call gone from its version? */
bool lang_param_dropped(const struct lang_unit *generated, uint32_t version, uint32_t given,
                        unsigned index);

/*
 * canonical.c: replaces the trees of a layer's functions by what specialising makes of them where
 * nothing is known of their arguments. For a library, once everything that is parsed for it has
 * been; no generation may use it yet.
 */
void lang_make_canonical(struct lang_unit *unit);

#endif
