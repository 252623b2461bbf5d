// SPDX-License-Identifier: Apache-2.0
/* Who names whom: an index of the attributes that name elements, and renaming. */
#include "base/hash.h"
#include "document/document.h"

#include <assert.h>

enum scope {
    NOWHERE,  /* the attribute names no element */
    ANYWHERE, /* elements of the whole document */
    BESIDE,   /* elements of the port's scope */
};

static const uint8_t scope_of_attr[STR_NUM_WORDS] = {
    [STR_nodename] = BESIDE,
    [STR_interfacename] = BESIDE,
    [STR_nodegraph] = ANYWHERE,
    [STR_output] = ANYWHERE,
    [STR_material] = ANYWHERE,
    [STR_nodedef] = ANYWHERE,
    [STR_inherit] = ANYWHERE,
    [STR_type] = ANYWHERE,
    [STR_look] = ANYWHERE,
    [STR_looks] = ANYWHERE,
    [STR_collection] = ANYWHERE,
    [STR_variantset] = ANYWHERE,
    [STR_includecollection] = ANYWHERE,
    [STR_geomprop] = ANYWHERE,
    [STR_defaultgeomprop] = ANYWHERE,
};

/* Which attributes name elements of a kind: one name, or several with commas. */
static const struct {
    uint8_t kind; /* enum element_kind */
    str_id attr;
} references[] = {
    {KIND_NODE, STR_nodename},
    {KIND_NODE, STR_material},
    {KIND_NODEGRAPH, STR_nodename},
    {KIND_NODEGRAPH, STR_nodegraph},
    {KIND_INPUT, STR_interfacename},
    {KIND_OUTPUT, STR_output},
    {KIND_NODEDEF, STR_nodedef},
    {KIND_NODEDEF, STR_inherit},
    {KIND_TYPEDEF, STR_type},
    {KIND_LOOK, STR_look},
    {KIND_LOOK, STR_looks},
    {KIND_LOOK, STR_inherit},
    {KIND_LOOKGROUP, STR_looks},
    {KIND_COLLECTION, STR_collection},
    {KIND_COLLECTION, STR_includecollection},
    {KIND_VARIANTSET, STR_variantset},
    {KIND_GEOMPROPDEF, STR_geomprop},
    {KIND_GEOMPROPDEF, STR_defaultgeomprop},
};

/*
 * The parent of the elements that a port can name: for an input of a node the graph of the node,
 * for an input of a graph the parent of the graph, for an output its graph.
 */
static elem_id scope_of(const struct document *doc, elem_id port)
{
    const struct element *e = doc_element(doc, port);
    elem_id beyond = e->parent ? doc_element(doc, e->parent)->parent : 0;
    return e->kind == KIND_OUTPUT || !beyond ? e->parent : beyond;
}

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

static bool is_list(const char *text)
{
    return text[strcspn(text, ", ")] != '\0';
}

static void add_names(struct document *doc, elem_id scope, str_id names, elem_id element)
{
    const char *text = str_text(doc->strings, names);
    if (!is_list(text)) {
        add_reference(doc, scope, names, element);
        return;
    }
    while (*text) {
        text += strspn(text, ", ");
        size_t len = strcspn(text, ", ");
        if (len)
            add_reference(doc, scope, str_intern(doc->strings, text, len), element);
        text += len;
    }
}

/* Standard types are in no document, and the outputs of nodes and graphs are known by these. */
static bool names_element(const struct document *doc, elem_id element, const struct attribute *attr)
{
    return attr->name < STR_NUM_WORDS && scope_of_attr[attr->name] && attr->value
           && (attr->name != STR_type || !doc_type_of(attr->value))
           && (attr->name != STR_output
               || (!doc_attr(doc, element, STR_nodename)
                   && !doc_attr(doc, element, STR_nodegraph)));
}

