// SPDX-License-Identifier: Apache-2.0
/* Edits of a complete document: copies, names and references to them. */
#include "document/document.h"

#include <assert.h>
#include <stdlib.h>

/* ---- What documents share ---- */

#define COPY(to, from, field) \
    do { \
        if ((from)->field.len) \
            memcpy(vec_extend((to)->arena, &(to)->field, (from)->field.len), (from)->field.items, \
                   (from)->field.len * sizeof *(from)->field.items); \
    } while (0)

static void copy_changes(struct document *doc, const struct document *from)
{
    uint32_t num = from->changes.len;
    struct doc_change *changes = ARENA_ARRAY(doc->arena, struct doc_change, num),
                      **items = vec_extend(doc->arena, &doc->changes, num);
    doc->num_added = from->num_added;
    for (uint32_t i = 0; i < num; i++) {
        items[i] = &changes[i];
        changes[i] = *from->changes.items[i];
        changes[i].is_fresh = false;
    }
    table_copy(&doc->changed, doc->arena, &from->changed);
    table_copy(&doc->names, doc->arena, &from->names);
    COPY(doc, from, attrs);
    COPY(doc, from, comments);
    COPY(doc, from, comment_lists);
}

void doc_begin_edit(struct document *doc, struct arena *arena, struct strpool *strings,
                    const struct document *from)
{
    const struct document *origin = from->origin ? from->origin : from;
    assert(strings->base == origin->strings && !origin->origin);
    *doc = (struct document){.base = origin->base,
                             .strings = strings,
                             .arena = arena,
                             .first_element = origin->first_element,
                             .first_attr = origin->first_attr,
                             .first_file = origin->first_file,
                             .root = origin->root,
                             .max_elements = from->max_elements,
                             .has_templates = from->has_templates,
                             .has_attributedefs = from->has_attributedefs,
                             .is_global = from->is_global,
                             .keeps_comments = from->keeps_comments,
                             .has_loose_attrs = from->has_loose_attrs,
                             .origin = origin};
    COPY(doc, from, files);
    if (from->origin)
        copy_changes(doc, from);
}

bool doc_is_same(const struct document *doc, const struct doc_change *change)
{
    if (change->index >= doc->origin->elements.len)
        return false;
    const struct element *now = &change->element,
                         *before = &doc->origin->elements.items[change->index];
    return now->category == before->category && now->name == before->name
           && now->parent == before->parent && now->first_attr == before->first_attr
           && now->num_attrs == before->num_attrs;
}

void doc_leave_origin(struct document *doc)
{
    const struct document *origin = doc->origin;
    struct document changed = *doc;
    uint32_t num = doc_num_elements(doc);
    memset(&doc->elements, 0, sizeof doc->elements);
    memset(&doc->attrs, 0, sizeof doc->attrs);
    memset(&doc->comments, 0, sizeof doc->comments);
    memset(&doc->comment_lists, 0, sizeof doc->comment_lists);
    COPY(doc, origin, attrs);
    COPY(doc, origin, comments);
    COPY(doc, origin, comment_lists);
    COPY(doc, &changed, attrs);
    COPY(doc, &changed, comments);
    COPY(doc, &changed, comment_lists);
    COPY(doc, origin, elements);
    COPY(doc, origin, links);
    (void)vec_extend(doc->arena, &doc->elements, num - origin->elements.len);
    (void)vec_extend(doc->arena, &doc->links, num - origin->links.len);
    for (uint32_t i = 0; i < changed.changes.len; i++) {
        const struct doc_change *change = changed.changes.items[i];
        doc->elements.items[change->index] = change->element;
        doc->links.items[change->index] = change->link;
    }
    doc->origin = NULL;
    doc->num_added = 0;
    memset(&doc->changes, 0, sizeof doc->changes);
    memset(&doc->changed, 0, sizeof doc->changed);
    memset(&doc->paths, 0, sizeof doc->paths);
    doc_index_names(doc, NULL);
}

/* ---- Copies ---- */

struct copier {
    struct document *doc;
    const struct document *from;
};

static str_id copied_text(const struct copier *c, str_id text)
{
    return str_intern(c->doc->strings, str_text(c->from->strings, text),
                      str_len(c->from->strings, text));
}

