// SPDX-License-Identifier: Apache-2.0
/* The deferred pipeline in a generation, for materials and for the passes that light them. */
#include "api/generation.h"

bool generation_stores(const struct generation *g)
{
    return g->options[OPTION_pipeline].number == PIPELINE_DEFERRED && !g->stored;
}

struct deferred_layout generation_storage(const struct option_value *options,
                                          const struct target *target)
{
    return (struct deferred_layout){
        .storage = (enum deferred_storage)options[OPTION_storage].number,
        .set = (uint32_t)options[OPTION_binding_set].number + 1,
        .sets = target->caps & CAP_SETS,
    };
}

void generation_defer(struct generation *g)
{
    g->storage = generation_storage(g->options, g->result->target);
    g->result->shader.is_stored = g->stored != CLASS_EMPTY;
    if (g->stored == CLASS_COMPLEX) {
        g->above = deferred_above(&g->result->shader);
        g->closure_host.above = &g->above;
    }
    g->result->shader.has_passes = g->options[OPTION_pipeline].number != PIPELINE_FORWARD;
    g->closure_host.only_cuts = g->options[OPTION_pipeline].number == PIPELINE_DEPTH && !g->stored;
    if (generation_stores(g)) {
        g->closure_host.store = deferred_store;
        g->closure_host.store_data = &g->storage;
    }
}

bool generation_can_store(struct generation *g)
{
    const struct shader *shader = &g->result->shader;
    ir_ref misfit = generation_stores(g) ? deferred_misfit(shader, g->root) : 0;
    if (!misfit)
        return true;
    const struct ir_origin *origin =
        &shader->graph->origins.items[ir_get(shader->graph, misfit)->origin];
    const struct document *doc = &g->document->layer.doc;
    diag_add(&g->result->object.diagnostics.list, DIAG_ID_closure_not_stored,
             doc_place(doc, origin->element ? origin->element : g->element),
             str_text(shader->strings, origin->name));
    return false;
}

void generation_tell_forward(struct generation *g)
{
    const struct shader *shader = &g->result->shader;
    if (!generation_stores(g) || shader->stored_words)
        return;
    const struct document *doc = &g->document->layer.doc;
    diag_add(&g->result->object.diagnostics.list, DIAG_ID_drawn_forward, doc_place(doc, g->element),
             str_text(shader->strings, shader->name),
             closure_is_surface(shader, g->root) ? "its opacity may be between 0 and 1"
                                                 : "it is no surface");
}
