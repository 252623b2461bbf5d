// SPDX-License-Identifier: Apache-2.0
/* Queries and changes of the tree during an upgrade. */
#include "document/upgrade.h"

#include <assert.h>
#include <stdarg.h>
#include <stdio.h>

static bool is_in_tree(const struct upgrade *u, elem_id element)
{
    while (element && element != u->root)
        element = doc_element(u->doc, element)->parent;
    return element != 0;
}

elem_id upgrade_first(struct upgrade *u)
{
    u->pass_end = u->doc->first_element + u->doc->elements.len;
    assert(u->first_added <= u->pass_end);
    assert(u->root < u->end && u->end <= u->first_added);
    return u->root;
}

elem_id upgrade_next(const struct upgrade *u, elem_id element)
{
    assert(element >= u->root && element < u->pass_end);
    do {
        element++;
        if (element == u->end && element < u->first_added)
            element = u->first_added;
    } while (element < u->pass_end && !is_in_tree(u, element));
    return element < u->pass_end ? element : 0;
}

str_id upgrade_word(struct upgrade *u, const char *text)
{
    return str_intern_z(u->doc->strings, text);
}

bool upgrade_is(const struct upgrade *u, str_id word, const char *text)
{
    return strcmp(str_text(u->doc->strings, word), text) == 0;
}

bool upgrade_is_category(const struct upgrade *u, elem_id element, const char *category)
{
    return upgrade_is(u, doc_element(u->doc, element)->category, category);
}

/* Before 1.34 a nodegraph was called <opgraph>. */
bool upgrade_is_node(const struct upgrade *u, elem_id element)
{
    const struct element *e = doc_element(u->doc, element);
    if (e->kind != KIND_NODE || !e->parent)
        return false;
    enum element_kind scope = (enum element_kind)doc_element(u->doc, e->parent)->kind;
    return scope == KIND_MATERIALX || scope == KIND_NODEGRAPH
           || upgrade_is_category(u, e->parent, "opgraph");
}

str_id upgrade_attr(const struct upgrade *u, elem_id element, const char *name)
{
    str_id id = str_find(u->doc->strings, name, strlen(name));
    return id ? doc_attr_value(u->doc, element, id) : STR_EMPTY;
}

elem_id upgrade_child(const struct upgrade *u, elem_id parent, const char *name)
{
    return doc_child(u->doc, parent, str_find(u->doc->strings, name, strlen(name)));
}

static void tell(struct upgrade *u, enum diag_id id, elem_id element, const char *format,
                 va_list args)
{
    char message[512];
    int len = snprintf(message, sizeof message, "1.%d: ", u->minor);
    assert(len > 0 && (size_t)len < sizeof message);
    vsnprintf(message + len, sizeof message - (size_t)len, format, args);
    diag_add(u->diags, id, doc_place(u->doc, element), message);
}

void upgrade_note(struct upgrade *u, elem_id element, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    tell(u, u->outdated ? DIAG_ID_outdated : DIAG_ID_upgraded, element, format, args);
    va_end(args);
}

void upgrade_tell_loss(struct upgrade *u, elem_id element, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    tell(u, DIAG_ID_upgrade_loss, element, format, args);
    va_end(args);
}

void upgrade_set_name(struct upgrade *u, elem_id element, str_id name)
{
    doc_set_name(u->doc, element, name);
    doc_index_element(u->doc, element);
}

void upgrade_move(struct upgrade *u, elem_id element, elem_id new_parent)
{
    doc_move_element(u->doc, element, new_parent);
    doc_index_element(u->doc, element);
}

str_id upgrade_free_name(struct upgrade *u, elem_id scope, const char *name)
{
    struct text text;
    text_init(&text, u->doc->arena);
    /* name, name2 … name9, then numbers that no other name has */
    for (uint32_t number = 1;; number++) {
        text.len = 0;
        text_str(&text, name);
        if (number > 1)
            text_u32(&text, number < 10 ? number : number + u->doc->elements.len);
        str_id id = str_intern(u->doc->strings, text.data, text.len);
        if (!doc_child(u->doc, scope, id))
            return id;
    }
}

elem_id upgrade_add_node(struct upgrade *u, elem_id before, const char *name, const char *category,
                         str_id type)
{
    struct document *doc = u->doc;
    elem_id scope = doc_element(doc, before)->parent;
    elem_id node = doc_add_like(doc, scope, upgrade_word(u, category),
                                upgrade_free_name(u, scope, name), before);
    doc_move_before(doc, node, before);
    doc_add_attr(doc, node, (struct attribute){.name = STR_type, .value = type});
    doc_index_element(doc, node);
    assert(doc_element(doc, node)->next == before);
    return node;
}

