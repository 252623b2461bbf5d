// SPDX-License-Identifier: Apache-2.0
#include "document/document.h"

#include "base/hash.h"

#include <assert.h>

/* Kinds */

enum element_kind doc_kind_of(str_id category)
{
    static const uint8_t kind_of_word[STR_NUM_WORDS] = {
#define KIND(ID, word) [STR_##word] = KIND_##ID,
#include "document/kinds.def"
#undef KIND
    };
    return category < STR_NUM_WORDS ? (enum element_kind)kind_of_word[category] : KIND_NODE;
}

/* Layers */

/* The attributes of an element of this layer from its first one. */
static inline const struct attribute *attrs_of(const struct document *doc, const struct element *e)
{
    uint32_t at = e->first_attr - doc->first_attr;
    while (at < doc->shared.attrs)
        doc = doc->origin;
    return doc->attrs.items + (at - doc->shared.attrs);
}

const struct attribute *doc_attrs(const struct document *doc, elem_id element)
{
    doc = doc_layer(doc, element);
    const struct element *e = doc_element(doc, element);
    return e->num_attrs ? attrs_of(doc, e) : NULL;
}

static struct doc_change *find_own_change(const struct document *doc, uint32_t index)
{
    uint32_t hash = hash_pair(index, 0);
    for (uint32_t at = hash, found; (found = table_next(&doc->changed, hash, &at));)
        if (doc->changes.items[found - 1]->index == index)
            return doc->changes.items[found - 1];
    return NULL;
}

const struct doc_change *doc_find_change(const struct document *doc, uint32_t index)
{
    const struct doc_change *change = NULL;
    for (; doc->origin && !change; doc = doc->origin)
        change = find_own_change(doc, index);
    return change;
}

struct doc_change *doc_add_change(struct document *doc, uint32_t index)
{
    struct doc_change *change = find_own_change(doc, index);
    if (change)
        return change;
    change = ARENA_NEW(doc->arena, struct doc_change);
    change->index = index;
    vec_push(doc->arena, &doc->changes, change);
    table_add(&doc->changed, doc->arena, hash_pair(index, 0), doc->changes.len);
    return change;
}

/* The element apart from its origin, to be changed. It stays where it is. */
static struct doc_change *change_of(struct document *doc, elem_id element)
{
    uint32_t index = element - doc->first_element;
    struct doc_change *change = find_own_change(doc, index);
    if (!change) {
        assert(index < doc->shared.elements);
        change = doc_add_change(doc, index);
        change->element = *doc_element(doc->origin, element);
        change->link = *doc_link(doc->origin, element);
        doc_touch_outputs(doc, element, change->element.parent);
    }
    change->is_fresh = true;
    return change;
}

static struct element *own(struct document *doc, elem_id element)
{
    assert(element >= doc->first_element && element - doc->first_element < doc_num_elements(doc));
    return doc->origin ? &change_of(doc, element)->element
                       : &doc->elements.items[element - doc->first_element];
}

static struct doc_link *link_of(struct document *doc, elem_id element)
{
    assert(element - doc->first_element < doc_num_elements(doc));
    return doc->origin ? &change_of(doc, element)->link
                       : &doc->links.items[element - doc->first_element];
}

struct doc_link *doc_own_link(struct document *doc, elem_id element)
{
    return link_of(doc, element);
}

const struct doc_link *doc_link(const struct document *doc, elem_id element)
{
    doc = doc_layer(doc, element);
    uint32_t index = element - doc->first_element;
    const struct doc_change *change = doc->origin ? doc_find_change(doc, index) : NULL;
    if (change)
        return &change->link;
    const struct document *whole = doc->origin ? doc->whole : doc;
    return index < whole->links.len ? &whole->links.items[index] : NULL;
}

void doc_init(struct document *doc, struct arena *arena, struct strpool *strings,
              const struct document *base)
{
    *doc = (struct document){.base = base,
                             .strings = strings,
                             .arena = arena,
                             .first_element = 1,
                             .first_attr = 0,
                             .first_file = 1};
    if (base) {
        doc->first_element = base->first_element + base->elements.len;
        doc->first_attr = base->first_attr + base->attrs.len;
        doc->first_file = base->first_file + base->files.len;
    }
    doc->root = doc_add_element(doc, 0, STR_materialx, STR_EMPTY, 0, 0, 0);
    assert(doc->root == doc->first_element);
}

