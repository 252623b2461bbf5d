// SPDX-License-Identifier: Apache-2.0
/* Comments and blank lines of files, which belong to elements. Lists, so that they move in constant
 * time. */
#include "document/document.h"

#include <assert.h>

static struct doc_link *link_of(struct document *doc, elem_id element)
{
    assert(element - doc->first_element < doc->links.len);
    return &doc->links.items[element - doc->first_element];
}

static struct comment_lists *lists_of(struct document *doc, elem_id element)
{
    struct doc_link *link = link_of(doc, element);
    if (!link->comments) {
        vec_push(doc->arena, &doc->comment_lists, (struct comment_lists){0});
        link->comments = doc->comment_lists.len;
    }
    return &doc->comment_lists.items[link->comments - 1];
}

void doc_add_comment(struct document *doc, elem_id element, enum comment_place place, str_id text)
{
    struct comment_lists *lists = lists_of(doc, element);
    vec_push(doc->arena, &doc->comments, (struct doc_comment){.text = text});
    uint32_t added = doc->comments.len;
    if (lists->last[place])
        doc->comments.items[lists->last[place] - 1].next = added;
    else
        lists->first[place] = added;
    lists->last[place] = added;
}

/* Puts list `from` behind list `to`, and empties it. */
static void append(struct document *doc, uint32_t *to_first, uint32_t *to_last,
                   uint32_t *from_first, uint32_t *from_last)
{
    assert(!*from_first == !*from_last && !*to_first == !*to_last);
    if (*to_last)
        doc->comments.items[*to_last - 1].next = *from_first;
    else
        *to_first = *from_first;
    if (*from_last)
        *to_last = *from_last;
    *from_first = *from_last = 0;
}

void doc_move_comments(struct document *doc, elem_id from, elem_id to, enum comment_place place)
{
    assert(from != to && place != COMMENT_BEHIND);
    lists_of(doc, to); /* may move all lists */
    struct comment_lists *source = lists_of(doc, from), *target = lists_of(doc, to), moved = {0};
    for (unsigned i = 0; i < NUM_COMMENT_PLACES; i++)
        append(doc, &moved.first[0], &moved.last[0], &source->first[i], &source->last[i]);
    if (place == COMMENT_BEFORE) { /* they come before the comments that are there */
        append(doc, &moved.first[0], &moved.last[0], &target->first[place], &target->last[place]);
    }
    append(doc, &target->first[place], &target->last[place], &moved.first[0], &moved.last[0]);
}

uint32_t doc_first_comment(const struct document *doc, elem_id element, enum comment_place place)
{
    if (element < doc->first_element || !doc->comments.len)
        return 0;
    assert(element - doc->first_element < doc->links.len);
    uint32_t lists = doc->links.items[element - doc->first_element].comments;
    return lists ? doc->comment_lists.items[lists - 1].first[place] : 0;
}
