// SPDX-License-Identifier: Apache-2.0
/* Who names whom: an index of the attributes that name elements (references.def), and renaming. */
#include "base/hash.h"
#include "document/document.h"

#include <assert.h>

/* ---- The index ---- */

static uint32_t find_last(const struct document *doc, elem_id scope, str_id name, uint32_t *at)
{
    uint32_t hash = *at = hash_pair(scope, name), found;
    while ((found = table_next(&doc->reference_table, hash, at))) {
        const struct doc_reference *reference = &doc->references.items[found - 1];
        if (reference->scope == scope && reference->name == name)
            break;
    }
    return found;
}

static void add_reference(struct document *doc, elem_id scope, str_id name, elem_id element)
{
    uint32_t at, last = find_last(doc, scope, name, &at);
    if (last && doc->references.items[last - 1].element == element)
        return;
    vec_push(doc->arena, &doc->references, (struct doc_reference){scope, name, element, last});
    if (last)
        table_replace(&doc->reference_table, at, doc->references.len);
    else
        table_add(&doc->reference_table, doc->arena, hash_pair(scope, name), doc->references.len);
}

static void add_names(struct document *doc, elem_id scope, str_id names, elem_id element)
{
    const char *text = str_text(doc->strings, names), *name;
    bool is_list = text[strcspn(text, ", ")] != '\0';
    size_t len;
    while (name = doc_next_name(&text, &len), len)
        add_reference(doc, scope, is_list ? str_intern(doc->strings, name, len) : names, element);
}

static void index_references(struct document *doc, elem_id element)
{
    for (uint32_t i = 0; i < doc_element(doc, element)->num_attrs; i++) {
        const struct attribute attr = doc_attrs(doc, element)[i];
        const struct doc_naming *naming = doc_naming(doc, element, attr.name);
        if (naming && attr.value)
            add_names(doc, doc_naming_scope(doc, element, naming->place), attr.value, element);
    }
}

void doc_index_references(struct document *doc)
{
    assert(!doc->origin);
    doc->references.len = 0;
    doc->reference_table = (struct table){0};
    for (uint32_t i = 0; i < doc->elements.len; i++)
        if (doc->elements.items[i].parent)
            index_references(doc, doc->first_element + i);
}

void doc_index_change(struct document *doc, elem_id element)
{
    const struct element *e = doc_element(doc, element);
    uint32_t index = element - doc->first_element;
    bool is_in_place =
        index < doc->shared.elements && doc_element(doc->origin, element)->parent == e->parent;
    doc_index_element(doc, element);
    index_references(doc, element);
    for (elem_id child = is_in_place ? 0 : e->first_child; child;
         child = doc_element(doc, child)->next)
        index_references(doc, child); /* the scope of its ports is another one */
}

void doc_index_restored(struct document *doc)
{
    for (uint32_t i = 0; i < doc->whole->left_out.len; i++) {
        elem_id element = doc->whole->left_out.items[i].element;
        const struct element *e = doc_element(doc, element);
        if (e->parent && !doc_child(doc, e->parent, e->name))
            doc_index_change(doc, element);
    }
}

bool doc_is_used(const struct document *doc, elem_id node)
{
    const struct element *e = doc_element(doc, node);
    for (const struct document *level = doc; level && e->name; level = level->origin) {
        uint32_t at, next = find_last(level, e->parent, e->name, &at);
        for (; next; next = level->references.items[next - 1].next) {
            elem_id port = level->references.items[next - 1].element;
            if (doc_has_element(doc, port) && doc_named_node(doc, port) == node)
                return true;
        }
    }
    return false;
}

const str_id doc_connections[DOC_NUM_CONNECTIONS] = {STR_nodename, STR_nodegraph, STR_interfacename,
                                                     STR_output};

bool doc_is_connected(const struct document *doc, elem_id port)
{
    for (size_t i = 0; i < DOC_NUM_CONNECTIONS; i++)
        if (doc_attr_value(doc, port, doc_connections[i]))
            return true;
    return false;
}

void doc_disconnect(struct document *doc, elem_id port)
{
    for (size_t i = 0; i < DOC_NUM_CONNECTIONS; i++)
        doc_remove_attr(doc, port, doc_connections[i]);
}

elem_id doc_named_node(const struct document *doc, elem_id port)
{
    const struct element *e = doc_element(doc, port);
    str_id name = e->kind == KIND_INPUT || e->kind == KIND_OUTPUT
                      ? doc_attr_value(doc, port, STR_nodename)
                      : STR_EMPTY;
    return name ? doc_child(doc, doc_port_scope(doc, port), name) : 0;
}

/* ---- Users ---- */

struct visitor {
    void (*visit)(void *arg, elem_id user, str_id attr);
    void *arg;
};

/* The elements that may name an element, in a new list: the index may be out of date. */
static elem_id *find_users(const struct document *doc, elem_id scope, str_id name, uint32_t *num)
{
    VEC(elem_id) users = {0};
    for (const struct document *level = doc; level; level = level->origin) {
        uint32_t at, next = find_last(level, scope, name, &at);
        for (; next; next = level->references.items[next - 1].next)
            vec_push(doc->arena, &users, level->references.items[next - 1].element);
    }
    *num = users.len;
    return users.items;
}

/*
 * The elements of the index whose attribute names `named`, and that have `name` in the attribute
 * `visited`.
 */
static void visit_users(struct document *doc, elem_id named, const struct doc_naming *naming,
                        str_id visited, str_id name, const struct visitor *visitor)
{
    uint32_t num;
    const struct element *e = doc_element(doc, named);
    const elem_id *users =
        find_users(doc, doc_is_local_name(naming->place) ? e->parent : 0, e->name, &num);
    for (uint32_t i = 0; i < num; i++)
        if (doc_can_name(doc, users[i], naming->attr, named)
            && doc_has_name(doc, users[i], visited, name))
            visitor->visit(visitor->arg, users[i], visited);
}

