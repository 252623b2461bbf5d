// SPDX-License-Identifier: Apache-2.0
/*
 * A node that inherits from another of its category has the inputs and tokens of that one, unless
 * it has its own (specification, "Shader Nodes"). It gets copies of them, and loses the attribute,
 * so everybody else sees nodes without inheritance.
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

static void copy_value(struct document *doc, elem_id node, elem_id source)
{
    static const str_id inherited[] = {STR_colorspace, STR_fileprefix};
    const struct element *from = doc_element(doc, source);
    elem_id copy = doc_add_like(doc, node, from->category, from->name, source);
    doc_index_element(doc, copy);
    for (uint32_t i = 0; i < doc_element(doc, source)->num_attrs; i++) {
        struct attribute attr = doc_attrs(doc, source)[i];
        doc_set_attr(doc, copy, attr.name, attr.value);
    }
    for (size_t i = 0; i < sizeof inherited / sizeof *inherited; i++) {
        str_id value = doc_inherited_attr(doc, source, inherited[i]);
        if (value != doc_inherited_attr(doc, copy, inherited[i]))
            doc_set_attr(doc, copy, inherited[i],
                         !value && inherited[i] == STR_colorspace ? STR_none : value);
    }
}

static void take_values(struct document *doc, elem_id node, elem_id base)
{
    for (elem_id e = doc_element(doc, base)->first_child; e && !doc_is_full(doc);
         e = doc_element(doc, e)->next) {
        enum element_kind kind = (enum element_kind)doc_element(doc, e)->kind;
        if ((kind == KIND_INPUT || kind == KIND_TOKEN)
            && !doc_child(doc, node, doc_element(doc, e)->name))
            copy_value(doc, node, e);
    }
}

static const char *name_of(const struct document *doc, elem_id element)
{
    return str_text(doc->strings, doc_element(doc, element)->name);
}

static const char *category_of(const struct document *doc, elem_id element)
{
    return str_text(doc->strings, doc_element(doc, element)->category);
}

static void inherit(struct document *doc, elem_id node, struct diag_list *diags)
{
    elem_id at = node, base;
    for (unsigned depth = 0; (base = base_of(doc, at)) != 0; depth++, at = base) {
        if (base == node || depth == MAX_ANCESTORS) {
            diag_add(diags, DIAG_ID_inherit_cycle, doc_attr_place(doc, node, STR_inherit),
                     name_of(doc, node));
            return;
        }
        if (doc_element(doc, base)->category != doc_element(doc, node)->category) {
            if (at == node) /* else `at` has the report */
                diag_add(diags, DIAG_ID_inherit_category, doc_attr_place(doc, node, STR_inherit),
                         name_of(doc, node), category_of(doc, node), name_of(doc, base),
                         category_of(doc, base));
            return;
        }
        take_values(doc, node, base);
    }
    if (at == node)
        diag_add(diags, DIAG_ID_inherit_missing, doc_attr_place(doc, node, STR_inherit),
                 name_of(doc, node),
                 str_text(doc->strings, doc_attr_value(doc, node, STR_inherit)));
}

void doc_inherit_values(struct document *doc, struct diag_list *diags)
{
    VEC(elem_id) heirs = {0};
    for (uint32_t i = 0; i < doc->elements.len; i++) {
        elem_id e = doc->first_element + i;
        if (doc_element(doc, e)->kind == KIND_NODE && doc_element(doc, e)->parent
            && doc_attr_value(doc, e, STR_inherit))
            vec_push(doc->arena, &heirs, e);
    }
    for (uint32_t i = 0; i < heirs.len; i++)
        inherit(doc, heirs.items[i], diags);
    for (uint32_t i = 0; i < heirs.len; i++)
        doc_remove_attr(doc, heirs.items[i], STR_inherit);
}
