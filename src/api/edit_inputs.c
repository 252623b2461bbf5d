// SPDX-License-Identifier: Apache-2.0
/* Values and connections of inputs in an edit. */
#include "api/edit.h"

#include "base/num.h"

#include <math.h>

/* ---- Inputs ---- */

/* Checks that `name` is an input of the node, or may become one. */
static bool check_input(struct edit_change *c)
{
    if (!edit_check_element(c, &c->element, false) || !edit_check_name(c, "input", c->name))
        return false;
    elem_id input = edit_child(c->edit, c->element, c->name);
    if (input && doc_element(edit_tree(c->edit), input)->kind != KIND_INPUT)
        edit_fail(c, "'%s' is not an input", c->name);
    return !c->failed && (input || edit_check_room(c, 1));
}

/* The input, with its type. `type` NULL keeps the type of an input that is there. */
static elem_id make_input(struct edit_change *c, const char *type)
{
    struct document *doc = edit_tree(c->edit);
    elem_id input = edit_child(c->edit, c->element, c->name);
    if (!input)
        return edit_add(c, c->element, "input", c->name, type);
    if (type) {
        doc_set_attr(doc, input, STR_type, edit_word(c, type));
        doc_index_change(doc, input);
    }
    return input;
}

void edit_view(const mxg_edit *edit, struct library *out)
{
    const mxg_document *document = edit->document;
    *out = document->layer;
    if (document->origin)
        library_share(out, &document->origin->layer);
}

uint32_t edit_find_definition(const struct edit_change *c, elem_id node, struct library *view)
{
    struct diag_list unheard;
    diag_list_init_unheard(&unheard, &c->edit->document->object.arena);
    edit_view(c->edit, view);
    return doc_element(&view->doc, node)->kind == KIND_NODE ? library_match(view, node, &unheard)
                                                            : LIBRARY_NONE;
}

/* The type of a port of a definition; "": there is no such port. */
static const char *port_type(const struct library *view, uint32_t nodedef, int port)
{
    return port < 0
               ? ""
               : str_text(&view->strings,
                          library_type_name(view, library_ports(view, nodedef, NULL)[port].type));
}

static const char *type_by_definition(const struct edit_change *c)
{
    struct library view;
    uint32_t nodedef = edit_find_definition(c, c->element, &view);
    str_id name = str_find(&view.strings, c->name, strlen(c->name));
    return nodedef == LIBRARY_NONE
               ? ""
               : port_type(&view, nodedef, library_find_input(&view, nodedef, name));
}

/* A suggestion of an input of the definition, as diag_guess_text gives it. */
static const char *suggest_input(const struct edit_change *c)
{
    struct library view;
    uint32_t nodedef = edit_find_definition(c, c->element, &view);
    struct diag_list list; /* for the suggestion */
    diag_list_init(&list, &c->edit->document->object.arena);
    struct diag_guess guess;
    if (nodedef == LIBRARY_NONE || !diag_guess_begin(&guess, &list, c->name))
        return "";
    int num_inputs = library_nodedef(&view, nodedef)->num_inputs;
    for (int i = 0; i < num_inputs; i++)
        diag_guess_add(&guess,
                       str_text(&view.strings, library_ports(&view, nodedef, NULL)[i].name));
    return diag_guess_text(&guess);
}

/* The name of the type of the input: that of the change, or that of the document. */
static const char *type_name(const struct edit_change *c)
{
    const struct document *doc = edit_tree(c->edit);
    elem_id input = edit_child(c->edit, c->element, c->name);
    return c->type ? c->type : str_text(doc->strings, doc_attr_value(doc, input, STR_type));
}

/* Gives the change the type of its input. Fails if the input is new and has no type. */
static doc_type find_type(struct edit_change *c)
{
    const struct document *doc = edit_tree(c->edit);
    elem_id input = edit_child(c->edit, c->element, c->name);
    if (!c->type && !input)
        c->type = type_by_definition(c);
    const char *type = type_name(c);
    if (!*type)
        edit_fail(c, "'%s' has no input '%s'%s; a new one needs its type",
                  edit_label(c->edit, c->element), c->name, suggest_input(c));
    return doc_type_of(str_find(doc->strings, type, strlen(type)));
}

static void set_value(void *arg)
{
    struct edit_change *c = arg;
    struct document *doc = edit_tree(c->edit);
    if (!check_input(c) || !edit_check_text(c, "type", c->type)
        || !edit_check_text(c, "value", c->text))
        return;
    doc_type type = find_type(c);
    if (!c->text)
        edit_fail(c, "the value of '%s' is missing", c->name);
    if (!c->failed && !doc_value_is_valid(type, c->text, strlen(c->text)))
        edit_fail(c, "'%s' is no value of '%s', whose type is %s", c->text, c->name, type_name(c));
    if (c->failed)
        return;
    elem_id input = make_input(c, c->type);
    doc_disconnect(doc, input);
    doc_set_attr(doc, input, STR_value, edit_word(c, c->text));
}

mxg_status mxg_edit_set_value(mxg_edit *edit, mxg_element node, const char *input, const char *type,
                              const char *value)
{
    struct edit_change change = {
        .edit = edit, .element = node, .name = input, .type = type, .text = value};
    return edit ? edit_run(&change, set_value) : MXG_ERROR_ARGUMENT;
}

/* The shortest text that reads as the same numbers. */
static void write_numbers(const struct edit_change *c, doc_type type, struct text *out)
{
    for (uint32_t i = 0; i < c->num_numbers; i++) {
        text_str(out, i ? ", " : "");
        if (type == DOC_TYPE_boolean)
            text_str(out, c->numbers[i] != 0 ? "true" : "false");
        else if (type == DOC_TYPE_integer)
            text_fmt(out, "%.0f", (double)c->numbers[i]);
        else
            text_float(out, c->numbers[i]);
    }
}

