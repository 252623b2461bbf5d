// SPDX-License-Identifier: Apache-2.0
/* Lowers function calls to IR. */
#ifndef MXG_LOWER_LOWER_H
#define MXG_LOWER_LOWER_H

#include "tree/tree.h"

/*
 * Builds a call of function `id`: args are one IR node per `in`/`inout` parameter in order (for
 * expressions: per input; a ref of 0 means the input is absent and must not be read). results
 * receives the returned value, if any, then each `out`/`inout` parameter. Straight-line code
 * becomes nodes, and so do branches with a constant condition and branches that a SELECT can merge.
 * Calls with only constant arguments are evaluated. Any other call becomes a CALL with all its
 * arguments; lang_plan_call receives it when the shader is complete. Writes num_results
 * (lang_num_results) refs. Never fails: POISON after an error. `generated` is the unit of the
 * generation, which receives specialised functions; its base is the library's unit.
 */
void lang_lower_call(struct lang_unit *generated, struct ir_graph *graph,
                     const struct lang_host *host, uint32_t id, const ir_ref *args,
                     ir_ref *results);
/* The type of a graph for a type of the unit: structs and arrays have numbers of their own. */
ir_type_id lang_graph_type(const struct lang_unit *unit, struct ir_graph *graph, ir_type_id type);
unsigned lang_num_results(const struct lang_unit *unit, uint32_t id);

enum { LANG_MAX_STEPS = 1000000 /* of an evaluated call */ };
/*
 * evaluate.c: the results of a CALL for its arguments, and their number. out[0] is what the
 * function returns, out[1] its first `out` parameter, also where it returns nothing. 0: another
 * node, or the function reads a texture, or it takes more than *steps_left, which falls by those
 * that it took.
 */
uint32_t lang_eval_node(const struct lang_unit *unit, const struct ir_graph *graph, ir_ref call,
                        const struct ir_value *args, uint32_t *steps_left, struct arena *scratch,
                        struct ir_value out[IR_MAX_RESULTS]);

#endif
