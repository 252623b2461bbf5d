// SPDX-License-Identifier: Apache-2.0
/* The views of mxg_inspect: each is a text. */
#include "api/generation.h"

#include <assert.h>

/* ---- Elements ---- */

static bool is_renderable(const mxg_document *document, elem_id element)
{
    for (uint32_t i = 0; i < document->renderables.num; i++)
        if (renderable_at(document, i) == element)
            return true;
    return false;
}

static void write_element(struct generation *g, elem_id element, unsigned depth, struct text *out)
{
    const struct document *doc = &g->document->layer.doc;
    const struct element *e = doc_element(doc, element);
    str_id type = doc_attr_value(doc, element, STR_type);
    size_t begin = out->len;
    text_fmt(out, "%*s%s", (int)(2 * depth), "", str_text(doc->strings, e->category));
    if (e->name)
        text_fmt(out, " %s", str_text(doc->strings, e->name));
    if (type)
        text_fmt(out, " : %s", str_text(doc->strings, type));
    static const str_id shown[] = {STR_value,  STR_nodename,      STR_nodegraph,
                                   STR_output, STR_interfacename, STR_nodedef};
    for (size_t i = 0; i < sizeof shown / sizeof *shown; i++) {
        str_id value = doc_attr_value(doc, element, shown[i]);
        if (value)
            text_fmt(out, " %s=\"%s\"", str_text(doc->strings, shown[i]),
                     str_text(doc->strings, value));
    }
    text_show(out, begin);
    text_str(out, is_renderable(g->document, element) ? "  [renderable]\n" : "\n");
}

static void view_elements(struct generation *g, struct text *out)
{
    const struct document *doc = &g->document->layer.doc;
    unsigned depth = 0;
    for (elem_id e = doc->root, next; e; e = next) {
        if (e != doc->root)
            write_element(g, e, depth - 1, out);
        next = doc_element(doc, e)->first_child;
        depth += next != 0;
        for (elem_id at = e; !next && at != doc->root; at = doc_element(doc, at)->parent) {
            next = doc_element(doc, at)->next;
            depth -= !next;
        }
    }
    assert(depth == 0);
}

/* ---- The optimised graph ---- */

static void view_ir(struct generation *g, struct text *out)
{
    if (generation_start(g) && generation_build(g))
        ir_print(&g->result->graph, &g->root, 1, out);
}

static void view_closures(struct generation *g, struct text *out)
{
    if (!generation_start(g) || !generation_build(g))
        return;
    generation_start_closures(g);
    if (!generation_budget_slabs(g))
        return;
    generation_walk_slabs(g);
    generation_name_closures(g);
    closure_describe(&g->result->shader, &g->closure_host, g->root, out);
}

static void view_sheet(struct generation *g, struct text *out,
                       void write(const struct slab_sheet *sheet, struct text *out))
{
    struct slab_sheet sheet;
    if (!generation_start(g) || !generation_build(g))
        return;
    generation_start_closures(g);
    struct slab_budget budget = generation_slab_budget(g);
    build_fill_sheet(g->builder, &g->closure_host, &g->estimates, &budget, g->root, &sheet);
    if (!generation_slabs_are_few(g, &sheet.report))
        return;
    write(&sheet, out);
    if (g->role->returns == RETURNS_SLABS && sheet.report.is_met && !sheet.is_recognised)
        generation_light(g); /* tells where no pixel stores the bytes of the sheet */
}

static void view_slabs(struct generation *g, struct text *out)
{
    view_sheet(g, out, slabs_write_text);
}

static void view_slabs_json(struct generation *g, struct text *out)
{
    view_sheet(g, out, slabs_write_json);
}

static void write_counts(struct text *out, const char *name, uint32_t count)
{
    text_fmt(out, "%-24s %u\n", name, (unsigned)count);
}

static void view_statistics(struct generation *g, struct text *out)
{
    if (!generation_start(g) || !generation_build(g) || !generation_emit(g) || !generation_finish(g)
        || !generation_spell(g))
        return;
    const mxg_result *result = g->result;
    const struct shader *shader = &result->shader;
    const struct shader_stage *pixel = &shader->stages[STAGE_PIXEL];
    write_counts(out, "elements", doc_num_elements(&g->document->layer.doc));
    write_counts(out, "operations built", result->graph.nodes.len - 1);
    write_counts(out, "closures", shader->reflection.closures.len);
    write_counts(out, "variables", shader->interface.used.len);
    write_counts(out, "compiled inputs", shader->reflection.compiled.len);
    write_counts(out, "functions", pixel->reach.functions.len + pixel->functions.len);
    write_counts(out, "pixel statements", pixel->statements.len);
    write_counts(out, "pixel source bytes", (uint32_t)result->stages[STAGE_PIXEL].size);
    write_counts(out, "vertex source bytes", (uint32_t)result->stages[STAGE_VERTEX].size);
    text_fmt(out, "%-24s %s\n%-24s %s\n", "transparent",
             shader->reflection.transparent ? "yes" : "no", "lit",
             shader->reflection.lit ? "yes" : "no");
}

/* ---- The views ---- */

static const struct view {
    void (*write)(struct generation *g, struct text *out);
    bool generates; /* needs a target */
} views[] = {
    [MXG_VIEW_ELEMENTS] = {view_elements, false},
    [MXG_VIEW_GRAPH] = {graph_view_text, false},
    [MXG_VIEW_DOT] = {graph_view_dot, false},
    [MXG_VIEW_IR] = {view_ir, true},
    [MXG_VIEW_SLABS] = {view_slabs, true},
    [MXG_VIEW_CLOSURES] = {view_closures, true},
    [MXG_VIEW_STATISTICS] = {view_statistics, true},
    [MXG_VIEW_SLABS_JSON] = {view_slabs_json, true},
};

static void inspect(struct generation *g)
{
    const struct view *view = g->user_data;
    struct text out;
    text_init(&out, &g->result->object.arena);
    view->write(g, &out);
    if (diags_of(g)->num_errors)
        return;
    g->result->text = text_cstr(&out);
    g->result->text_size = out.len;
}

mxg_status mxg_inspect(mxg_context *context, const mxg_document *document, mxg_view view,
                       const mxg_generate_desc *desc, mxg_result **out_result)
{
    if (out_result)
        *out_result = NULL;
    if ((unsigned)view >= sizeof views / sizeof *views
        || (views[view].generates && !generation_names_target(desc)))
        return MXG_ERROR_ARGUMENT;
    return generation_run(context, document, desc, inspect, (void *)(uintptr_t)&views[view],
                          out_result);
}

const char *mxg_result_text(const mxg_result *result, size_t *out_size)
{
    if (out_size)
        *out_size = result ? result->text_size : 0;
    return result ? result->text : NULL;
}