static void set_numbers(void *arg)
{
    struct edit_change *c = arg;
    if (!check_input(c) || !edit_check_text(c, "type", c->type))
        return;
    doc_type type = find_type(c);
    uint32_t num = type == DOC_TYPE_boolean ? 1 : doc_type_components(type);
    if (!c->numbers)
        edit_fail(c, "the numbers of '%s' are missing", c->name);
    if (!c->failed && (!num || num != c->num_numbers))
        edit_fail(c, "the type of '%s' is %s, which does not have %u component%s", c->name,
                  type_name(c), (unsigned)c->num_numbers, c->num_numbers == 1 ? "" : "s");
    for (uint32_t i = 0; !c->failed && i < num; i++)
        if (!isfinite(c->numbers[i]))
            edit_fail(c, "a value of '%s' is infinite or not a number", c->name);
        else if (type == DOC_TYPE_boolean && c->numbers[i] != 0 && c->numbers[i] != 1)
            edit_fail(c, "the boolean '%s' is 0 or 1 as a number", c->name);
        else if (type == DOC_TYPE_integer && !num_is_exact_integer(c->numbers[i]))
            edit_fail(c,
                      "the integer '%s' has a fraction, or more digits than a float; "
                      "mxg_edit_set_value takes it as text",
                      c->name);
    if (c->failed)
        return;
    struct text text;
    text_init(&text, &c->edit->document->object.arena);
    write_numbers(c, type, &text);
    c->text = text_cstr(&text);
    set_value(c);
}

mxg_status mxg_edit_set_numbers(mxg_edit *edit, mxg_element node, const char *input,
                                const char *type, const float *values, uint32_t num_values)
{
    struct edit_change change = {.edit = edit,
                                 .element = node,
                                 .name = input,
                                 .type = type,
                                 .numbers = values,
                                 .num_numbers = num_values};
    return edit ? edit_run(&change, set_numbers) : MXG_ERROR_ARGUMENT;
}

/* ---- Connections ---- */

/* The attribute with which a port in `scope` names `from`; 0 after an error. */
static str_id connecting_attr(struct edit_change *c, elem_id scope)
{
    const struct document *doc = edit_tree(c->edit);
    const struct element *from = doc_element(doc, c->other);
    bool is_beside = from->parent == scope;
    if (from->kind == KIND_NODE && is_beside)
        return STR_nodename;
    if (from->kind == KIND_NODEGRAPH && (is_beside || from->parent == doc->root))
        return STR_nodegraph;
    if (from->kind == KIND_INPUT && from->parent == scope
        && doc_element(doc, scope)->kind == KIND_NODEGRAPH)
        return STR_interfacename;
    edit_fail(c,
              "'%s' is no node or nodegraph beside the port, and no input of the graph around it",
              edit_label(c->edit, c->other));
    return 0;
}

/* The type of an output of a node, by its definition; "" if that is unknown. */
static const char *output_type(const struct edit_change *c)
{
    struct library view;
    uint32_t nodedef = edit_find_definition(c, c->other, &view);
    str_id name = c->text ? str_find(&view.strings, c->text, strlen(c->text)) : STR_EMPTY;
    int output = nodedef == LIBRARY_NONE ? -1 : library_find_output(&view, nodedef, name);
    return output < 0
               ? ""
               : port_type(&view, nodedef, library_nodedef(&view, nodedef)->num_inputs + output);
}

const char *edit_source_type(const struct edit_change *c)
{
    const struct document *doc = edit_tree(c->edit);
    elem_id typed = c->other;
    if (doc_element(doc, c->other)->kind == KIND_NODEGRAPH) {
        typed = c->text ? edit_child(c->edit, c->other, c->text)
                        : doc_outputs(doc, c->other, STR_EMPTY).first;
    }
    str_id type = typed ? doc_attr_value(doc, typed, STR_type) : STR_EMPTY;
    return doc_type_of(type) == DOC_TYPE_multioutput ? output_type(c)
                                                     : str_text(doc->strings, type);
}

static void connect(void *arg)
{
    struct edit_change *c = arg;
    struct document *doc = edit_tree(c->edit);
    if (!edit_check_element(c, &c->element, false) || !edit_check_element(c, &c->other, false)
        || !edit_check_text(c, "output", c->text) || (c->name && !check_input(c)))
        return;
    if (!c->name && doc_element(doc, c->element)->kind != KIND_OUTPUT) {
        edit_fail(c, "without an input the element to connect is an <output>");
        return;
    }
    str_id attr = connecting_attr(c, doc_element(doc, c->element)->parent);
    const char *type = attr ? edit_source_type(c) : "";
    if (!attr)
        return;
    if (!*type) {
        if (c->text)
            edit_fail(c, "the type of output '%s' of '%s' is unknown", c->text,
                      edit_label(c->edit, c->other));
        else
            edit_fail(c, "the type of '%s' is unknown; name one of its outputs",
                      edit_label(c->edit, c->other));
        return;
    }
    elem_id port = c->name ? make_input(c, type) : c->element;
    doc_disconnect(doc, port);
    doc_remove_attr(doc, port, STR_value);
    doc_set_attr(doc, port, attr, doc_element(doc, c->other)->name);
    if (c->text)
        doc_set_attr(doc, port, STR_output, edit_word(c, c->text));
    doc_index_change(doc, port);
}

mxg_status mxg_edit_connect_input(mxg_edit *edit, mxg_element node, const char *input,
                                  mxg_element from, const char *output)
{
    struct edit_change change = {
        .edit = edit, .element = node, .name = input, .other = from, .text = output};
    return edit ? edit_run(&change, connect) : MXG_ERROR_ARGUMENT;
}