elem_id upgrade_add_input(struct upgrade *u, elem_id node, const char *name, str_id type,
                          str_id value)
{
    struct document *doc = u->doc;
    elem_id input = doc_add_like(doc, node, STR_input, upgrade_word(u, name), node);
    doc_add_attr(doc, input, (struct attribute){.name = STR_type, .value = type});
    if (value)
        doc_add_attr(doc, input, (struct attribute){.name = STR_value, .value = value});
    doc_index_element(doc, input);
    return input;
}

void upgrade_set_category(struct upgrade *u, elem_id node, const char *category)
{
    doc_set_category(u->doc, node, upgrade_word(u, category));
    doc_remove_attr(u->doc, node, STR_nodedef);
}

void upgrade_remove_input(struct upgrade *u, elem_id node, const char *name)
{
    elem_id input = upgrade_child(u, node, name);
    if (input)
        doc_remove_element(u->doc, input);
}

elem_id upgrade_scope(const struct upgrade *u, elem_id port)
{
    const struct element *e = doc_element(u->doc, port);
    if (e->kind == KIND_OUTPUT || !e->parent)
        return e->parent;
    elem_id scope = doc_element(u->doc, e->parent)->parent;
    return scope ? scope : e->parent;
}

elem_id upgrade_upstream(const struct upgrade *u, elem_id port)
{
    str_id name = doc_attr_value(u->doc, port, STR_nodename);
    elem_id scope = upgrade_scope(u, port);
    return name && scope ? doc_child(u->doc, scope, name) : 0;
}

/* The type of one output of a node with several. */
static str_id output_type(const struct upgrade *u, elem_id node, str_id output)
{
    elem_id declared = doc_child_of_kind(u->doc, node, KIND_OUTPUT, output);
    if (declared)
        return doc_attr_value(u->doc, declared, STR_type);
    const char *category = str_text(u->doc->strings, doc_element(u->doc, node)->category);
    if (strncmp(category, "separate", 8) == 0)
        return STR_float;
    return strcmp(category, "artistic_ior") == 0 ? STR_color3 : STR_EMPTY;
}

str_id upgrade_upstream_type(const struct upgrade *u, elem_id port)
{
    const struct document *doc = u->doc;
    elem_id node = upgrade_upstream(u, port), scope = upgrade_scope(u, port);
    str_id output = doc_attr_value(doc, port, STR_output);
    if (node) {
        str_id type = doc_attr_value(doc, node, STR_type);
        return type == STR_multioutput || !type ? output_type(u, node, output) : type;
    }
    str_id graph_name = doc_attr_value(doc, port, STR_nodegraph),
           interface = doc_attr_value(doc, port, STR_interfacename);
    elem_id source = 0;
    if (graph_name) {
        elem_id graph = doc_child(doc, u->root, graph_name);
        source = graph && output ? doc_child(doc, graph, output) : 0;
        for (elem_id e = graph && !output ? doc_element(doc, graph)->first_child : 0; e && !source;
             e = doc_element(doc, e)->next)
            source = doc_element(doc, e)->kind == KIND_OUTPUT ? e : 0;
    } else if (interface && scope) {
        elem_id nodedef = doc_child(doc, u->root, doc_attr_value(doc, scope, STR_nodedef));
        source = doc_child(doc, scope, interface);
        source = source || !nodedef ? source : doc_child(doc, nodedef, interface);
    }
    return source ? doc_attr_value(doc, source, STR_type) : STR_EMPTY;
}

void upgrade_connect(struct upgrade *u, elem_id port, elem_id node, const char *output)
{
    doc_remove_attr(u->doc, port, STR_value);
    doc_disconnect(u->doc, port);
    doc_set_attr(u->doc, port, STR_nodename, doc_element(u->doc, node)->name);
    if (output)
        doc_set_attr(u->doc, port, STR_output, upgrade_word(u, output));
}

void upgrade_keep_numbers(struct upgrade *u, elem_id input)
{
    bool is_color = doc_type_is_color(doc_type_of(doc_attr_value(u->doc, input, STR_type)));
    if (is_color && doc_attr(u->doc, input, STR_value)
        && doc_inherited_attr(u->doc, input, STR_colorspace))
        doc_set_attr(u->doc, input, STR_colorspace, STR_none);
}

void upgrade_copy_input(struct upgrade *u, elem_id source, elem_id node, const char *name,
                        const char *type)
{
    struct document *doc = u->doc;
    if (!source)
        return;
    elem_id input = upgrade_child(u, node, name);
    if (!input) {
        input = doc_add_like(doc, node, STR_input, upgrade_word(u, name), source);
        doc_index_element(doc, input);
    }
    for (uint32_t i = 0; i < doc_element(doc, source)->num_attrs; i++) {
        struct attribute attr = doc_attrs(doc, source)[i];
        if (attr.name != STR_channels)
            doc_set_attr(doc, input, attr.name, attr.value);
    }
    if (type)
        doc_set_attr(doc, input, STR_type, upgrade_word(u, type));
}
