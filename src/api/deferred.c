// SPDX-License-Identifier: Apache-2.0
/* The deferred pipeline in a generation, for materials and for the passes that light them. */
#include "api/generation.h"

#include "slabs/bytes.h"

#include <assert.h>

/* ---- Options ---- */

static const struct clash {
    enum option_id option, other;
    const char *value, *other_value, *why;
} clashes[] = {
#define CLASH(option, value, other, other_value, why) \
    {OPTION_##option, OPTION_##other, value, other_value, why},
#include "api/clashes.def"
#undef CLASH
};

/* The passes belong to the pipeline whatever the option says. */
static const char *pipeline_of(const struct generation *g)
{
    return g->is_pass ? "deferred" : g->options[OPTION_pipeline].text;
}

static bool has_value(const struct generation *g, enum option_id option, const char *value)
{
    const struct option_value *v = &g->options[option];
    if (option == OPTION_pipeline)
        return strcmp(pipeline_of(g), value) == 0;
    return v->text ? strcmp(v->text, value) == 0 : v->number != 0 && strcmp(value, "true") == 0;
}

static bool tell_clash(struct generation *g, const char *option, const char *value,
                       const char *other, const char *other_value, const char *why)
{
    diag_add(&g->result->object.diagnostics.list, DIAG_ID_options_clash, (struct diag_place){0},
             option, value, other, other_value, why);
    return false;
}

/* OpenGL has compute stages from version 4.3 on. */
static bool check_target(struct generation *g)
{
    const struct target *target = g->result->target;
    const char *version = g->options[OPTION_version].text, *pipeline = option_key(OPTION_pipeline);
    if (!(target->caps & CAP_STORES))
        return tell_clash(g, pipeline, pipeline_of(g), "target", target->name,
                          "only the targets vulkan and glsl have the passes");
    return !*version || strcmp(version, "430") >= 0
           || tell_clash(g, pipeline, pipeline_of(g), option_key(OPTION_version), version,
                         "the passes need compute stages, from 430 on");
}

bool generation_check_pipeline(struct generation *g)
{
    bool good = has_value(g, OPTION_pipeline, "forward") || check_target(g);
    for (size_t i = 0; i < sizeof clashes / sizeof *clashes; i++) {
        const struct clash *c = &clashes[i];
        if (has_value(g, c->option, c->value) && has_value(g, c->other, c->other_value))
            good = tell_clash(g, option_key(c->option), c->value, option_key(c->other),
                              c->other_value, c->why);
    }
    return good;
}

/* ---- Hooks ---- */

bool generation_stores(const struct generation *g)
{
    return g->options[OPTION_pipeline].number == PIPELINE_DEFERRED && !g->is_pass && !g->misfit;
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
    g->result->storage = generation_storage(g->options, g->result->target);
    g->result->shader.is_stored = g->stored != CLASS_EMPTY;
    if (g->stored == CLASS_COMPLEX) {
        g->above = deferred_above(&g->result->shader);
        g->closure_host.above = &g->above;
    }
    g->result->shader.has_passes = g->options[OPTION_pipeline].number != PIPELINE_FORWARD;
    g->closure_host.only_cuts = g->options[OPTION_pipeline].number == PIPELINE_DEPTH && !g->is_pass;
    if (generation_stores(g)) {
        g->closure_host.store = deferred_store;
        g->closure_host.store_data = &g->result->storage;
    }
}

void generation_hide_misfits(struct generation *g)
{
    if (generation_stores(g) && g->options[OPTION_slabs].number)
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
    if (misfit && g->options[OPTION_slabs].number)
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
