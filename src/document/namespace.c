// SPDX-License-Identifier: Apache-2.0
/*
 * Resolves "MaterialX Namespaces" statically: definitions get their qualified names, and references
 * inside a namespace, which use the short name, get the qualified name of their target. A name of
 * the namespace takes precedence over a global one.
 */
#include "document/document.h"

#include <assert.h>

struct qualifier {
    struct document *doc;
    str_id namespace;
    VEC(str_id) nodes; /* categories with a namespace that nodedefs define, in all layers */
    struct text scratch;
};

static bool is_qualified(const struct document *doc, str_id name)
{
    return memchr(str_text(doc->strings, name), ':', str_len(doc->strings, name)) != NULL;
}

static void print_qualified(struct qualifier *q, const char *name, size_t len)
{
    text_mem(&q->scratch, str_text(q->doc->strings, q->namespace),
             str_len(q->doc->strings, q->namespace));
    text_char(&q->scratch, ':');
    text_mem(&q->scratch, name, len);
}

static str_id add_qualified(struct qualifier *q, str_id name)
{
    q->scratch.len = 0;
    print_qualified(q, str_text(q->doc->strings, name), str_len(q->doc->strings, name));
    return str_intern(q->doc->strings, q->scratch.data, q->scratch.len);
}

/* The qualified name if an element has it, otherwise 0. */
static str_id find_qualified(struct qualifier *q, const char *name, size_t len)
{
    q->scratch.len = 0;
    print_qualified(q, name, len);
    return str_find(q->doc->strings, q->scratch.data, q->scratch.len);
}

static bool is_top_level(const struct document *doc, str_id name)
{
    for (; doc; doc = doc->base)
        if (doc_child(doc, doc->root, name))
            return true;
    return false;
}

static void qualify_definition(struct qualifier *q, elem_id element)
{
    struct document *doc = q->doc;
    assert(doc_element(doc, element)->parent == doc->root);
    const struct element *e = doc_element(doc, element);
    if (e->name && !is_qualified(doc, e->name))
        doc_set_name(doc, element, add_qualified(q, e->name));
    str_id node = e->kind == KIND_NODEDEF ? doc_attr_value(doc, element, STR_node) : STR_EMPTY;
    if (node && !is_qualified(doc, node))
        doc_set_attr(doc, element, STR_node, add_qualified(q, node));
}

static bool is_category(const struct qualifier *q, str_id name)
{
    for (uint32_t i = 0; i < q->nodes.len; i++)
        if (q->nodes.items[i] == name)
            return true;
    return false;
}

/*
 * Replaces the names of a list that exist in the namespace: those of categories in `node`, of
 * elements otherwise.
 */
static void qualify_reference(struct qualifier *q, elem_id element, str_id attr)
{
    struct document *doc = q->doc;
    str_id value = doc_attr_value(doc, element, attr);
    const char *text = str_text(doc->strings, value), *end = text + str_len(doc->strings, value);
    struct text list;
    text_init(&list, doc->arena);
    bool changed = false;
    while (text < end) {
        size_t separator = strspn(text, ", "), len = strcspn(text + separator, ", ");
        str_id qualified = len ? find_qualified(q, text + separator, len) : STR_EMPTY;
        bool found =
            qualified
            && (attr == STR_node ? is_category(q, qualified) : is_top_level(doc, qualified));
        text_mem(&list, text, separator);
        text += separator;
        text_mem(&list, found ? str_text(doc->strings, qualified) : text,
                 found ? str_len(doc->strings, qualified) : len);
        text += len;
        changed |= found;
    }
    if (changed)
        doc_set_attr(doc, element, attr, str_intern(doc->strings, list.data, list.len));
}

static void qualify_category(struct qualifier *q, elem_id element)
{
    struct document *doc = q->doc;
    assert(doc_element(doc, element)->kind == KIND_NODE);
    str_id category = doc_element(doc, element)->category;
    str_id qualified =
        find_qualified(q, str_text(doc->strings, category), str_len(doc->strings, category));
    if (qualified && is_category(q, qualified))
        doc_set_category(doc, element, qualified);
}

