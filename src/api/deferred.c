// SPDX-License-Identifier: Apache-2.0
/* The deferred pipeline in a generation, for materials and for the passes that light them. */
#include "api/generation.h"

#include "slabs/bytes.h"

#include <assert.h>

bool generation_packs(const struct generation *g)
{
    return g->options[OPTION_form].number == FORM_PAYLOAD && !g->is_pass;
}

bool generation_stores(const struct generation *g)
{
    bool is_deferred = g->options[OPTION_pipeline].number == PIPELINE_DEFERRED;
    return generation_packs(g) || (is_deferred && !g->is_pass && !g->misfit);
}

struct deferred_layout generation_storage(const struct option_value *options,
                                          const struct target *target, bool is_payload)
{
    return (struct deferred_layout){
        .storage =
            is_payload ? STORAGE_ROUND : (enum deferred_storage)options[OPTION_storage].number,
        .set = (uint32_t)options[OPTION_binding_set].number + 1,
        .sets = target->caps & CAP_SETS,
        .is_payload = is_payload,
        .diffuses = !is_payload && options[OPTION_sss].number,
        .blurs = !is_payload && options[OPTION_rough_refraction].number,
    };
}

void generation_defer(struct generation *g)
{
    g->result->storage = generation_storage(g->options, g->result->target, generation_packs(g));
    g->result->shader.is_stored = g->stored != CLASS_EMPTY;
    if (g->stored >= CLASS_COMPLEX) {
        g->above = deferred_above(&g->result->shader);
        g->closure_host.above = &g->above;
    }
    g->result->shader.has_passes = g->options[OPTION_pipeline].number != PIPELINE_FORWARD;
    g->closure_host.only_cuts = g->options[OPTION_pipeline].number == PIPELINE_DEPTH && !g->is_pass;
    if (generation_stores(g)) {
        g->closure_host.store = deferred_store;
        g->closure_host.store_data = &g->result->storage;
        g->closure_host.stores_all = generation_packs(g);
    }
}

void generation_hide_misfits(struct generation *g)
{
    if (generation_stores(g) && (generation_packs(g) || g->options[OPTION_slabs].number))
        g->root = build_without_hidden(g->builder, g->root);
}

static void report_misfit(struct generation *g, ir_ref misfit)
{
    const struct shader *shader = &g->result->shader;
    const struct ir_origin *origin =
        &shader->graph->origins.items[ir_get(shader->graph, misfit)->origin];
    const struct document *doc = &g->document->layer.doc;
    diag_add(&g->result->object.diagnostics.list, DIAG_ID_closure_not_stored,
             doc_place(doc, origin->element ? origin->element : g->element),
             str_text(shader->strings, origin->name));
}

/* The shader lights itself, because of a closure that is no slab. */
static void draw_forward(struct generation *g, ir_ref misfit)
{
    g->misfit = misfit;
    g->build_options.marks_slabs = false;
    g->closure_host.store = NULL;
}

bool generation_can_store(struct generation *g)
{
    ir_ref misfit = generation_stores(g) ? deferred_misfit(&g->result->shader, g->root) : 0;
    if (misfit && !generation_packs(g) && g->options[OPTION_slabs].number)
        draw_forward(g, misfit);
    else if (misfit)
        report_misfit(g, misfit);
    return !misfit || g->misfit;
}

/* Why a material lights itself. */
static const char *why_forward(struct generation *g)
{
    const struct shader *shader = &g->result->shader;
    const struct ir_graph *graph = shader->graph;
    if (!closure_is_surface(shader, g->root))
        return "it is no surface";
    if (!g->misfit)
        return shader->alpha == ALPHA_BLEND ? "its opacity may be between 0 and 1" : "it has AOVs";
    struct text why;
    text_init(&why, &g->scratch);
    text_fmt(
        &why, "its part '%s' is no slab",
        str_text(shader->strings, graph->origins.items[ir_get(graph, g->misfit)->origin].name));
    return text_cstr(&why);
}

void generation_tell_forward(struct generation *g)
{
    const struct shader *shader = &g->result->shader;
    const struct document *doc = &g->document->layer.doc;
    if (generation_packs(g))
        return;
    assert(!shader->closures.len || g->result->storage.storage == STORAGE_FLOAT
           || shader->stored_words * SLAB_WORD_BYTES <= g->result->slabs.after.bytes);
    if (shader->stored_words && shader->closures.len > DEFERRED_MAX_CLOSURES)
        diag_add(&g->result->object.diagnostics.list, DIAG_ID_closures_not_stored,
                 doc_place(doc, g->element), str_text(shader->strings, shader->name),
                 (unsigned)shader->closures.len, (unsigned)DEFERRED_MAX_CLOSURES);
    bool is_asked = generation_stores(g) || g->misfit;
    if (!is_asked || shader->stored_words)
        return;
    diag_add(&g->result->object.diagnostics.list, DIAG_ID_drawn_forward, doc_place(doc, g->element),
             str_text(shader->strings, shader->name), why_forward(g));
}