/* Building */

static void link_last(struct document *doc, elem_id parent, elem_id element)
{
    struct doc_link *link = link_of(doc, parent);
    assert(!own(doc, element)->parent && element != parent);
    assert(!link->last_child == !own(doc, parent)->first_child);
    if (link->last_child)
        own(doc, link->last_child)->next = element;
    else
        own(doc, parent)->first_child = element;
    link_of(doc, element)->previous = link->last_child;
    link->last_child = element;
    own(doc, element)->parent = parent;
    own(doc, element)->next = 0;
    doc_touch_outputs(doc, element, parent);
}

elem_id doc_add_element(struct document *doc, elem_id parent, str_id category, str_id name,
                        uint16_t file, uint32_t line, uint16_t column)
{
    uint32_t index = doc_num_elements(doc);
    if (index >= UINT32_MAX - doc->first_element)
        mem_fail(doc->arena->mem);
    struct element added = {.category = category,
                            .name = name,
                            .line = line,
                            .column = column,
                            .file = file,
                            .first_attr = doc->first_attr + doc->shared.attrs + doc->attrs.len,
                            .kind = (uint16_t)doc_kind_of(category)};
    if (doc->origin) {
        struct doc_change *change = doc_add_change(doc, index);
        doc->num_added++;
        change->is_fresh = true;
        change->element = added;
    } else {
        vec_push(doc->arena, &doc->elements, added);
        vec_push(doc->arena, &doc->links, (struct doc_link){0});
    }
    doc->has_templates |= category == STR_template;
    doc->has_attributedefs |= category == STR_attributedef;
    doc->has_aovs |= category == STR_aov || category == STR_aovpass;
    assert(doc->links.len == doc->elements.len && parent < doc->first_element + index);
    elem_id element = doc->first_element + index;
    if (parent)
        link_last(doc, parent, element);
    return element;
}

static const char *kept_path(const struct document *doc, elem_id element);

elem_id doc_add_like(struct document *doc, elem_id parent, str_id category, str_id name,
                     elem_id origin)
{
    const struct element like = *doc_element(doc, origin);
    elem_id added = doc_add_element(doc, parent, category, name, like.file, like.line, like.column);
    const struct doc_link *link = like.name == name ? doc_link(doc, origin) : NULL;
    if (link)
        doc_set_name_place(doc, added, link->name_line, link->name_column);
    const char *path = like.line ? NULL : kept_path(doc, origin);
    if (path) /* the new element has the highest number, so the paths stay in order */
        vec_push(doc->arena, &doc->paths, (struct doc_place_path){added, path});
    return added;
}

/*
 * The attributes of an element are contiguous: they move to the end, if others follow them or an
 * origin has them.
 */
static struct element *own_attrs_at_end(struct document *doc, elem_id element)
{
    struct element *e = own(doc, element);
    uint32_t first = doc->first_attr + doc->shared.attrs;
    if (e->first_attr >= first && e->first_attr - first + e->num_attrs == doc->attrs.len)
        return e;
    struct attribute *moved = vec_extend(doc->arena, &doc->attrs, e->num_attrs);
    if (e->num_attrs) /* where they were, which may have moved itself */
        memcpy(moved, attrs_of(doc, e), e->num_attrs * sizeof *moved);
    e->first_attr = first + doc->attrs.len - e->num_attrs;
    return e;
}

void doc_add_attr(struct document *doc, elem_id element, struct attribute attr)
{
    struct element *e = own_attrs_at_end(doc, element);
    if (e->num_attrs == UINT16_MAX)
        mem_fail(doc->arena->mem);
    vec_push(doc->arena, &doc->attrs, attr);
    e->num_attrs++;
}

/* The attributes of an element, to be changed. */
static struct attribute *own_attrs(struct document *doc, elem_id element)
{
    uint32_t first = doc->first_attr + doc->shared.attrs;
    struct element *e = own(doc, element);
    if (e->first_attr < first)
        e = own_attrs_at_end(doc, element);
    assert(e->first_attr - first + e->num_attrs <= doc->attrs.len);
    return doc->attrs.items + (e->first_attr - first);
}

