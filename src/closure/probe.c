// SPDX-License-Identifier: Apache-2.0
#include "closure/closure.h"

/*
 * Functions as path tracers call them: a raster shares structs between lobes, which the graph's
 * evaluator does not compute.
 */
static ir_ref global(void *user_data, struct ir_graph *g, const struct lang_unit *unit,
                     uint32_t global_id)
{
    const struct lang_host *lang = user_data;
    const struct lang_global *known = lang_global(unit, global_id, NULL);
    if (strcmp(str_text(unit->strings, known->name), "option_path") == 0)
        return ir_const_int(g, 1);
    return lang->global(lang->user_data, g, unit, global_id);
}

void closure_probe(const struct closure_host *host, ir_ref view, struct closure_probe *out)
{
    out->point = (struct closure_point){.view = view};
    out->lang = (struct lang_host){.user_data = (void *)(uintptr_t)host->lang,
                                   .global = global,
                                   .max_outer_nodes = host->lang->max_outer_nodes,
                                   .max_inline_nodes = host->lang->max_inline_nodes};
    out->host = *host;
    out->host.point = &out->point;
    out->host.lang = &out->lang;
}

ir_ref closure_probe_direction(struct ir_graph *graph, uint32_t number)
{
    return ir_build(graph, IR_LOCAL, IR_TYPE_VEC3, UINT32_MAX - number, NULL, 0);
}
