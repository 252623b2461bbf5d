// SPDX-License-Identifier: Apache-2.0
/* Calls of portable functions, for tests that evaluate the graph of a generation. */
#ifndef MXG_TESTS_CONFORMANCE_FUNCTION_H
#define MXG_TESTS_CONFORMANCE_FUNCTION_H

#include "api/generation.h"

/*
 * The value of a CALL node for its arguments: RESULT 0 is what the function returns, RESULT 1 its
 * first `out` parameter, also where it returns nothing. false: another node, or it did not end.
 */
bool function_call(struct generation *generation, const struct ir_graph *graph, ir_ref ref,
                   const struct ir_value *args, uint32_t result, struct ir_value *out);

#endif