/* True if an attribute of an element may name elements at the root, which have qualified names. */
static bool is_of_root(const struct document *doc, elem_id user, enum doc_name_place place)
{
    bool is_child = place == NAME_IN_UNITS || place == NAME_IN_VARIANTSET;
    return doc_is_local_name(place) ? doc_naming_scope(doc, user, place) == doc->root : !is_child;
}

/* Qualifies the references of an element and its descendants. */
static void qualify_references(struct qualifier *q, elem_id top)
{
    struct document *doc = q->doc;
    assert(doc_element(doc, top)->parent == doc->root);
    for (elem_id element = top; element; element = doc_next_in_tree(doc, top, element)) {
        q->namespace = doc_inherited_attr(doc, element, STR_namespace);
        if (!q->namespace)
            continue;
        if (doc_element(doc, element)->kind == KIND_NODE)
            qualify_category(q, element);
        if (doc_element(doc, element)->kind == KIND_VARIANTSET
            && doc_attr_value(doc, element, STR_node))
            qualify_reference(q, element, STR_node);
        for (uint32_t i = 0; i < doc_element(doc, element)->num_attrs; i++) {
            str_id attr = doc_attrs(doc, element)[i].name;
            const struct doc_naming *naming = doc_naming(doc, element, attr);
            if (naming && is_of_root(doc, element, naming->place))
                qualify_reference(q, element, attr);
        }
    }
}

static void collect_nodes(struct qualifier *q, const struct document *layer)
{
    for (elem_id e = doc_element(layer, layer->root)->first_child; e;
         e = doc_element(layer, e)->next) {
        str_id node = doc_element(layer, e)->kind == KIND_NODEDEF
                          ? doc_attr_value(layer, e, STR_node)
                          : STR_EMPTY;
        if (node && is_qualified(q->doc, node))
            vec_push(q->doc->arena, &q->nodes, node);
    }
}

static bool has_namespaces(const struct document *doc)
{
    for (uint32_t i = 0; i < doc->attrs.len; i++)
        if (doc->attrs.items[i].name == STR_namespace)
            return true;
    return false;
}

/* True if elements of XML may have the prefix: those of its own keep their meaning. */
static bool is_prefix(const char *namespace)
{
    static const char later[] = "0123456789-.";
    for (const char *c = namespace; *c; c++) {
        bool is_letter =
            (*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z') || *c == '_' || (*c & 0x80);
        if (!is_letter && (c == namespace || !strchr(later, *c)))
            return false;
    }
    return strcmp(namespace, "xmlns") != 0 && strcmp(namespace, "xml") != 0
           && strcmp(namespace, "xi") != 0;
}

/* Takes away the namespaces that names of elements cannot have. */
static void check_namespaces(struct document *doc, struct diag_list *diags)
{
    for (elem_id e = doc->root; e; e = doc_next_in_tree(doc, doc->root, e)) {
        const char *namespace = str_text(doc->strings, doc_attr_value(doc, e, STR_namespace));
        if (!*namespace || is_prefix(namespace))
            continue;
        diag_add(diags, DIAG_ID_bad_namespace, doc_attr_place(doc, e, STR_namespace), namespace);
        doc_remove_attr(doc, e, STR_namespace);
    }
}

void doc_qualify_names(struct document *doc, struct diag_list *diags)
{
    doc->is_global = !has_namespaces(doc);
    if (doc->is_global)
        return;
    check_namespaces(doc, diags);
    struct qualifier q = {.doc = doc};
    text_init(&q.scratch, doc->arena);
    elem_id first = doc_element(doc, doc->root)->first_child;
    for (elem_id e = first; e; e = doc_element(doc, e)->next) {
        q.namespace = doc_inherited_attr(doc, e, STR_namespace);
        if (q.namespace)
            qualify_definition(&q, e);
    }
    doc_index_names(doc, NULL);
    for (const struct document *layer = doc; layer; layer = layer->base)
        collect_nodes(&q, layer);
    for (elem_id e = first; e; e = doc_element(doc, e)->next)
        qualify_references(&q, e);
}
