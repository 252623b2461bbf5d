// SPDX-License-Identifier: Apache-2.0
#include "function.h"

#include "lower/lower.h"

bool function_call(struct generation *generation, const struct ir_graph *graph, ir_ref ref,
                   const struct ir_value *args, uint32_t result, struct ir_value *out)
{
    return lang_eval_node(&generation->result->unit, graph, ref, args, result, &generation->scratch,
                          out);
}
