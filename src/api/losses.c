// SPDX-License-Identifier: Apache-2.0
/* Tells what a shader that was made has no room for, or another closure for. */
#include "api/generation.h"

#include <stdio.h>
#include <string.h>

elem_id generation_element_of(const struct generation *g, uint32_t origin)
{
    elem_id element = result_element_of(g->result, origin);
    return element ? element : g->element;
}

void generation_tell_lost(struct generation *g)
{
    const struct shader *shader = &g->result->shader;
    const struct document *doc = &g->document->layer.doc;
    for (uint32_t i = 0; i < shader->reflection.lost.len; i++) {
        const struct shader_lost *lost = &shader->reflection.lost.items[i];
        elem_id node = generation_element_of(g, lost->origin);
        str_id name = str_find(doc->strings, lost->part, strlen(lost->part));
        elem_id input = name ? doc_child(doc, node, name) : 0;
        diag_add(diags_of(g), DIAG_ID_slab_left_out, doc_place(doc, input ? input : node),
                 lost->part, str_text(doc->strings, doc_element(doc, node)->category), lost->why);
    }
}

static void tell_flat(struct generation *g, elem_id node, const char *why)
{
    const struct document *doc = &g->document->layer.doc;
    diag_add(diags_of(g), DIAG_ID_derivatives_left_out, doc_place(doc, node),
             str_text(doc->strings, doc_element(doc, node)->category), why);
}

void generation_tell_flat_calls(struct generation *g)
{
    const struct shader *shader = &g->result->shader;
    for (uint32_t i = 0; i < shader->reflection.flat_calls.len; i++) {
        const struct shader_flat_call *call = &shader->reflection.flat_calls.items[i];
        struct text why;
        text_init(&why, &g->scratch);
        text_fmt(&why, "paths do not follow the loops or returns of its function '%s'",
                 str_text(shader->strings, call->function));
        tell_flat(g, generation_element_of(g, call->origin), text_cstr(&why));
    }
}

void generation_tell_flat_patterns(struct generation *g)
{
    const struct ir_graph *graph = &g->result->graph;
    elem_id last = 0;
    for (uint32_t i = 0; !role_is_pass(g->role) && i < graph->flat_origins.len; i++) {
        elem_id node = generation_element_of(g, graph->flat_origins.items[i]);
        if (node != last)
            tell_flat(g, node, "a function has no neighbouring pixels");
        last = node;
    }
}

void generation_tell_stand_ins(struct generation *g)
{
    const struct shader *shader = &g->result->shader;
    const struct document *doc = &g->document->layer.doc;
    for (uint32_t i = 0; i < shader->reflection.stand_ins.len; i++) {
        const struct shader_stand_in *made = &shader->reflection.stand_ins.items[i];
        elem_id node = generation_element_of(g, made->origin);
        char share[16];
        snprintf(share, sizeof share, "%.2g %%", 100.0 * made->error);
        diag_add(diags_of(g), DIAG_ID_closure_fitted, doc_place(doc, node), g->result->target->name,
                 str_text(doc->strings, doc_element(doc, node)->category), made->num_closures,
                 made->num_closures == 1 ? "" : "s", share);
    }
}
