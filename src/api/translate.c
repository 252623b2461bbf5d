// SPDX-License-Identifier: Apache-2.0
/*
 * mxg_translate and mxg_translate_joined: surfaces of one model as surfaces of another, with graphs
 * of their inputs.
 */
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

/* The output of the last translation whose name begins and ends so; NULL: there is none. */
static const char *find_output(const struct translation *t, const char *start, const char *end)
{
    mxg_nodedef info = {.size = sizeof info};
    const char *found = NULL;
    mxg_document_nodedef(t->document, vec_last(&t->chain), &info);
    for (uint32_t i = 0; i < info.num_outputs && !found; i++) {
        mxg_port port = {.size = sizeof port};
        mxg_document_port(t->document, vec_last(&t->chain), info.num_inputs + i, &port);
        size_t length = strlen(port.name), longest = strlen(start) + strlen(end);
        if (length > longest && strncmp(port.name, start, strlen(start)) == 0
            && strcmp(port.name + length - strlen(end), end) == 0)
            found = port.name;
    }
    return found;
}

static const char *joined(const struct translation *t, const char *first, const char *second)
{
    struct text text;
    text_init(&text, t->arena);
    text_fmt(&text, "%s%s", first, second);
    return text_cstr(&text);
}

static bool varies(struct translation *t, const char *output)
{
    ir_ref root = translate_build(t, t->chain.len, output, TRANSLATE_CONNECTED);
    return root && !ir_is_const(&t->value->graph, root);
}

/*
 * The output that has the value of an input; NULL: it keeps its default. Where the value of a
 * uniform input U varies, and an output "U_in_X_out" takes it in, this output is the value of X.
 */
static const char *output_for(struct translation *t, const mxg_port *port)
{
    mxg_port found;
    const char *output = translate_output_name(t, port->name);
    if (*port->defaultgeomprop
        || !translate_find_port(t, vec_last(&t->chain), output, true, &found))
        return NULL;
    const char *end = joined(t, "_in_", output), *more = find_output(t, "", end);
    const char *uniform = more ? arena_strndup(t->arena, more, strlen(more) - strlen(end)) : NULL;
    if (uniform && varies(t, translate_output_name(t, uniform)))
        return more;
    bool is_taken_in = port->uniform && find_output(t, joined(t, port->name, "_in_"), "_out");
    return is_taken_in && varies(t, output) ? NULL : output;
}

static void find_values(struct translation *t)
{
    mxg_nodedef info = {.size = sizeof info};
    mxg_document_nodedef(t->document, t->definition, &info);
    t->inputs.len = 0;
    t->nodes = (struct value_nodes){.arena = t->arena, .leaf = find_leaf, .user_data = t};
    for (uint32_t i = 0; i < info.num_inputs; i++) {
        struct translated_input input = {.port.size = sizeof input.port};
        mxg_document_port(t->document, t->definition, i, &input.port);
        input.output = output_for(t, &input.port);
        if (input.output)
            translate_set_input(
                t, &input, translate_build(t, t->chain.len, input.output, TRANSLATE_CONNECTED));
        vec_push(t->arena, &t->inputs, input);
    }
}

static void translate_surface(struct translation *t, elem_id surface)
{
    const struct document *doc = &t->document->layer.doc;
    const char *category = str_text(doc->strings, doc_element(doc, surface)->category);
    t->surface = surface;
    if (strcmp(category, t->model) != 0 && translate_find_chain(t, category, t->model)
        && translate_is_sound(t)) {
        uint32_t definition = mxg_document_find_nodedef(t->document, surface);
        translate_read_sources(t, definition);
        translate_make_draft(t, definition);
        find_values(t);
        translate_geometry(t);
        translate_keep_for_others(t);
        translate_drop_idle(t);
        translate_report_losses(t);
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

static mxg_status run(mxg_context *context, const mxg_document *document, const char *model,
                      bool joins, mxg_result **out_result)
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
                            .wanted = model,
                            .joins = joins};
    mxg_status status = generation_run(context, document, NULL, translate, &t, out_result);
    mxg_result_destroy(t.value);
    mxg_edit_destroy(t.draft_edit);
    mxg_document_destroy(t.draft);
    mxg_document_destroy(t.whole_draft);
    mxg_options_destroy(t.options);
    mxg_edit_destroy(t.edit);
    mxg_document_destroy(t.product);
    return status;
}

mxg_status mxg_translate(mxg_context *context, const mxg_document *document, const char *model,
                         mxg_result **out_result)
{
    return run(context, document, model, false, out_result);
}

mxg_status mxg_translate_joined(mxg_context *context, const mxg_document *document,
                                const char *model, mxg_result **out_result)
{
    return run(context, document, model, true, out_result);
}
