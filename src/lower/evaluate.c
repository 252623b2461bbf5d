// SPDX-License-Identifier: Apache-2.0
#include "lower/lower.h"
#include "tree/eval.h"

enum { MAX_STEPS = 1000000, MAX_RESULTS = 16 };

bool lang_eval_node(const struct lang_unit *unit, const struct ir_graph *graph, ir_ref call,
                    const struct ir_value *args, uint32_t result, struct arena *scratch,
                    struct ir_value *out)
{
    struct ir_value results[MAX_RESULTS];
    const struct ir_node *node = ir_get(graph, call);
    if (node->op != IR_CALL)
        return false;
    uint32_t function = graph->callees.items[node->attr].index;
    bool returns = lang_function(unit, function, NULL)->return_type != IR_TYPE_VOID;
    if ((result == 0 && !returns) || lang_num_results(unit, function) > MAX_RESULTS
        || !lang_eval_call(unit, function, args, results, &(uint32_t){MAX_STEPS}, scratch))
        return false;
    *out = results[returns ? result : result - 1];
    return true;
}