void doc_set_attr(struct document *doc, elem_id element, str_id name, str_id value)
{
    const struct attribute *attr = doc_attr(doc, element, name);
    if (attr && attr->value == value)
        return;
    if (attr) {
        size_t index = (size_t)(attr - doc_attrs(doc, element));
        own_attrs(doc, element)[index].value = value;
    } else {
        doc_add_attr(doc, element, (struct attribute){.name = name, .value = value});
    }
}

void doc_remove_attr(struct document *doc, elem_id element, str_id name)
{
    const struct attribute *found = doc_attr(doc, element, name);
    if (!found)
        return;
    size_t index = (size_t)(found - doc_attrs(doc, element));
    struct attribute *attrs = own_attrs(doc, element);
    struct element *e = own(doc, element);
    assert(index < e->num_attrs);
    memmove(attrs + index, attrs + index + 1, (e->num_attrs - index - 1) * sizeof *attrs);
    e->num_attrs--;
}

void doc_set_category(struct document *doc, elem_id element, str_id category)
{
    own(doc, element)->category = category;
    own(doc, element)->kind = (uint16_t)doc_kind_of(category);
    doc->has_attributedefs |= category == STR_attributedef;
    doc->has_aovs |= category == STR_aov || category == STR_aovpass;
}

void doc_set_name(struct document *doc, elem_id element, str_id name)
{
    own(doc, element)->name = name;
}

void doc_set_name_place(struct document *doc, elem_id element, uint32_t line, uint32_t column)
{
    struct doc_link *link = link_of(doc, element);
    link->name_line = (uint16_t)(line < UINT16_MAX ? line : UINT16_MAX);
    link->name_column = (uint16_t)(column < UINT16_MAX ? column : UINT16_MAX);
}

void doc_set_place(struct document *doc, elem_id element, uint16_t file, uint32_t line,
                   uint16_t column)
{
    struct element *e = own(doc, element);
    e->file = file;
    e->line = line;
    e->column = column;
}

void doc_unlink_element(struct document *doc, elem_id element)
{
    struct element *e = own(doc, element);
    if (!e->parent)
        return;
    elem_id previous = link_of(doc, element)->previous;
    assert(!e->next || link_of(doc, e->next)->previous == element);
    assert(previous ? own(doc, previous)->next == element
                    : own(doc, e->parent)->first_child == element);
    if (previous)
        own(doc, previous)->next = e->next;
    else
        own(doc, e->parent)->first_child = e->next;
    if (e->next)
        link_of(doc, e->next)->previous = previous;
    else
        link_of(doc, e->parent)->last_child = previous;
    e->parent = e->next = 0;
    link_of(doc, element)->previous = 0;
}

void doc_remove_element(struct document *doc, elem_id element)
{
    const struct element *e = own(doc, element);
    if (!e->parent)
        return;
    if (link_of(doc, element)->comments)
        doc_move_comments(doc, element, e->next ? e->next : e->parent,
                          e->next ? COMMENT_BEFORE : COMMENT_LAST);
    doc_unlink_element(doc, element);
}

void doc_move_element(struct document *doc, elem_id element, elem_id new_parent)
{
    doc_unlink_element(doc, element);
    link_last(doc, new_parent, element);
}

void doc_link_after(struct document *doc, elem_id element, elem_id sibling)
{
    elem_id next = own(doc, sibling)->next;
    if (next)
        doc_move_before(doc, element, next);
    else
        doc_move_element(doc, element, own(doc, sibling)->parent);
}

void doc_move_before(struct document *doc, elem_id element, elem_id sibling)
{
    doc_unlink_element(doc, element);
    struct element *e = own(doc, element);
    elem_id previous = link_of(doc, sibling)->previous;
    assert(!previous || own(doc, previous)->next == sibling);
    assert(element != sibling && own(doc, sibling)->parent);
    assert(previous || own(doc, own(doc, sibling)->parent)->first_child == sibling);
    e->parent = own(doc, sibling)->parent;
    e->next = sibling;
    if (previous)
        own(doc, previous)->next = element;
    else
        own(doc, e->parent)->first_child = element;
    link_of(doc, element)->previous = previous;
    link_of(doc, sibling)->previous = element;
    doc_touch_outputs(doc, element, e->parent);
}

