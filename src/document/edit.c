// SPDX-License-Identifier: Apache-2.0
/* Edits of a complete document: copies, names and references to them. */
#include "document/document.h"

#include <assert.h>

/* ---- Copies ---- */

#define COPY(field) \
    do { \
        if (from->field.len) \
            memcpy(vec_extend(doc->arena, &doc->field, from->field.len), from->field.items, \
                   from->field.len * sizeof *from->field.items); \
    } while (0)

void doc_copy(struct document *doc, const struct document *from)
{
    assert(doc->base == from->base && doc->first_element == from->first_element);
    assert(doc->strings->num == from->strings->num && doc->elements.len == 1);
    doc->elements.len = doc->links.len = 0;
    COPY(elements);
    COPY(attrs);
    COPY(files);
    COPY(links);
    COPY(comments);
    COPY(comment_lists);
    doc->root = from->root;
    doc->max_elements = from->max_elements;
    doc->has_templates = from->has_templates;
    doc->has_attributedefs = from->has_attributedefs;
    doc->is_global = from->is_global;
    doc->keeps_comments = from->keeps_comments;
    table_copy(&doc->names, doc->arena, &from->names);
}

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
             i = from->comments.items[i - 1].next)
            doc_add_comment(c->doc, copy, place, copied_text(c, from->comments.items[i - 1].text));
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
    if (doc->max_elements && sources.len > doc->max_elements - doc->elements.len)
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
    return element >= doc->first_element && element - doc->first_element < doc->elements.len
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

void doc_keep_paths(struct document *doc)
{
    assert(!doc->paths.len);
    for (uint32_t i = 0; i < doc->elements.len; i++) {
        elem_id element = doc->first_element + i;
        if (doc->elements.items[i].line || !doc->elements.items[i].parent)
            continue;
        struct text path;
        text_init(&path, doc->arena);
        doc_path(doc, element, '/', &path);
        vec_push(doc->arena, &doc->paths, (struct doc_place_path){element, text_cstr(&path)});
    }
}
