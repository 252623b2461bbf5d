// SPDX-License-Identifier: Apache-2.0
/*
 * A node that inherits from another of its category has the inputs and tokens of that one, unless
 * it has its own (specification, "Shader Nodes"). It gets copies of them, and loses the attribute,
 * so everybody else sees nodes without inheritance.
 *
 * A node in a nodegraph may inherit from one at the root. Its inputs can read only what is in the
 * nodegraph (specification, "Custom Node Definition Using Node Graphs"), so a connection at the
 * root does not come along.
 */
#include "document/document.h"

enum { MAX_ANCESTORS = 256 };

/* The node that a node inherits from: beside it, or at the top; 0: none. */
static elem_id base_of(const struct document *doc, elem_id node)
{
    str_id name = doc_attr_value(doc, node, STR_inherit);
    elem_id beside =
        name ? doc_child_of_kind(doc, doc_element(doc, node)->parent, KIND_NODE, name) : 0;
    return beside || !name ? beside : doc_child_of_kind(doc, doc->root, KIND_NODE, name);
}

/* Gives an element, which lacks it, an attribute of another one, with its place. */
static void copy_attr(struct document *doc, elem_id element, elem_id owner, str_id name)
{
    struct attribute attr = *doc_attr(doc, owner, name);
    const struct element *to = doc_element(doc, element), *from = doc_element(doc, owner);
    int64_t delta = (int64_t)from->line + attr.line_delta - to->line;
    bool is_near = from->file == to->file && delta >= INT16_MIN && delta <= INT16_MAX;
    attr.line_delta = (int16_t)(is_near ? delta : 0);
    attr.column = is_near ? attr.column : 0;
    doc_add_attr(doc, element, attr);
}

/* True if an attribute of what is around a value counts for the value. */
static bool counts_for(const struct document *doc, elem_id input, str_id attr)
{
    doc_type type = doc_type_of(doc_attr_value(doc, input, STR_type));
    bool is_file = type == DOC_TYPE_filename;
    return attr == STR_fileprefix
               ? is_file
               : is_file || !(doc_type_is_colorless(type) || doc_is_connected(doc, input));
}

static void copy_value(struct document *doc, elem_id node, elem_id source)
{
    static const str_id inherited[] = {STR_colorspace, STR_fileprefix};
    const struct element *from = doc_element(doc, source);
    elem_id copy = doc_add_like(doc, node, from->category, from->name, source);
    doc_index_element(doc, copy);
    for (uint32_t i = 0; i < doc_element(doc, source)->num_attrs; i++) {
        struct attribute attr = doc_attrs(doc, source)[i];
        doc_add_attr(doc, copy, attr);
    }
    for (size_t i = 0; i < sizeof inherited / sizeof *inherited; i++) {
        elem_id owner = doc_attr_owner(doc, source, inherited[i]);
        str_id value = owner ? doc_attr_value(doc, owner, inherited[i]) : STR_EMPTY;
        if (value == doc_inherited_attr(doc, copy, inherited[i])
            || !counts_for(doc, source, inherited[i]))
            continue;
        if (value)
            copy_attr(doc, copy, owner, inherited[i]);
        else
            doc_set_attr(doc, copy, inherited[i],
                         inherited[i] == STR_colorspace ? STR_none : STR_EMPTY);
    }
}

/* A token "[name]" of a file that a nodegraph replaces by its own; 0: there is none. */
static str_id replaced_token(const struct document *doc, elem_id node, elem_id source)
{
    const char *text = str_text(doc->strings, doc_attr_value(doc, source, STR_value));
    bool is_file = doc_attr_value(doc, source, STR_type) == STR_filename;
    while (is_file && (text = strchr(text, '[')) != NULL) {
        size_t len = strcspn(++text, "]");
        str_id name = text[len] ? str_find(doc->strings, text, len) : STR_EMPTY;
        bool is_own = doc_child(doc, doc_element(doc, source)->parent, name) != 0;
        elem_id graph = doc_element(doc, node)->parent;
        if (!is_own && doc_child_of_kind(doc, graph, KIND_TOKEN, name))
            return name;
    }
    return STR_EMPTY;
}