static void index_references(struct document *doc, elem_id element)
{
    for (uint32_t i = 0; i < doc_element(doc, element)->num_attrs; i++) {
        const struct attribute attr = doc_attrs(doc, element)[i];
        if (names_element(doc, element, &attr))
            add_names(doc, scope_of_attr[attr.name] == BESIDE ? scope_of(doc, element) : 0,
                      attr.value, element);
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
    return name ? doc_child(doc, scope_of(doc, port), name) : 0;
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

/* True if an attribute of `at`, which has the name in it, names `element` below `parent`. */
static bool can_name(const struct document *doc, elem_id at, str_id attr, elem_id element)
{
    const struct element *e = doc_element(doc, element);
    if (!doc_attr_value(doc, at, attr) || !doc_has_element(doc, at))
        return false;
    elem_id scope = scope_of(doc, at), first;
    switch (attr) {
    case STR_nodename:
    case STR_interfacename: return scope == e->parent;
    case STR_nodegraph:
        first = doc_child(doc, scope, e->name);
        return first ? first == element : e->parent == doc->root;
    case STR_output: return e->parent == doc->root;
    case STR_inherit: return doc_element(doc, at)->kind == e->kind;
    default: return true;
    }
}

/* A name in a list "a, b" or alone, from *text, which moves behind it; its length is 0 at the end.
 */
static const char *next_name(const char **text, size_t *len)
{
    const char *name = *text + strspn(*text, ", ");
    *len = strcspn(name, ", ");
    *text = name + *len;
    return name;
}

bool doc_has_name(const struct document *doc, elem_id user, str_id attr, str_id name)
{
    const char *text = str_text(doc->strings, doc_attr_value(doc, user, attr)), *part;
    size_t len;
    while (part = next_name(&text, &len), len)
        if (len == str_len(doc->strings, name)
            && memcmp(part, str_text(doc->strings, name), len) == 0)
            return true;
    return false;
}

/* The elements whose attribute `attr` names `named`, and that have `name` in the attribute
 * `visited`. */
static void visit_users(struct document *doc, elem_id named, str_id attr, str_id visited,
                        str_id name, const struct visitor *visitor)
{
    uint32_t num;
    const struct element *e = doc_element(doc, named);
    const elem_id *users =
        find_users(doc, scope_of_attr[attr] == BESIDE ? e->parent : 0, e->name, &num);
    for (uint32_t i = 0; i < num; i++)
        if (can_name(doc, users[i], attr, named) && doc_has_name(doc, users[i], visited, name))
            visitor->visit(visitor->arg, users[i], visited);
}

void doc_visit_users(struct document *doc, elem_id element,
                     void (*visit)(void *arg, elem_id user, str_id attr), void *arg)
{
    const struct visitor visitor = {visit, arg};
    const struct element e = *doc_element(doc, element);
    for (size_t i = 0; e.name && i < sizeof references / sizeof *references; i++)
        if (references[i].kind == e.kind)
            visit_users(doc, element, references[i].attr, references[i].attr, e.name, &visitor);
    if (e.kind == KIND_OUTPUT && e.name && e.parent != doc->root) {
        visit_users(doc, e.parent, STR_nodegraph, STR_output, e.name, &visitor);
        visit_users(doc, e.parent, STR_nodename, STR_output, e.name, &visitor);
    }
}

/* ---- Renaming ---- */

struct renaming {
    struct document *doc;
    str_id old, name;
    struct text list;
};

static void replace_name(void *arg, elem_id user, str_id attr)
{
    struct renaming *r = arg;
    struct document *doc = r->doc;
    const char *text = str_text(doc->strings, doc_attr_value(doc, user, attr)), *rest = text, *part;
    size_t len, old_len = str_len(doc->strings, r->old);
    r->list.len = 0;
    while (part = next_name(&rest, &len), len) {
        bool is_old = len == old_len && memcmp(part, str_text(doc->strings, r->old), len) == 0;
        text_mem(&r->list, text, (size_t)(part - text));
        text_mem(&r->list, is_old ? str_text(doc->strings, r->name) : part,
                 is_old ? str_len(doc->strings, r->name) : len);
        text = rest;
    }
    text_str(&r->list, text);
    doc_set_attr(doc, user, attr, str_intern(doc->strings, r->list.data, r->list.len));
    doc_index_change(doc, user);
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
