// SPDX-License-Identifier: Apache-2.0
#include "function.h"

#include "lower/lower.h"
#include "tree/eval.h"

enum { MAX_STEPS = 1000000, MAX_RESULTS = 16 };

bool function_call(struct generation *generation, const struct ir_graph *graph, ir_ref ref,
                   const struct ir_value *args, uint32_t result, struct ir_value *out)
{
    const struct lang_unit *unit = &generation->result->unit;
    uint32_t function = graph->callees.items[ir_get(graph, ref)->attr].index;
    bool returns = lang_function(unit, function, NULL)->return_type != IR_TYPE_VOID;
    struct ir_value results[MAX_RESULTS];
    if (ir_get(graph, ref)->op != IR_CALL || (result == 0 && !returns)
        || lang_num_results(unit, function) > MAX_RESULTS
        || !lang_eval_call(unit, function, args, results, &(uint32_t){MAX_STEPS},
                           &generation->scratch))
        return false;
    *out = results[returns ? result : result - 1];
    return true;
}