/* The element that a value of a node at the root reads, and a node in a graph cannot; 0: none. */
static str_id lost_source(const struct document *doc, elem_id node, elem_id source)
{
    elem_id graph = doc_element(doc, node)->parent;
    str_id other = doc_attr_value(doc, source, STR_nodegraph);
    if (graph == doc_element(doc, doc_element(doc, source)->parent)->parent)
        return STR_EMPTY;
    if (doc_attr_value(doc, source, STR_nodename))
        return doc_attr_value(doc, source, STR_nodename);
    if (doc_attr_value(doc, source, STR_interfacename))
        return doc_attr_value(doc, source, STR_interfacename);
    if (other) /* nodegraphs of the root can be read anywhere */
        return doc_child(doc, graph, other) ? other : STR_EMPTY;
    return replaced_token(doc, node, source);
}

/* True if a node between a node and its base has the value, so that the base's own is not told. */
static bool has_nearer(const struct document *doc, elem_id node, elem_id base, elem_id source)
{
    elem_id at = base_of(doc, node);
    while (at != base && !doc_child(doc, at, doc_element(doc, source)->name))
        at = base_of(doc, at);
    return at != base;
}

static void report_lost(const struct document *doc, elem_id node, elem_id source, str_id lost,
                        struct diag_list *diags)
{
    const char *value = doc_name(doc, source), *heir = doc_name(doc, node);
    diag_add(diags, DIAG_ID_inherit_scope, doc_attr_place(doc, node, STR_inherit), heir, value,
             doc_name(doc, doc_element(doc, source)->parent), str_text(doc->strings, lost),
             doc_name(doc, doc_element(doc, node)->parent), heir, value);
    diag_add(diags, DIAG_ID_defined_here, doc_name_place(doc, source), value);
}

/* Without `diags` the values that cannot come along are told of another node. */
static void take_values(struct document *doc, elem_id node, elem_id base, struct diag_list *diags)
{
    for (elem_id e = doc_element(doc, base)->first_child; e && !doc_is_full(doc);
         e = doc_element(doc, e)->next) {
        enum element_kind kind = (enum element_kind)doc_element(doc, e)->kind;
        if ((kind != KIND_INPUT && kind != KIND_TOKEN)
            || doc_child(doc, node, doc_element(doc, e)->name))
            continue;
        str_id lost = lost_source(doc, node, e);
        if (!lost)
            copy_value(doc, node, e);
        else if (diags && !has_nearer(doc, node, base, e))
            report_lost(doc, node, e, lost, diags);
    }
}

static const char *category_of(const struct document *doc, elem_id element)
{
    return str_text(doc->strings, doc_element(doc, element)->category);
}

static void inherit(struct document *doc, elem_id node, struct diag_list *diags)
{
    elem_id at = node, base, scope = doc_element(doc, node)->parent;
    bool is_told = (base = base_of(doc, node)) != 0 && doc_element(doc, base)->parent == scope;
    for (unsigned depth = 0; (base = base_of(doc, at)) != 0; depth++, at = base) {
        if (base == node || depth == MAX_ANCESTORS) {
            diag_add(diags, DIAG_ID_inherit_cycle, doc_attr_place(doc, node, STR_inherit),
                     doc_name(doc, node));
            return;
        }
        if (doc_element(doc, base)->category != doc_element(doc, node)->category) {
            if (at == node) /* else `at` has the report */
                diag_add(diags, DIAG_ID_inherit_category, doc_attr_place(doc, node, STR_inherit),
                         doc_name(doc, node), category_of(doc, node), doc_name(doc, base),
                         category_of(doc, base));
            return;
        }
        take_values(doc, node, base, is_told ? NULL : diags);
        vec_push(doc->arena, &doc->bases, base);
    }
    if (at == node)
        diag_add(diags, DIAG_ID_inherit_missing, doc_attr_place(doc, node, STR_inherit),
                 doc_name(doc, node),
                 str_text(doc->strings, doc_attr_value(doc, node, STR_inherit)));
}

bool doc_inherits_values(const struct document *doc, elem_id element)
{
    const struct element *e = doc_element(doc, element);
    return e->kind == KIND_NODE && e->parent && doc_attr_value(doc, element, STR_inherit);
}

void doc_inherit_values(struct document *doc, struct diag_list *diags)
{
    VEC(elem_id) heirs = {0};
    doc->bases.len = 0;
    for (uint32_t i = 0; i < doc->elements.len; i++) {
        elem_id e = doc->first_element + i;
        if (doc_inherits_values(doc, e))
            vec_push(doc->arena, &heirs, e);
    }
    for (uint32_t i = 0; i < heirs.len; i++)
        inherit(doc, heirs.items[i], diags);
    for (uint32_t i = 0; i < heirs.len; i++)
        doc_remove_attr(doc, heirs.items[i], STR_inherit);
}
