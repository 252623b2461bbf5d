// SPDX-License-Identifier: Apache-2.0
#include "lower/lower.h"
#include "tree/interpret.h"

uint32_t lang_eval_node(const struct lang_unit *unit, const struct ir_graph *graph, ir_ref call,
                        const struct ir_value *args, uint32_t *steps_left, struct arena *scratch,
                        struct ir_value out[IR_MAX_RESULTS])
{
    const struct ir_node *node = ir_get(graph, call);
    if (node->op != IR_CALL)
        return 0;
    uint32_t function = graph->callees.items[node->attr].index;
    uint32_t first = lang_function(unit, function, NULL)->return_type == IR_TYPE_VOID,
             end = first + lang_num_results(unit, function);
    out[0].type = IR_TYPE_VOID;
    bool is_known = end <= IR_MAX_RESULTS
                    && lang_eval_call(unit, function, args, out + first, steps_left, scratch);
    return is_known ? end : 0;
}