uint16_t doc_add_file(struct document *doc, str_id name)
{
    for (uint32_t i = 0; i < doc->files.len; i++)
        if (doc->files.items[i] == name)
            return (uint16_t)(doc->first_file + i);
    if (doc->first_file + doc->files.len > UINT16_MAX)
        return 0;
    vec_push(doc->arena, &doc->files, name);
    return (uint16_t)(doc->first_file + doc->files.len - 1);
}

struct doc_mark doc_mark(const struct document *doc, elem_id root)
{
    return (struct doc_mark){doc->elements.len,      doc->attrs.len,          doc->comments.len,
                             doc->comment_lists.len, *doc_element(doc, root), doc->has_templates};
}

void doc_rollback(struct document *doc, elem_id root, const struct doc_mark *mark)
{
    assert(root - doc->first_element < mark->num_elements);
    assert(mark->num_elements <= doc->elements.len && mark->num_attrs <= doc->attrs.len);
    doc->elements.len = doc->links.len = mark->num_elements;
    doc->attrs.len = mark->num_attrs;
    doc->comments.len = mark->num_comments;
    doc->comment_lists.len = mark->num_comment_lists;
    *own(doc, root) = mark->root;
    *link_of(doc, root) = (struct doc_link){0};
    doc->has_templates = mark->has_templates;
}

/* Reading */

elem_id doc_next_in_tree(const struct document *doc, elem_id root, elem_id element)
{
    const struct element *e = doc_element(doc, element);
    if (e->first_child)
        return e->first_child;
    for (; element != root; element = e->parent, e = doc_element(doc, element))
        if (e->next)
            return e->next;
    return 0;
}

bool doc_is_within(const struct document *doc, elem_id element, elem_id outer)
{
    while (element && element != outer)
        element = doc_element(doc, element)->parent;
    return element != 0;
}

static inline const struct attribute *find_attr(const struct document *doc, elem_id element,
                                                str_id name)
{
    doc = doc_layer(doc, element);
    const struct element *e = doc_element(doc, element);
    if (!e->num_attrs)
        return NULL;
    const struct attribute *attr = attrs_of(doc, e), *end = attr + e->num_attrs;
    while (attr < end && attr->name != name)
        attr++;
    return attr < end ? attr : NULL;
}

const struct attribute *doc_attr(const struct document *doc, elem_id element, str_id name)
{
    return find_attr(doc, element, name);
}

str_id doc_attr_value(const struct document *doc, elem_id element, str_id name)
{
    const struct attribute *attr = find_attr(doc, element, name);
    return attr ? attr->value : STR_EMPTY;
}

bool doc_attr_is_true(const struct document *doc, elem_id element, str_id name)
{
    return doc_attr_value(doc, element, name) == STR_true;
}

elem_id doc_attr_owner(const struct document *doc, elem_id element, str_id name)
{
    while (element && !doc_attr(doc, element, name))
        element = doc_element(doc, element)->parent;
    return element;
}

str_id doc_inherited_attr(const struct document *doc, elem_id element, str_id name)
{
    elem_id owner = doc_attr_owner(doc, element, name);
    return owner ? doc_attr_value(doc, owner, name) : STR_EMPTY;
}

const char *doc_file_name(const struct document *doc, uint16_t file)
{
    if (file == 0)
        return NULL;
    while (file < doc->first_file)
        doc = doc->base;
    assert(file - doc->first_file < (int64_t)doc->files.len);
    return str_text(doc->strings, doc->files.items[file - doc->first_file]);
}

/*
 * Code points of a text, for the length of a place. Of a longer text the beginning is marked, so
 * that many messages about it take linear time.
 */
static uint32_t width_of(const struct document *doc, str_id text)
{
    enum { MAX_WIDTH = 1000 };
    uint32_t width = 0;
    for (const char *c = str_text(doc->strings, text); *c && width < MAX_WIDTH; c++)
        width += (*c & 0xc0) != 0x80;
    return width;
}

