// SPDX-License-Identifier: Apache-2.0
/*
 * The messages and changes of a document, by element: reports that have a part per element look at
 * each of them once, however many elements there are.
 */
#ifndef MXG_CHECK_BY_ELEMENT_H
#define MXG_CHECK_BY_ELEMENT_H

#include "check/record.h"

/* Indices of messages or changes of the document, in its order. */
struct index_list {
    const uint32_t *items;
    uint32_t count;
};

struct by_element {
    const struct check_document *document;
    uint32_t *messages, *changes;
    uint32_t *message_begins, *change_begins; /* per part, with the end of the last one */
};

/*
 * Parts: element i is i + 1; 0 is the document, with all that names none of its elements. An only
 * element has that, too.
 */
void by_element_init(struct by_element *by, const struct check_document *document);
struct index_list by_element_messages(const struct by_element *by, size_t part);
struct index_list by_element_changes(const struct by_element *by, size_t part);
void by_element_finish(struct by_element *by);

#endif
