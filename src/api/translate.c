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

void translate_report(const struct translation *t, enum diag_id id, const char *first,
                      const char *third)
{
    const struct document *doc = &t->document->layer.doc;
    diag_add(t->diags, id, doc_name_place(doc, t->surface), first, t->model, third);
}

/* Any number that is no special case. */
static bool general_value(void *user_data, const struct ir_graph *graph, ir_ref ref,
                          struct ir_value *out)
{
    (void)user_data;
    *out = (struct ir_value){.type = ir_type_of(graph, ref)};
    for (unsigned i = 0; i < ir_type_components(out->type); i++)
        out->w[i].f = 0.5f;
    return ir_type_scalar(out->type) == IR_TYPE_FLOAT;
}

/* A mode or a switch takes its value in the general case: BLEND, where the opacity is a texture. */
static bool choose_generally(struct translation *t, ir_ref root, struct translated_input *input)
{
    const struct ir_eval_env env = {.source = general_value};
    bool is_choice = input->value.type == VALUE_INTEGER || input->value.type == VALUE_BOOLEAN;
    if (is_choice && input->value.kind != OPERAND_CONSTANT
        && ir_eval(&t->value->graph, root, &env, t->arena, &input->value.value))
        input->value.kind = OPERAND_CONSTANT;
    return input->value.kind == OPERAND_CONSTANT;
}

void translate_repeat_errors(struct translation *t)
{
    const struct diag_list *list = &t->value->object.diagnostics.list;
    for (uint32_t i = 0; i < list->items.len; i++)
        if (list->items.items[i].severity == DIAG_ERROR)
            diag_repeat(t->diags, &list->items.items[i]);
}

void translate_set_input(struct translation *t, struct translated_input *input, ir_ref root)
{
    enum value_type type = value_type_of(input->port.type);
    if (!root || type == VALUE_NONE) {
        translate_repeat_errors(t);
        return;
    }
    const char *lacks = value_nodes_add(&t->nodes, &t->value->graph, root, type, &input->value);
    bool fits = !lacks && (choose_generally(t, root, input) || !input->port.uniform);
    if (lacks)
        translate_report(t, DIAG_ID_translation_op, input->port.name, lacks);
    else if (!fits)
        translate_report(t, DIAG_ID_translation_varies, input->port.name, input->port.value);
    input->is_set = fits;
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
 * True if the surface depends on an input as it is: the document sets it, and the shader reads it.
 * One that the geometry fills has no uniform, so a connection counts.
 */
static bool matters(struct translation *t, uint32_t index)
{
    const struct source_input *source = &t->sources.items[index];
    if (!translate_is_authored(t, source))
        return false;
    bool is_geometry = source->is_connected && *source->port.defaultgeomprop;
    return is_geometry
           || translate_surface_reads(t, 0, source->port.name, translate_uniforms(t, index));
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
        if (!stays[i] && !source->is_used && matters(t, i))
            diag_add(t->diags, DIAG_ID_translation_loss, doc_name_place(doc, source->element),
                     source->port.name,
                     str_text(doc->strings, doc_element(doc, t->surface)->category), t->model);
    }
}

void translate_forget_surface(struct translation *t)
{
    mxg_result_destroy(t->value);
    mxg_document_destroy(t->draft);
    t->value = NULL;
    t->draft = NULL;
    memset(&t->chain, 0, sizeof t->chain);
    memset(&t->sources, 0, sizeof t->sources);
    memset(&t->inputs, 0, sizeof t->inputs);
    memset(&t->closures, 0, sizeof t->closures);
    memset(&t->leaves, 0, sizeof t->leaves);
    arena_finish(t->arena);
}

bool translate_is_sound(struct translation *t)
{
    const struct document *doc = &t->document->layer.doc;
    const struct element *e = doc_element(doc, t->surface);
    const char *name = str_text(doc->strings, e->name);
    if (!e->name) {
        diag_add(t->diags, DIAG_ID_name_missing, doc_place(doc, t->surface),
                 str_text(doc->strings, e->category));
        return false;
    }
    if (!doc_is_name(name)) {
        diag_add(t->diags, DIAG_ID_translation_name, doc_name_place(doc, t->surface), name);
        return false;
    }
    bool builds = translate_can_build(t);
    if (!builds)
        translate_repeat_errors(t);
    return builds;
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
        translate_drop_idle(t);
        report_losses(t);
        translate_write(t);
    }
    translate_forget_surface(t);
}

/* ---- All surfaces ---- */

/* True for a node that is a surface and is not made of other surfaces. */
static bool is_surface(const struct translation *t, elem_id element)
{
    const struct document *doc = &t->document->layer.doc;
    const struct element *e = doc_element(doc, element);
    if (e->kind != KIND_NODE || doc_attr_value(doc, element, STR_type) != STR_surfaceshader)
        return false;
    bool is_second = e->name && doc_child(doc, e->parent, e->name) != element; /* of its name */
    bool is_made = false;
    for (elem_id child = e->first_child; child && !is_made; child = doc_element(doc, child)->next)
        is_made = doc_attr_value(doc, child, STR_type) == STR_surfaceshader;
    return !is_made && !is_second;
}

void translate_visit_surfaces(struct translation *t, elem_id parent,
                              void (*visit)(struct translation *t, elem_id surface))
{
    const struct document *doc = &t->document->layer.doc;
    for (elem_id e = doc_element(doc, parent)->first_child, next; e; e = next) {
        next = doc_element(doc, e)->next;
        if (is_surface(t, e))
            visit(t, e);
        else if (doc_element(doc, e)->kind == KIND_NODEGRAPH
                 && !doc_attr_value(doc, e, STR_nodedef))
            translate_visit_surfaces(t, e, visit);
    }
}

void translate_start_edit(struct translation *t)
{
    translate_expect(t, mxg_edit_create(t->context, t->library, t->document, NULL, &t->edit)
                            == MXG_OK);
}

void translate_commit_edit(struct translation *t)
{
    mxg_document *product = NULL;
    mxg_status status = mxg_edit_commit(t->edit, &product);
    mxg_edit_destroy(t->edit);
    t->edit = NULL;
    mxg_document_destroy(t->product);
    t->document = t->product = product;
    translate_expect(t, status != MXG_ERROR_MEMORY);
}

void translate_each_surface(struct translation *t,
                            void (*visit)(struct translation *t, elem_id surface))
{
    translate_start_edit(t);
    translate_visit_surfaces(t, t->document->layer.doc.root, visit);
    translate_commit_edit(t);
}

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

static void translate(struct generation *g)
{
    struct translation *t = g->user_data;
    t->diags = diags_of(g);
    t->kept = &g->result->object.arena;
    t->arena = &g->scratch;
    if (!translate_find_model(t))
        return;
    translate_closures(t);
    if (!t->diags->num_errors)
        translate_each_surface(t, translate_surface);
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