/* The path of an element without a line; NULL: `doc` keeps none. */
static const char *find_path(const struct document *doc, elem_id element)
{
    uint32_t first = 0, num = doc->paths.len;
    while (num) {
        uint32_t half = num / 2;
        elem_id at = doc->paths.items[first + half].element;
        if (at == element)
            return doc->paths.items[first + half].path;
        first = at < element ? first + half + 1 : first;
        num = at < element ? num - half - 1 : half;
    }
    return NULL;
}

static const char *kept_path(const struct document *doc, elem_id element)
{
    const char *path = NULL;
    for (doc = doc_layer(doc, element); doc && !path; doc = doc->origin)
        path = find_path(doc, element);
    return path;
}

/* 0 for a column that saturates: a message then shows no place in the line. */
static uint32_t known_column(uint16_t column)
{
    return column < UINT16_MAX ? column : 0;
}

/* A part of an element that has a place of its own in a text. */
enum place_part { PART_ELEMENT, PART_VALUE, PART_NAME };

/* Tells what has a place of its own in the text of the document, but none in the place. */
static uint64_t spot_of(elem_id element, str_id attr, enum place_part part)
{
    return (uint64_t)element << 32 | (uint64_t)attr << 2 | part;
}

struct diag_place doc_place(const struct document *doc, elem_id element)
{
    const struct element *e = doc_element(doc, element);
    return (struct diag_place){.file = doc_file_name(doc, e->file),
                               .path = kept_path(doc, element),
                               .line = e->line,
                               .column = known_column(e->column),
                               .length = 1 + width_of(doc, e->category),
                               .spot = e->line ? 0 : spot_of(element, 0, PART_ELEMENT)};
}

struct diag_place doc_name_place(const struct document *doc, elem_id element)
{
    struct diag_place place = doc_place(doc, element);
    const struct doc_link *link = doc_link(doc, element);
    if (place.spot && doc_element(doc, element)->name)
        place.spot = spot_of(element, 0, PART_NAME);
    if (!link || !link->name_column)
        return place;
    place.line += link->name_line;
    place.column = known_column(link->name_column);
    place.length = width_of(doc, doc_element(doc, element)->name);
    return place;
}

struct diag_place doc_attr_place(const struct document *doc, elem_id element, str_id attr)
{
    struct diag_place place = doc_place(doc, element);
    const struct attribute *found = doc_attr(doc, element, attr);
    if (found && found->column && place.line) {
        place.line = (uint32_t)((int64_t)place.line + found->line_delta);
        place.column = known_column(found->column);
        place.length = width_of(doc, found->value);
    } else if (found) {
        place.spot = spot_of(element, attr, PART_VALUE);
    }
    return place;
}

struct diag_place doc_attr_name_place(const struct document *doc, elem_id element, str_id attr)
{
    struct diag_place place = doc_attr_place(doc, element, attr);
    const struct attribute *found = doc_attr(doc, element, attr);
    uint32_t width = width_of(doc, attr), before = width + 2; /* name=" */
    if (place.spot && found)
        place.spot = spot_of(element, attr, PART_NAME);
    if (place.spot || !found || place.column <= before || doc_layer(doc, element)->has_loose_attrs)
        return place;
    place.column -= before;
    place.length = width;
    return place;
}

/* Names */

static bool is_named_child(const struct document *doc, elem_id element)
{
    const struct element *e = doc_element(doc, element);
    return e->name && e->parent;
}

static bool is_child(const struct document *doc, elem_id element, elem_id parent, str_id name)
{
    const struct element *e = doc_element(doc, element);
    return e->parent == parent && e->name == name;
}

/*
 * The element of this name below a parent; 0: none. *at is its place in the table, which is that of
 * the document or of its origin.
 */
static elem_id find_in_table(const struct document *doc, const struct table *names, elem_id parent,
                             str_id name, uint32_t *at)
{
    uint32_t hash = *at = hash_pair(parent, name);
    elem_id found;
    while ((found = table_next(names, hash, at)) && !is_child(doc, found, parent, name))
        ;
    return found;
}

static elem_id find_name(const struct document *doc, elem_id parent, str_id name, uint32_t *at)
{
    elem_id found = find_in_table(doc, &doc->names, parent, name, at);
    uint32_t other;
    for (const struct document *below = doc->origin; below && !found; below = below->origin)
        found = find_in_table(doc, &below->names, parent, name, &other);
    return found;
}

