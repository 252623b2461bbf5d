// SPDX-License-Identifier: Apache-2.0
/*
 * Passes over the surfaces of a document share this: which elements are surfaces, the edit that a
 * pass makes, the values of new inputs, and messages.
 */
#include "api/translate.h"

/* ---- Values ---- */

void translate_report(const struct translation *t, enum diag_id id, const char *first,
                      const char *third)
{
    const struct document *doc = &t->document->layer.doc;
    diag_add(t->diags, id, doc_name_place(doc, t->surface), first, t->model, third);
}

/* The number of the user. */
static bool general_value(void *user_data, const struct ir_graph *graph, ir_ref ref,
                          struct ir_value *out)
{
    const float *number = user_data;
    *out = (struct ir_value){.type = ir_type_of(graph, ref)};
    for (unsigned i = 0; i < ir_type_components(out->type); i++)
        out->w[i].f = *number;
    return ir_type_scalar(out->type) == IR_TYPE_FLOAT;
}

static bool has_default(const struct translation *t, const struct translated_input *input)
{
    return translate_is_default(&input->port, t->document->layer.doc.strings,
                                translate_text_of(t, &input->value));
}

/*
 * A mode or a switch takes its value in the general case: BLEND, where the opacity is a texture. It
 * may be another one above a threshold than below; the first that is no default serves both.
 */
static bool choose_generally(struct translation *t, ir_ref root, struct translated_input *input)
{
    static const float numbers[] = {0.5f, 0.000001f, 0.999999f}; /* none is a special case */
    bool is_choice = input->value.type == VALUE_INTEGER || input->value.type == VALUE_BOOLEAN;
    bool is_varying = input->value.kind != OPERAND_CONSTANT;
    for (size_t i = 0; is_choice && is_varying && i < sizeof numbers / sizeof *numbers; i++) {
        float number = numbers[i];
        const struct ir_eval_env env = {.source = general_value, .user_data = &number};
        if (!ir_eval(&t->value->graph, root, &env, t->arena, &input->value.value))
            break;
        input->value.kind = OPERAND_CONSTANT;
        if (!has_default(t, input))
            break;
    }
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
    const struct operand zero = value_zero(type); /* what an input without a default has */
    if (lacks)
        translate_report(t, DIAG_ID_translation_op, input->port.name, lacks);
    else if (!fits)
        translate_report(t, DIAG_ID_translation_varies, input->port.name,
                         *input->port.value ? input->port.value : translate_text_of(t, &zero));
    input->is_set = fits;
}

/* ---- A surface ---- */

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

/* ---- All surfaces ---- */

enum { READ_BY_SURFACE = 1, READ_BY_OTHER = 2 };

static void find_readers(struct translation *t)
{
    const struct document *doc = &t->document->layer.doc;
    t->readers = ARENA_ARRAY(t->kept, uint8_t, doc_num_elements(doc));
    for (elem_id e = doc->root; e; e = doc_next_in_tree(doc, doc->root, e)) {
        bool is_input = doc_element(doc, e)->kind == KIND_INPUT
                        && doc_attr_value(doc, e, STR_type) == STR_surfaceshader;
        elem_id source = is_input ? translate_find_source(t, e) : 0;
        if (!source)
            continue;
        str_id type = doc_attr_value(doc, doc_element(doc, e)->parent, STR_type);
        t->readers[source - doc->first_element] |=
            type == STR_surfaceshader ? READ_BY_SURFACE : READ_BY_OTHER;
    }
}

/* True for a surface that has its own place: not made of others, or not in others alone. */
static bool is_whole(const struct translation *t, elem_id element)
{
    const struct document *doc = &t->document->layer.doc;
    if (t->joins)
        return t->readers[element - doc->first_element] != READ_BY_SURFACE;
    for (elem_id e = doc_element(doc, element)->first_child; e; e = doc_element(doc, e)->next)
        if (doc_attr_value(doc, e, STR_type) == STR_surfaceshader)
            return false;
    return true;
}

/* True for a node of the type. */
static bool is_node(const struct translation *t, elem_id element, str_id type)
{
    const struct document *doc = &t->document->layer.doc;
    const struct element *e = doc_element(doc, element);
    if (e->kind != KIND_NODE || doc_attr_value(doc, element, STR_type) != type)
        return false;
    bool is_second = e->name && doc_child(doc, e->parent, e->name) != element; /* of its name */
    return !is_second && (type != STR_surfaceshader || is_whole(t, element));
}

static void visit_nodes(struct translation *t, elem_id parent, str_id type,
                        void (*visit)(struct translation *t, elem_id node))
{
    const struct document *doc = &t->document->layer.doc;
    for (elem_id e = doc_element(doc, parent)->first_child, next; e; e = next) {
        next = doc_element(doc, e)->next;
        if (is_node(t, e, type))
            visit(t, e);
        else if (doc_element(doc, e)->kind == KIND_NODEGRAPH
                 && !doc_attr_value(doc, e, STR_nodedef))
            visit_nodes(t, e, type, visit);
    }
}

void translate_visit_surfaces(struct translation *t,
                              void (*visit)(struct translation *t, elem_id surface))
{
    if (t->joins)
        find_readers(t);
    visit_nodes(t, t->document->layer.doc.root, STR_surfaceshader, visit);
}

void translate_visit_materials(struct translation *t,
                               void (*visit)(struct translation *t, elem_id material))
{
    visit_nodes(t, t->document->layer.doc.root, STR_material, visit);
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
    translate_visit_surfaces(t, visit);
    translate_commit_edit(t);
}