static void copy_comments(const struct copier *c, elem_id copy, elem_id element)
{
    const struct document *from = doc_layer(c->from, element);
    for (unsigned place = 0; place < NUM_COMMENT_PLACES; place++)
        for (uint32_t i = doc_first_comment(from, element, place); i;
             i = doc_comment_at(from, i)->next)
            doc_add_comment(c->doc, copy, place, copied_text(c, doc_comment_at(from, i)->text));
}

static elem_id copy_one(const struct copier *c, elem_id parent, elem_id element, str_id name)
{
    /* by value: the element and its copy may be in one growing array */
    const struct element e = *doc_element(c->from, element);
    elem_id copy = doc_add_element(c->doc, parent, copied_text(c, e.category),
                                   name ? name : copied_text(c, e.name),
                                   doc_element(c->doc, c->doc->root)->file, 0, 0);
    for (uint32_t i = 0; i < e.num_attrs; i++) {
        const struct attribute attr = doc_attrs(c->from, element)[i];
        doc_add_attr(c->doc, copy,
                     (struct attribute){.name = copied_text(c, attr.name),
                                        .value = copied_text(c, attr.value)});
    }
    copy_comments(c, copy, element);
    doc_index_element(c->doc, copy);
    return copy;
}

/* The elements to copy are known before the first copy, which may land below `element`. */
elem_id doc_copy_element(struct document *doc, elem_id parent, const struct document *from,
                         elem_id element, str_id name)
{
    const struct copier c = {doc, from};
    VEC(elem_id) sources = {0};
    for (elem_id at = element; at; at = doc_next_in_tree(from, element, at))
        vec_push(doc->arena, &sources, at);
    if (doc->max_elements && sources.len > doc->max_elements - doc_num_elements(doc))
        return 0;
    elem_id copy = copy_one(&c, parent, element, name), at = copy;
    for (uint32_t i = 1; i < sources.len; i++) {
        elem_id below = doc_element(from, sources.items[i])->parent, source = sources.items[i - 1];
        for (; source != below; source = doc_element(from, source)->parent)
            at = doc_element(doc, at)->parent;
        at = copy_one(&c, at, sources.items[i], STR_EMPTY);
    }
    return copy;
}

bool doc_has_element(const struct document *doc, elem_id element)
{
    return element >= doc->first_element && element - doc->first_element < doc_num_elements(doc)
           && doc_is_within(doc, element, doc->root);
}

/* ---- Names ---- */

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool is_letter(char c)
{
    /* for both cases; characters before 'a' wrap to large values */
    unsigned letter = ((unsigned char)c | 0x20u) - 'a';
    return letter < 26 || c == '_';
}

bool doc_is_name(const char *text)
{
    for (; *text; text++) {
        if (!is_letter(*text))
            return false;
        while (is_letter(*text) || is_digit(*text))
            text++;
        if (!*text)
            return true;
        if (*text != ':')
            return false;
    }
    return false;
}

/* The elements whose attributes may name an element. */
enum reference_scope {
    ANYWHERE,
    BESIDE,  /* the children of its siblings, and its siblings */
    WITHIN,  /* all elements below its parent */
    PORTS_OF /* elements whose `nodegraph` names its parent */
};

static const struct reference {
    uint8_t kind; /* enum element_kind of the named element */
    uint8_t scope;
    str_id attr; /* one name, or several with commas */
} references[] = {
    {KIND_NODE, BESIDE, STR_nodename},
    {KIND_NODE, ANYWHERE, STR_material},
    {KIND_NODEGRAPH, ANYWHERE, STR_nodegraph},
    {KIND_INPUT, WITHIN, STR_interfacename},
    {KIND_OUTPUT, PORTS_OF, STR_output},
    {KIND_NODEDEF, ANYWHERE, STR_nodedef},
    {KIND_NODEDEF, ANYWHERE, STR_inherit},
    {KIND_TYPEDEF, ANYWHERE, STR_type},
    {KIND_LOOK, ANYWHERE, STR_look},
    {KIND_LOOK, ANYWHERE, STR_looks},
    {KIND_LOOK, ANYWHERE, STR_inherit},
    {KIND_LOOKGROUP, ANYWHERE, STR_looks},
    {KIND_COLLECTION, ANYWHERE, STR_collection},
    {KIND_COLLECTION, ANYWHERE, STR_includecollection},
    {KIND_VARIANTSET, ANYWHERE, STR_variantset},
    {KIND_GEOMPROPDEF, ANYWHERE, STR_geomprop},
    {KIND_GEOMPROPDEF, ANYWHERE, STR_defaultgeomprop},
};

