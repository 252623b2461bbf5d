// SPDX-License-Identifier: Apache-2.0
/*
 * Elements of equal names in one scope. All but the first are left out of the tree, so that nothing
 * else meets them. They keep their places: the writer writes them, and an edit puts them back,
 * since a change of the first one may make them count.
 */
#include "base/hash.h"
#include "document/document.h"

#include <assert.h>

/* True if two elements have equal content, so that the second one is redundant. */
static bool are_equal(const struct document *doc, elem_id a, elem_id b)
{
    elem_id root_a = a, root_b = b;
    while (a && b) {
        const struct element *ea = doc_element(doc, a), *eb = doc_element(doc, b);
        if (ea->category != eb->category || ea->name != eb->name || ea->num_attrs != eb->num_attrs
            || !ea->first_child != !eb->first_child || (a != root_a && !ea->next != !eb->next))
            return false;
        for (uint32_t i = 0; i < ea->num_attrs; i++) {
            const struct attribute *attr = &doc_attrs(doc, a)[i],
                                   *other = doc_attr(doc, b, attr->name);
            if (!other || other->value != attr->value)
                return false;
        }
        a = doc_next_in_tree(doc, root_a, a);
        b = doc_next_in_tree(doc, root_b, b);
    }
    return a == b;
}

/*
 * True for implementations in two files: libraries may replace each other's, so their index decides
 * between them. Equal text with a `file` names another file in another folder.
 */
static bool are_rivals(const struct document *doc, elem_id first, elem_id second, bool equal)
{
    if (doc_element(doc, first)->kind != KIND_IMPLEMENTATION
        || doc_element(doc, second)->kind != KIND_IMPLEMENTATION
        || (equal && !doc_attr(doc, second, STR_file)))
        return false;
    const char *file = doc_place(doc, first).file, *other = doc_place(doc, second).file;
    return file && other && strcmp(file, other) != 0;
}

/* ---- Places ---- */

static struct doc_left_out *find_left_out(const struct document *doc, uint32_t hash, bool by_anchor,
                                          elem_id wanted)
{
    uint32_t at = hash;
    for (uint32_t found; (found = table_next(&doc->left_out_table, hash, &at));) {
        struct doc_left_out *left = &doc->left_out.items[found - 1];
        if ((by_anchor ? left->anchor : left->element) == wanted)
            return left;
    }
    return NULL;
}

static uint32_t hash_of(elem_id element, bool is_anchor)
{
    return hash_pair(element, is_anchor);
}

/* The first one behind an element; NULL: there is none. */
static struct doc_left_out *first_behind(const struct document *doc, elem_id anchor)
{
    return find_left_out(doc, hash_of(anchor, true), true, anchor);
}

static void leave_out(struct document *doc, elem_id element)
{
    const struct doc_link *link = doc_link(doc, element);
    elem_id anchor = link->previous ? link->previous : doc_element(doc, element)->next;
    struct doc_left_out *first = first_behind(doc, anchor);
    uint32_t added = doc->left_out.len + 1;
    if (first) {
        doc->left_out.items[first->last - 1].next = added;
        first->last = added;
    } else {
        table_add(&doc->left_out_table, doc->arena, hash_of(anchor, true), added);
    }
    vec_push(doc->arena, &doc->left_out,
             (struct doc_left_out){element, anchor, .last = first ? 0 : added});
    table_add(&doc->left_out_table, doc->arena, hash_of(element, false), added);
    doc_unlink_element(doc, element);
}

elem_id doc_next_written(const struct document *doc, elem_id element)
{
    if (!doc->left_out.len)
        return doc_element(doc, element)->next;
    const struct doc_left_out *behind = first_behind(doc, element);
    if (behind)
        return behind->element;
    const struct doc_left_out *left;
    while ((left = find_left_out(doc, hash_of(element, false), false, element)) != NULL) {
        if (left->next)
            return doc->left_out.items[left->next - 1].element;
        element = left->anchor;
    }
    return doc_element(doc, element)->next;
}

elem_id doc_parent_written(const struct document *doc, elem_id element)
{
    const struct doc_left_out *left;
    while (doc->left_out.len
           && (left = find_left_out(doc, hash_of(element, false), false, element)) != NULL)
        element = left->anchor;
    return doc_element(doc, element)->parent;
}

bool doc_restore_left_out(struct document *doc, const struct document *from)
{
    for (uint32_t i = from->left_out.len; i-- > 0;)
        doc_link_after(doc, from->left_out.items[i].element, from->left_out.items[i].anchor);
    return from->left_out.len != 0;
}

/* ---- Reports ---- */

void doc_leave_out_duplicate(struct document *doc, elem_id first, elem_id second,
                             struct diag_list *diags)
{
    bool equal = are_equal(doc, first, second);
    if (are_rivals(doc, first, second, equal))
        return;
    diag_add(diags, equal ? DIAG_ID_repeated_element : DIAG_ID_duplicate_name,
             doc_name_place(doc, second), doc_name(doc, second));
    diag_add(diags, DIAG_ID_previous_definition, doc_name_place(doc, first));
    leave_out(doc, second);
    if (equal || doc_second_of_name(doc, first))
        return;
    vec_push(doc->arena, &doc->doubles, (struct doc_double){first, second});
    table_add(&doc->double_table, doc->arena, hash_pair(first, 0), doc->doubles.len);
}

elem_id doc_second_of_name(const struct document *doc, elem_id element)
{
    doc = doc_layer(doc, element);
    doc = doc->origin ? doc->whole : doc;
    uint32_t at = hash_pair(element, 0);
    for (uint32_t found;
         doc->doubles.len && (found = table_next(&doc->double_table, hash_pair(element, 0), &at));)
        if (doc->doubles.items[found - 1].first == element)
            return doc->doubles.items[found - 1].second;
    return 0;
}

void doc_index_names(struct document *doc, struct diag_list *diags)
{
    assert(!doc->origin);
    doc->names = (struct table){0};
    table_reserve(&doc->names, doc->arena, doc->elements.len / 3 * 2); /* three of four are used */
    for (uint32_t i = 0; i < doc->elements.len; i++) {
        elem_id element = doc->first_element + i;
        const struct element *e = &doc->elements.items[i];
        if (!e->name || !e->parent)
            continue;
        elem_id first = doc_child(doc, e->parent, e->name);
        if (first && diags && doc_has_element(doc, element))
            doc_leave_out_duplicate(doc, first, element, diags);
        if (!first)
            table_add(&doc->names, doc->arena, hash_pair(e->parent, e->name), element);
    }
}
