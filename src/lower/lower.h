// SPDX-License-Identifier: Apache-2.0
/* Calls of functions become IR. */
#ifndef MXG_LOWER_LOWER_H
#define MXG_LOWER_LOWER_H

#include "tree/tree.h"

/*
 * Builds a call of function `id`: args are one IR node per `in`/`inout` parameter in order (for
 * expressions: per input; a ref of 0 means the input is absent and must not be read). results
 * receives the returned value, if any, then each `out`/`inout` parameter. Straight-line code and
 * branches that are known or can be merged by SELECT become nodes; all-constant calls are
 * evaluated; anything else becomes a CALL with all its arguments, which lang_plan_call is told when
 * the shader stands. Writes num_results (lang_num_results) refs. Never fails: POISON after an
 * error. `generated` is the unit of the generation: versions of functions go there; its base is the
 * library's unit.
 */
void lang_lower_call(struct lang_unit *generated, struct ir_graph *graph,
                     const struct lang_host *host, uint32_t id, const ir_ref *args,
                     ir_ref *results);
unsigned lang_num_results(const struct lang_unit *unit, uint32_t id);

#endif
