// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_TREE_EVAL_H
#define MXG_TREE_EVAL_H

#include "tree/tree.h"

/*
 * Calls a function with constant arguments (built-in types, no samplers). false if it reads a
 * uniform, stream or texture, runs for more than `max_steps`, or meets undefined behaviour.
 * `results` as for lang_lower_call.
 */
bool lang_eval_call(const struct lang_unit *unit, uint32_t id, const struct ir_value *args,
                    struct ir_value *results, uint32_t max_steps, struct arena *scratch);

#endif