struct renaming {
    struct document *doc;
    elem_id element, parent;
    uint8_t kind;
    str_id old, parents_name;
    str_id name;
    struct text list;
};

/* Several kinds share an attribute: "inherit" of a look names looks only. */
static bool can_refer(const struct renaming *r, const struct reference *reference, elem_id at)
{
    const struct element *e = doc_element(r->doc, at);
    switch ((enum reference_scope)reference->scope) {
    case BESIDE:
        return e->parent == r->parent
               || (e->parent && doc_element(r->doc, e->parent)->parent == r->parent);
    case PORTS_OF: return doc_attr_value(r->doc, at, STR_nodegraph) == r->parents_name;
    case WITHIN: return doc_is_within(r->doc, at, r->parent);
    case ANYWHERE: return reference->attr != STR_inherit || e->kind == r->kind;
    }
    return false;
}

/* Replaces the name in a list "a, b" or alone. */
static void replace_name(struct renaming *r, elem_id at, str_id attr)
{
    struct document *doc = r->doc;
    const char *text = str_text(doc->strings, doc_attr_value(doc, at, attr)),
               *old = str_text(doc->strings, r->old);
    size_t old_len = str_len(doc->strings, r->old);
    bool found = false;
    r->list.len = 0;
    while (*text) {
        size_t gap = strspn(text, ", "), len = strcspn(text + gap, ", ");
        bool is_old = len == old_len && memcmp(text + gap, old, len) == 0;
        text_mem(&r->list, text, gap);
        if (is_old)
            text_str(&r->list, str_text(doc->strings, r->name));
        else
            text_mem(&r->list, text + gap, len);
        found |= is_old;
        text += gap + len;
    }
    if (found)
        doc_set_attr(doc, at, attr, str_intern(doc->strings, r->list.data, r->list.len));
}

void doc_rename(struct document *doc, elem_id element, str_id name)
{
    const struct element *e = doc_element(doc, element);
    struct renaming r = {.doc = doc,
                         .element = element,
                         .parent = e->parent,
                         .kind = (uint8_t)e->kind,
                         .old = e->name,
                         .parents_name = doc_element(doc, e->parent)->name,
                         .name = name};
    assert(e->parent && name);
    text_init(&r.list, doc->arena);
    for (elem_id at = r.old ? doc->root : 0; at; at = doc_next_in_tree(doc, doc->root, at))
        for (size_t i = 0; i < sizeof references / sizeof *references; i++)
            if (references[i].kind == r.kind && doc_attr_value(doc, at, references[i].attr)
                && can_refer(&r, &references[i], at))
                replace_name(&r, at, references[i].attr);
    doc_set_name(doc, element, name);
    doc_index_element(doc, element);
}

/* ---- Places ---- */

static void keep_path(struct document *doc, elem_id element)
{
    const struct element *e = doc_element(doc, element);
    if (e->line || !e->parent)
        return;
    struct text path;
    text_init(&path, doc->arena);
    doc_path(doc, element, '/', &path);
    vec_push(doc->arena, &doc->paths, (struct doc_place_path){element, text_cstr(&path)});
}

static int by_element(const void *a, const void *b)
{
    elem_id x = ((const struct doc_place_path *)a)->element,
            y = ((const struct doc_place_path *)b)->element;
    return (x > y) - (x < y);
}

void doc_keep_paths(struct document *doc)
{
    doc->paths.len = 0;
    if (!doc->origin)
        for (uint32_t i = 0; i < doc->elements.len; i++)
            keep_path(doc, doc->first_element + i);
    for (uint32_t i = 0; i < doc->changes.len; i++)
        keep_path(doc, doc->first_element + doc->changes.items[i]->index);
    if (doc->paths.len)
        qsort(doc->paths.items, doc->paths.len, sizeof *doc->paths.items, by_element);
}
