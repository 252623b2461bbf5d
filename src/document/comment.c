// SPDX-License-Identifier: Apache-2.0
/* Comments and blank lines of files, which belong to elements. Lists, so that they move in constant
 * time. */
#include "document/document.h"

#include <assert.h>

/* The lists of an element by its link's number. */
static const struct comment_lists *lists_at(const struct document *doc, uint32_t lists)
{
    while (lists <= doc->shared.comment_lists)
        doc = doc->origin;
    return &doc->comment_lists.items[lists - 1 - doc->shared.comment_lists];
}

const struct doc_comment *doc_comment_at(const struct document *doc, uint32_t comment)
{
    assert(comment > 0 && comment <= doc->shared.comments + doc->comments.len);
    while (comment <= doc->shared.comments)
        doc = doc->origin;
    return &doc->comments.items[comment - 1 - doc->shared.comments];
}

static struct doc_comment *own_comment(struct document *doc, uint32_t comment)
{
    assert(comment > doc->shared.comments);
    return &doc->comments.items[comment - 1 - doc->shared.comments];
}

/* Appends a comment to a list of own comments. */
static void push(struct document *doc, struct comment_lists *lists, unsigned place, str_id text)
{
    vec_push(doc->arena, &doc->comments, (struct doc_comment){.text = text});
    uint32_t added = doc->shared.comments + doc->comments.len;
    if (lists->last[place])
        own_comment(doc, lists->last[place])->next = added;
    else
        lists->first[place] = added;
    lists->last[place] = added;
}

/* A copy of lists that the document shares. */
static struct comment_lists copied(struct document *doc, const struct comment_lists *from)
{
    struct comment_lists copy = {0};
    for (unsigned place = 0; place < NUM_COMMENT_PLACES; place++)
        for (uint32_t i = from->first[place]; i; i = doc_comment_at(doc, i)->next)
            push(doc, &copy, place, doc_comment_at(doc, i)->text);
    return copy;
}

/* The lists of an element, to be changed. */
static struct comment_lists *lists_of(struct document *doc, elem_id element)
{
    struct doc_link *link = doc_own_link(doc, element);
    uint32_t shared = doc->shared.comment_lists, have = link->comments;
    if (!have || have <= shared) {
        struct comment_lists lists =
            have ? copied(doc, lists_at(doc, have)) : (struct comment_lists){0};
        vec_push(doc->arena, &doc->comment_lists, lists);
        link->comments = shared + doc->comment_lists.len;
    }
    return &doc->comment_lists.items[link->comments - 1 - shared];
}

void doc_add_comment(struct document *doc, elem_id element, enum comment_place place, str_id text)
{
    push(doc, lists_of(doc, element), place, text);
}

/* Puts list `from` behind list `to`, and empties it. */
static void append(struct document *doc, uint32_t *to_first, uint32_t *to_last,
                   uint32_t *from_first, uint32_t *from_last)
{
    assert(!*from_first == !*from_last && !*to_first == !*to_last);
    if (*to_last)
        own_comment(doc, *to_last)->next = *from_first;
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
    lists_of(doc, from);
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
    if (element < doc->first_element || doc->shared.comments + doc->comments.len == 0)
        return 0;
    const struct doc_link *link = doc_link(doc, element);
    return link && link->comments ? lists_at(doc, link->comments)->first[place] : 0;
}
