// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_TREE_INTERPRET_H
#define MXG_TREE_INTERPRET_H

#include "tree/tree.h"

/*
 * Calls a function with constant arguments (built-in types, no samplers). false if it reads a
 * uniform, stream or texture, runs for more than *steps_left, or meets undefined behaviour.
 * `results` as for lang_lower_call.
 */
bool lang_eval_call(const struct lang_unit *unit, uint32_t id, const struct ir_value *args,
                    struct ir_value *results, uint32_t *steps_left, struct arena *scratch);

/*
 * Evaluates a call for a constant of a shader. Limits the steps of the call and of the generation;
 * beyond them a call stays a call.
 */
bool lang_eval_constant(struct lang_unit *generated, uint32_t id, const struct ir_value *args,
                        struct ir_value *results, struct arena *scratch);

#endif