/* An output has the name by which others read it of a nodegraph or node. */
static void visit_readers(struct document *doc, elem_id output, const struct visitor *visitor)
{
    const struct element e = *doc_element(doc, output);
    for (unsigned i = 0; i < DOC_NUM_NAMINGS; i++)
        if (doc_namings[i].attr == STR_nodegraph || doc_namings[i].attr == STR_nodename)
            visit_users(doc, e.parent, &doc_namings[i], STR_output, e.name, visitor);
}

/* The nodegraph that implements a definition, as `user` says; 0: it says nothing. */
static elem_id implementing_graph(const struct document *doc, elem_id user)
{
    enum element_kind kind = (enum element_kind)doc_element(doc, user)->kind;
    if (kind == KIND_IMPLEMENTATION)
        return doc_child_of_kind(doc, doc->root, KIND_NODEGRAPH,
                                 doc_attr_value(doc, user, STR_nodegraph));
    return kind == KIND_NODEGRAPH ? user : 0;
}

/* Visits the ports that read an input of a definition through a nodegraph. */
static void visit_graph(struct document *doc, elem_id input, elem_id graph,
                        const struct visitor *visitor)
{
    uint32_t num;
    const struct element e = *doc_element(doc, input);
    const elem_id *ports = find_users(doc, graph, e.name, &num);
    for (uint32_t i = 0; i < num; i++)
        if (doc_has_element(doc, ports[i]) && doc_port_scope(doc, ports[i]) == graph
            && doc_has_name(doc, ports[i], STR_interfacename, e.name))
            visitor->visit(visitor->arg, ports[i], STR_interfacename);
}

enum { MAX_HEIRS = 256 }; /* of definitions, one below the other; they may be a circle */

/*
 * A nodegraph reads the inputs of the definition that it implements, and those that this one
 * inherits, unless it has its own.
 */
static void visit_interface(struct document *doc, elem_id input, elem_id nodedef, unsigned depth,
                            const struct visitor *visitor)
{
    uint32_t num;
    const struct element e = *doc_element(doc, input);
    const elem_id *users = find_users(doc, 0, doc_element(doc, nodedef)->name, &num);
    for (uint32_t i = 0; i < num; i++) {
        bool implements = doc_can_name(doc, users[i], STR_nodedef, nodedef),
             inherits = doc_can_name(doc, users[i], STR_inherit, nodedef);
        elem_id graph = implements ? implementing_graph(doc, users[i]) : 0,
                reader = inherits && depth < MAX_HEIRS ? users[i] : graph;
        if (!reader || doc_child_of_kind(doc, reader, (enum element_kind)e.kind, e.name))
            continue;
        if (graph)
            visit_graph(doc, input, graph, visitor);
        else
            visit_interface(doc, input, reader, depth + 1, visitor);
    }
}

void doc_visit_users(struct document *doc, elem_id element,
                     void (*visit)(void *arg, elem_id user, str_id attr), void *arg)
{
    const struct visitor visitor = {visit, arg};
    const struct element e = *doc_element(doc, element);
    for (unsigned i = 0; e.name && i < DOC_NUM_NAMINGS; i++)
        if (doc_namings[i].targets >> e.kind & 1)
            visit_users(doc, element, &doc_namings[i], doc_namings[i].attr, e.name, &visitor);
    if (e.kind == KIND_OUTPUT && e.name && e.parent != doc->root)
        visit_readers(doc, element, &visitor);
    if (e.name && e.parent && doc_element(doc, e.parent)->kind == KIND_NODEDEF)
        visit_interface(doc, element, e.parent, 0, &visitor);
}

/* ---- Renaming ---- */

struct renaming {
    struct document *doc;
    str_id old, name;
    struct text list;
};

/* Replaces a name of a list; without a new name, or where the list has that one, it goes. */
static void replace_name(void *arg, elem_id user, str_id attr)
{
    struct renaming *r = arg;
    struct document *doc = r->doc;
    bool is_new = r->name && !doc_has_name(doc, user, attr, r->name);
    const char *text = str_text(doc->strings, doc_attr_value(doc, user, attr)), *rest = text, *part;
    size_t len, old_len = str_len(doc->strings, r->old);
    r->list.len = 0;
    while (part = doc_next_name(&rest, &len), len) {
        bool is_old = len == old_len && memcmp(part, str_text(doc->strings, r->old), len) == 0;
        if (!is_old || is_new) {
            text_mem(&r->list, r->list.len ? text : part, r->list.len ? (size_t)(part - text) : 0);
            text_mem(&r->list, is_old ? str_text(doc->strings, r->name) : part,
                     is_old ? str_len(doc->strings, r->name) : len);
        }
        text = rest;
    }
    if (r->list.len)
        doc_set_attr(doc, user, attr, str_intern(doc->strings, r->list.data, r->list.len));
    else
        doc_remove_attr(doc, user, attr);
    doc_index_change(doc, user);
}

void doc_replace_name(struct document *doc, elem_id user, str_id attr, str_id old, str_id name)
{
    struct renaming r = {.doc = doc, .old = old, .name = name};
    text_init(&r.list, doc->arena);
    replace_name(&r, user, attr);
}

void doc_rename(struct document *doc, elem_id element, str_id name)
{
    struct renaming r = {.doc = doc, .old = doc_element(doc, element)->name, .name = name};
    assert(doc_element(doc, element)->parent && name);
    text_init(&r.list, doc->arena);
    doc_visit_users(doc, element, replace_name, &r);
    doc_set_name(doc, element, name);
    doc_index_change(doc, element);
}