bool doc_has_element(const struct document *doc, elem_id element)
{
    return element >= doc->first_element && element - doc->first_element < doc_num_elements(doc)
           && doc_is_within(doc, element, doc->root);
}

void doc_index_element(struct document *doc, elem_id element)
{
    assert(element >= doc->first_element);
    if (!is_named_child(doc, element))
        return;
    const struct element *e = doc_element(doc, element);
    uint32_t at;
    if (find_in_table(doc, &doc->names, e->parent, e->name, &at))
        table_replace(&doc->names, at, element);
    else
        table_add(&doc->names, doc->arena, hash_pair(e->parent, e->name), element);
}

elem_id doc_child(const struct document *doc, elem_id parent, str_id name)
{
    uint32_t at;
    doc = doc_layer(doc, parent);
    return name ? find_name(doc, parent, name, &at) : 0;
}

elem_id doc_child_of_kind(const struct document *doc, elem_id parent, enum element_kind kind,
                          str_id name)
{
    elem_id child = doc_child(doc, parent, name);
    return child && doc_element(doc, child)->kind == kind ? child : 0;
}

elem_id doc_top_level(const struct document *doc, enum element_kind kind, str_id name)
{
    elem_id found = 0;
    for (; doc && !found; doc = doc->base)
        found = doc_child_of_kind(doc, doc->root, kind, name);
    return found;
}

/* A top-level name prefixed with the namespace of the root; 0: no such string exists. */
static str_id qualified(const struct document *doc, const char *name, size_t len)
{
    str_id namespace = doc_attr_value(doc, doc->root, STR_namespace);
    char text[256];
    size_t prefix = str_len(doc->strings, namespace);
    if (!namespace || prefix + 1 + len > sizeof text)
        return 0;
    memcpy(text, str_text(doc->strings, namespace), prefix);
    text[prefix] = ':';
    memcpy(text + prefix + 1, name, len);
    return str_find(doc->strings, text, prefix + 1 + len);
}

/*
 * The child whose name is at `*at` of a path; moves `*at` behind the name. Names that are not valid
 * may contain a '/': where no child has the shortest name, a few longer ones are tried.
 */
static elem_id find_step(const struct document *doc, elem_id element, const char *path, size_t len,
                         size_t *at)
{
    const unsigned most_slashes = 8;
    elem_id child = 0;
    size_t end = *at;
    for (unsigned i = 0; i <= most_slashes && !child && end < len; i++) {
        size_t from = i ? end + 1 : end;
        const char *slash = memchr(path + from, '/', len - from);
        end = slash ? (size_t)(slash - path) : len;
        child = doc_child(doc, element, str_find(doc->strings, path + *at, end - *at));
        if (!child && element == doc->root)
            child = doc_child(doc, element, qualified(doc, path + *at, end - *at));
    }
    *at = end + 1;
    return child;
}

elem_id doc_find_below(const struct document *doc, elem_id below, const char *path, size_t len)
{
    elem_id element = below;
    while (len && *path == '/')
        path++, len--;
    for (size_t at = 0; at < len && element;)
        element = find_step(doc, element, path, len, &at);
    return element;
}

elem_id doc_find(const struct document *doc, const char *path, size_t len)
{
    while (len && *path == '/')
        path++, len--;
    elem_id found = 0;
    for (; doc && !found && len; doc = doc->base)
        found = doc_find_below(doc, doc->root, path, len);
    return found;
}

void doc_path(const struct document *doc, elem_id element, char separator, struct text *out)
{
    size_t start = out->len;
    elem_id top = element;
    size_t len = 0;
    for (; doc_element(doc, top)->parent; top = doc_element(doc, top)->parent)
        len += str_len(doc->strings, doc_element(doc, top)->name) + 1;
    if (len == 0)
        return;
    text_reserve(out, len);
    out->len = start + len - 1;
    for (size_t end = out->len; element != top; element = doc_element(doc, element)->parent) {
        str_id name = doc_element(doc, element)->name;
        size_t size = str_len(doc->strings, name);
        memcpy(out->data + end - size, str_text(doc->strings, name), size);
        end -= size;
        if (end > start)
            out->data[--end] = separator;
    }
}
