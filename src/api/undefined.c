// SPDX-License-Identifier: Apache-2.0
/*
 * The net below all other messages: a value that is still undefined when the text of the shader
 * begins. A message of its own explains most of these values. The others come from functions that
 * read a variable before it has a value.
 */
#include "api/generation.h"

/* The node of the document that the value comes from, and the node that makes it, inside of it. */
static void find_elements(const struct ir_graph *graph, uint32_t origin, elem_id *out_outer,
                          elem_id *out_inner)
{
    *out_outer = *out_inner = 0;
    for (uint32_t o = origin; o; o = graph->origins.items[o].parent) {
        elem_id element = graph->origins.items[o].element;
        if (!element)
            continue;
        *out_outer = element;
        if (!*out_inner)
            *out_inner = element;
    }
}

bool generation_is_defined(struct generation *g, const struct ir_graph *graph, const ir_ref *roots,
                           uint32_t num_roots, elem_id where)
{
    const struct document *doc = &g->document->layer.doc;
    ir_ref poison = ir_find_poison(graph, roots, num_roots, &g->scratch);
    if (!poison)
        return true;
    elem_id outer, inner;
    find_elements(graph, ir_get(graph, poison)->origin, &outer, &inner);
    outer = outer ? outer : where;
    const struct element *element = doc_element(doc, outer);
    struct diag_list *diags = &g->result->object.diagnostics.list;
    diag_add(diags, DIAG_ID_undefined_value, doc_place(doc, outer),
             str_text(doc->strings, element->category), str_text(doc->strings, element->name));
    if (inner != outer && inner)
        diag_add(diags, DIAG_ID_connected_here, doc_place(doc, inner), doc_name(doc, inner));
    return false;
}

bool generation_effects_are_defined(struct generation *g, const struct shader *shader,
                                    elem_id where)
{
    VEC(ir_ref) roots = {0};
    for (int stage = 0; stage < NUM_STAGES; stage++) {
        const struct effect_list *effects = &shader->stages[stage].effects;
        for (uint32_t i = 0; i < effects->len; i++)
            if (effects->items[i].value)
                vec_push(&g->scratch, &roots, effects->items[i].value);
    }
    return generation_is_defined(g, shader->graph, roots.items, roots.len, where);
}
