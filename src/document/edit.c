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

/* Returns what an edit copies of a document that it does not share. */
static uint64_t num_own(const struct document *doc)
{
    return (uint64_t)doc->changes.len + doc->attrs.len;
}

uint64_t doc_num_changes(const struct document *doc)
{
    uint64_t num = 0;
    for (; doc->origin; doc = doc->origin)
        num += num_own(doc);
    return num;
}

/*
 * Each origin has more changes than all documents above it have together, so there are few of them,
 * and a series of edits copies a change only each time when their number has doubled.
 */
const struct document *doc_to_share(const struct document *from)
{
    enum { FEW = 64 };
    uint64_t copied = 0;
    for (; from->origin && num_own(from) <= 2 * copied + FEW; from = from->origin)
        copied += num_own(from);
    return from;
}

/* The document that shares `below` directly, of those under `top` or `top` itself. */
static const struct document *above(const struct document *top, const struct document *below)
{
    while (top->origin != below)
        top = top->origin;
    return top;
}

/* Texts that the origin does not have get new ids: those that no element has any more are gone. */
static str_id kept_text(struct document *doc, const struct document *from, str_id text)
{
    return text < doc->strings->first ? text
                                      : str_intern(doc->strings, str_text(from->strings, text),
                                                   str_len(from->strings, text));
}

static void keep_changes(struct document *doc, const struct document *from,
                         const struct document *level)
{
    uint32_t shared = doc->shared.comment_lists;
    for (uint32_t i = 0; i < level->changes.len; i++) {
        const struct doc_change *change = level->changes.items[i];
        struct doc_change *kept = doc_add_change(doc, change->index);
        kept->element = change->element;
        kept->link = change->link;
        kept->element.category = kept_text(doc, from, change->element.category);
        kept->element.name = kept_text(doc, from, change->element.name);
    }
    for (uint32_t i = 0; i < level->comments.len; i++) {
        const struct doc_comment comment = {kept_text(doc, from, level->comments.items[i].text),
                                            level->comments.items[i].next};
        vec_push(doc->arena, &doc->comments, comment);
    }
    assert(level->shared.comment_lists == shared + doc->comment_lists.len);
    COPY(doc, level, comment_lists);
    doc->num_added += level->num_added;
}

static void keep_attrs(struct document *doc, const struct document *from, struct doc_change *change)
{
    struct element *e = &change->element;
    uint32_t first = doc->first_attr + doc->shared.attrs;
    if (e->first_attr < first)
        return; /* the origin has them */
    const struct attribute *attrs = doc_attrs(from, doc->first_element + change->index);
    e->first_attr = first + doc->attrs.len;
    for (uint32_t i = 0; i < e->num_attrs; i++) {
        struct attribute attr = attrs[i];
        attr.name = kept_text(doc, from, attr.name);
        attr.value = kept_text(doc, from, attr.value);
        vec_push(doc->arena, &doc->attrs, attr);
    }
}

static void touch_outputs(struct document *doc, const struct doc_change *change)
{
    elem_id element = doc->first_element + change->index;
    doc_touch_outputs(doc, element, change->element.parent);
    if (change->index < doc->shared.elements)
        doc_touch_outputs(doc, element, doc_element(doc->origin, element)->parent);
}

void doc_begin_edit(struct document *doc, struct arena *arena, struct strpool *strings,
                    const struct document *from, const struct document *origin)
{
    assert(strings->base == origin->strings);
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
                             .has_aovs = from->has_aovs,
                             .is_global = from->is_global,
                             .keeps_comments = from->keeps_comments,
                             .has_loose_attrs = from->has_loose_attrs,
                             .origin = origin,
                             .whole = origin->origin ? origin->whole : origin,
                             .shared = {doc_num_elements(origin),
                                        origin->shared.attrs + origin->attrs.len,
                                        origin->shared.comments + origin->comments.len,
                                        origin->shared.comment_lists + origin->comment_lists.len}};
    COPY(doc, from, files);
    for (const struct document *level = origin; level != from;) {
        level = above(from, level);
        keep_changes(doc, from, level);
    }
    for (uint32_t i = 0; i < doc->changes.len; i++)
        keep_attrs(doc, from, doc->changes.items[i]);
    for (uint32_t i = 0; i < doc->changes.len; i++)
        touch_outputs(doc, doc->changes.items[i]);
    for (uint32_t i = 0; i < doc->changes.len; i++)
        doc_index_change(doc, doc->first_element + doc->changes.items[i]->index);
}

static const struct element *element_of_origin(const struct document *doc,
                                               const struct doc_change *change)
{
    return change->index < doc->shared.elements
               ? doc_element(doc->origin, doc->first_element + change->index)
               : NULL;
}

bool doc_is_same(const struct document *doc, const struct doc_change *change)
{
    const struct element *now = &change->element, *before = element_of_origin(doc, change);
    return before && now->category == before->category && now->name == before->name
           && now->parent == before->parent && now->first_attr == before->first_attr
           && now->num_attrs == before->num_attrs;
}

bool doc_is_renamed(const struct document *doc, const struct doc_change *change)
{
    const struct element *before = element_of_origin(doc, change);
    return before
           && (change->element.name != before->name || change->element.parent != before->parent);
}

void doc_leave_origin(struct document *doc)
{
    const struct document top = *doc, *whole = top.whole;
    uint32_t num = doc_num_elements(doc);
    *doc = (struct document){.base = top.base,
                             .strings = top.strings,
                             .arena = top.arena,
                             .first_element = top.first_element,
                             .first_attr = top.first_attr,
                             .first_file = top.first_file,
                             .root = top.root,
                             .max_elements = top.max_elements,
                             .has_templates = top.has_templates,
                             .has_attributedefs = top.has_attributedefs,
                             .has_aovs = top.has_aovs,
                             .is_global = top.is_global,
                             .keeps_comments = top.keeps_comments,
                             .has_loose_attrs = top.has_loose_attrs};
    COPY(doc, &top, files);
    COPY(doc, whole, attrs);
    COPY(doc, whole, comments);
    COPY(doc, whole, comment_lists);
    COPY(doc, whole, elements);
    COPY(doc, whole, links);
    (void)vec_extend(doc->arena, &doc->elements, num - whole->elements.len);
    (void)vec_extend(doc->arena, &doc->links, num - whole->links.len);
    for (const struct document *level = whole; level != &top;) {
        level = above(&top, level);
        COPY(doc, level, attrs);
        COPY(doc, level, comments);
        COPY(doc, level, comment_lists);
        for (uint32_t i = 0; i < level->changes.len; i++) {
            const struct doc_change *change = level->changes.items[i];
            doc->elements.items[change->index] = change->element;
            doc->links.items[change->index] = change->link;
        }
    }
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
    doc_index_change(c->doc, copy);
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
    for (uint32_t i = 0; i < doc->changes.len; i++) {
        elem_id element = doc->first_element + doc->changes.items[i]->index;
        keep_path(doc, element);
        for (elem_id at = doc_is_renamed(doc, doc->changes.items[i]) ? element : 0; at;
             at = doc_next_in_tree(doc, element, at))
            keep_path(doc, at);
    }
    if (doc->paths.len)
        qsort(doc->paths.items, doc->paths.len, sizeof *doc->paths.items, by_element);
}
