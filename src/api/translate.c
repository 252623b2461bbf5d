// SPDX-License-Identifier: Apache-2.0
/* mxg_translate: surfaces of one model as surfaces of another, with graphs of their inputs. */
#include "api/translate.h"

/* ---- One surface ---- */

static bool find_leaf(void *user_data, const struct ir_graph *graph, ir_ref ref,
                      struct operand *out)
{
    const struct translation *t = user_data;
    uint32_t index = translate_source_of(t, graph, ref);
    if (index == t->sources.len || !t->sources.items[index].is_connected)
        return false;
    *out = (struct operand){
        .kind = OPERAND_LEAF, .type = t->sources.items[index].type, .index = index};
    return true;
}

static void find_values(struct translation *t)
{
    mxg_nodedef info = {.size = sizeof info};
    mxg_document_nodedef(t->document, t->definition, &info);
    t->inputs.len = 0;
    t->nodes = (struct value_nodes){.arena = t->arena, .leaf = find_leaf, .user_data = t};
    for (uint32_t i = 0; i < info.num_inputs; i++) {
        struct translated_input input = {.port.size = sizeof input.port};
        mxg_port output;
        mxg_document_port(t->document, t->definition, i, &input.port);
        bool has_value =
            !*input.port.defaultgeomprop
            && translate_find_port(t, vec_last(&t->chain),
                                   translate_output_name(t, input.port.name), true, &output);
        if (has_value)
            translate_set_input(t, &input,
                                translate_build(t, t->chain.len,
                                                translate_output_name(t, input.port.name),
                                                TRANSLATE_CONNECTED));
        vec_push(t->arena, &t->inputs, input);
    }
}

/* ---- What is lost ---- */

/* Marks the inputs of the old surface that a value reads. */
static void mark_sources(struct translation *t, ir_ref root, bool *marks)
{
    if (!root)
        return;
    const struct ir_graph *graph = &t->value->graph;
    const uint8_t *needed = ir_mark(graph, &root, 1, t->arena);
    for (ir_ref ref = 1; ref <= root; ref++) {
        uint32_t source = needed[ref] ? translate_source_of(t, graph, ref) : t->sources.len;
        if (source < t->sources.len)
            marks[source] = true;
    }
}

/*
 * Why an input that the document sets matters: the shader of the surface reads it, or programs that
 * know more of the model. NULL: it does nothing. One that the geometry fills has no uniform, so a
 * connection counts.
 */
static const char *use_of(struct translation *t, uint32_t index)
{
    const struct source_input *source = &t->sources.items[index];
    if (!translate_is_authored(t, source))
        return NULL;
    bool is_geometry = source->is_connected && *source->port.defaultgeomprop;
    if (is_geometry
        || translate_surface_reads(t, 0, source->port.name, translate_uniforms(t, index)))
        return "changes this surface";
    if (strcmp(source->port.name, "displacement") == 0)
        return "moves the vertices";
    uint32_t definition = mxg_document_find_nodedef(t->document, t->surface);
    return translate_is_for_others(t, definition, source->port.name) ? "is for other programs"
                                                                     : NULL;
}

/* Warns about inputs that change the old surface and not the new one. */
static void report_losses(struct translation *t)
{
    const struct document *doc = &t->document->layer.doc;
    bool *stays = ARENA_ARRAY(t->arena, bool, t->sources.len + 1);
    for (uint32_t i = 0; i < t->inputs.len; i++)
        if (t->inputs.items[i].is_set && !*t->inputs.items[i].port.defaultgeomprop)
            mark_sources(t,
                         translate_build(t, t->chain.len,
                                         translate_output_name(t, t->inputs.items[i].port.name),
                                         TRANSLATE_ALL_INPUTS),
                         stays);
    for (uint32_t i = 0; i < t->sources.len; i++) {
        const struct source_input *source = &t->sources.items[i];
        const char *use = stays[i] || source->is_used ? NULL : use_of(t, i);
        if (use)
            diag_add(t->diags, DIAG_ID_translation_loss, doc_name_place(doc, source->element),
                     source->port.name,
                     str_text(doc->strings, doc_element(doc, t->surface)->category), use, t->model);
    }
}

static void translate_surface(struct translation *t, elem_id surface)
{
    const struct document *doc = &t->document->layer.doc;
    const char *category = str_text(doc->strings, doc_element(doc, surface)->category);
    t->surface = surface;
    if (strcmp(category, t->model) != 0 && translate_find_chain(t, category, t->model)
        && translate_is_sound(t)) {
        translate_make_draft(t, mxg_document_find_nodedef(t->document, surface));
        find_values(t);
        translate_geometry(t);
        translate_keep_for_others(t);
        translate_drop_idle(t);
        report_losses(t);
        translate_write(t);
        t->has_changed = true;
    }
    translate_forget_surface(t);
}

/* ---- All surfaces ---- */

/* The document's XML becomes the text of the result. */
static void finish(struct generation *g, struct translation *t)
{
    const struct diag_list *faults = &t->product->object.diagnostics.list;
    for (uint32_t i = 0; i < faults->items.len; i++)
        diag_repeat(t->diags, &faults->items.items[i]);
    size_t size;
    const char *text = mxg_document_xml(t->product, &size);
    translate_expect(t, text != NULL);
    g->result->text = arena_strndup(t->kept, text, size);
    g->result->text_size = size;
}

/* Variants, and layers that are nodegraphs, name inputs of the old model. */
static void tell_looks(const struct translation *t)
{
    const struct document *doc = &t->document->layer.doc;
    for (elem_id e = doc->root; e; e = doc_next_in_tree(doc, doc->root, e)) {
        enum element_kind kind = (enum element_kind)doc_element(doc, e)->kind;
        struct text path;
        if (kind != KIND_VARIANTASSIGN
            && (kind != KIND_MATERIALASSIGN || !doc_attr_value(doc, e, STR_nodegraph)))
            continue;
        text_init(&path, t->arena);
        doc_path(doc, e, '/', &path);
        diag_add(t->diags, DIAG_ID_translation_look, doc_name_place(doc, e), text_cstr(&path),
                 t->wanted);
    }
}

static void translate(struct generation *g)
{
    struct translation *t = g->user_data;
    t->diags = diags_of(g);
    t->kept = &g->result->object.arena;
    t->arena = &g->scratch;
    if (!translate_find_model(t))
        return;
    translate_definitions(t);
    translate_closures(t);
    if (!t->diags->num_errors)
        translate_each_surface(t, translate_surface);
    if (!t->diags->num_errors && t->replaced.len)
        translate_remove_remains(t);
    if (t->has_changed || t->replaced.len)
        tell_looks(t);
    if (!t->diags->num_errors)
        finish(g, t);
}

mxg_status mxg_translate(mxg_context *context, const mxg_document *document, const char *model,
                         mxg_result **out_result)
{
    if (out_result)
        *out_result = NULL;
    if (!context || !document || !model || !out_result)
        return MXG_ERROR_ARGUMENT;
    const mxg_document *origin = document;
    while (origin->origin)
        origin = origin->origin;
    struct translation t = {.context = context,
                            .library = (mxg_library *)origin->object.below,
                            .document = document,
                            .model = model,
                            .wanted = model};
    mxg_status status = generation_run(context, document, NULL, translate, &t, out_result);
    mxg_result_destroy(t.value);
    mxg_edit_destroy(t.draft_edit);
    mxg_document_destroy(t.draft);
    mxg_options_destroy(t.options);
    mxg_edit_destroy(t.edit);
    mxg_document_destroy(t.product);
    return status;
}
