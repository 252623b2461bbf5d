// SPDX-License-Identifier: Apache-2.0
#include "check/by_element.h"

#include "program/memory.h"
#include "program/name_table.h"

#include <stdlib.h>

typedef const char *element_of(const struct check_document *document, size_t index);

static const char *element_of_message(const struct check_document *document, size_t index)
{
    return document->messages[index].element;
}

static const char *element_of_change(const struct check_document *document, size_t index)
{
    return document->changes[index].element;
}

/* Elements by path, and the part of all others. */
struct parts {
    struct name_table elements;
    size_t other;
};

static size_t part_of(const struct parts *parts, const char *element)
{
    const struct name_entry *entry = *element ? names_find(&parts->elements, element) : NULL;
    return entry ? (size_t)entry->value : parts->other;
}

/* Sorts the indices by part, equal ones in order. The begins are of all parts, and one more. */
static uint32_t *sort(const struct check_document *document, const struct parts *parts,
                      element_of *element, size_t count, uint32_t *begins)
{
    uint32_t *sorted = memory_alloc((count + 1) * sizeof *sorted);
    for (size_t i = 0; i < count; ++i)
        ++begins[part_of(parts, element(document, i))];
    for (size_t i = 0; i <= document->num_elements; ++i)
        begins[i + 1] += begins[i]; /* now the end of part i stands at i */
    for (size_t i = count; i-- > 0;)
        sorted[--begins[part_of(parts, element(document, i))]] = (uint32_t)i;
    begins[document->num_elements + 1] = (uint32_t)count;
    return sorted;
}

void by_element_init(struct by_element *by, const struct check_document *document)
{
    struct parts parts = {.other = document->num_elements == 1};
    size_t num_begins = document->num_elements + 2;
    *by = (struct by_element){.document = document};
    by->message_begins = memory_alloc(num_begins * sizeof *by->message_begins);
    by->change_begins = memory_alloc(num_begins * sizeof *by->change_begins);
    for (size_t i = 0; i < document->num_elements; ++i) {
        bool is_new;
        struct name_entry *entry = names_add(&parts.elements, document->elements[i].path, &is_new);
        if (is_new)
            entry->value = i + 1;
    }
    by->messages =
        sort(document, &parts, element_of_message, document->num_messages, by->message_begins);
    by->changes =
        sort(document, &parts, element_of_change, document->num_changes, by->change_begins);
    names_finish(&parts.elements);
}

struct index_list by_element_messages(const struct by_element *by, size_t part)
{
    uint32_t begin = by->message_begins[part];
    return (struct index_list){by->messages + begin, by->message_begins[part + 1] - begin};
}

struct index_list by_element_changes(const struct by_element *by, size_t part)
{
    uint32_t begin = by->change_begins[part];
    return (struct index_list){by->changes + begin, by->change_begins[part + 1] - begin};
}

void by_element_finish(struct by_element *by)
{
    free(by->messages);
    free(by->changes);
    free(by->message_begins);
    free(by->change_begins);
}
