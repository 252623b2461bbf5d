// SPDX-License-Identifier: Apache-2.0
#include "lsp/completion.h"

#include "lsp/handlers.h"
#include "lsp/wire.h"
#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

char *completion_escape(const char *value)
{
    char *escaped = memory_alloc(strlen(value) * 2 + 1), *out = escaped;
    for (; *value; ++value) {
        if (strchr("$}\\", *value))
            *out++ = '\\';
        *out++ = *value;
    }
    return escaped;
}

enum { MAX_ITEMS = 400 }; /* of an answer; the editor asks again when more is typed */

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c | 0x20) : c;
}

/* True if the letters that are typed occur in the text in their order, as editors compare. */
static bool is_typed(const struct completion *completion, const char *text)
{
    const char *bytes = completion->query.text->bytes;
    uint32_t at = completion->replaced.start, end = completion->query.offset;
    for (; *text && at < end; ++text)
        at += lower(*text) == lower(bytes[at]);
    return at >= end;
}

/* The items share the object of their range. */
static json_t *range_of(struct completion *completion)
{
    struct span replaced = completion->replaced;
    bool is_same =
        replaced.start == completion->ranged.start && replaced.end == completion->ranged.end;
    if (!completion->range || !is_same) {
        json_decref(completion->range);
        completion->range = wire_range(completion->query.session, completion->query.text, replaced);
        completion->ranged = replaced;
    }
    return completion->range;
}

void completion_add(struct completion *completion, struct completion_item item)
{
    const struct lsp_session *session = completion->query.session;
    if (!is_typed(completion, item.filter ? item.filter : item.label))
        return;
    completion->is_cut = json_array_size(completion->items) == MAX_ITEMS;
    if (completion->is_cut)
        return;
    bool is_snippet = item.snippet && session->has_snippets;
    const char *text = is_snippet ? item.snippet : item.text ? item.text : item.label;
    json_t *object = json_object();
    json_object_set_new(object, "label", json_text(item.label));
    json_object_set_new(object, "kind", json_integer(item.kind));
    json_set_text(object, "detail", item.detail);
    json_set_text(object, "documentation", item.doc);
    json_set_text(object, "filterText", item.filter);
    if (item.is_first) {
        json_object_set_new(object, "sortText", json_sprintf(" %s", item.label));
        json_object_set_new(object, "preselect", json_true());
    }
    if (is_snippet)
        json_object_set_new(object, "insertTextFormat", json_integer(2));
    json_t *edit = json_object();
    json_object_set(edit, "range", range_of(completion));
    json_object_set_new(edit, "newText", json_text(text));
    json_object_set_new(object, "textEdit", edit);
    json_array_append_new(completion->items, object);
}

static bool is_word(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'
           || c == ':';
}

/* The word at the cursor, between elements or attributes. */
static struct span word_at(const struct lsp_query *query)
{
    const char *bytes = query->text->bytes;
    struct span word = {query->offset, query->offset};
    while (word.start > 0 && is_word(bytes[word.start - 1]))
        --word.start;
    while (word.end < query->text->len && is_word(bytes[word.end]))
        ++word.end;
    return word;
}

/* The innermost element that is open where an end tag begins. */
static uint32_t open_at(const struct lsp_query *query, uint32_t end_tag)
{
    const char *bytes = query->text->bytes;
    uint32_t found = MODEL_NONE;
    for (uint32_t i = 0; i < query->model->num_elements; ++i) {
        const struct model_element *element = &query->model->elements[i];
        bool is_empty = element->tag_end >= 2 && bytes[element->tag_end - 2] == '/';
        if (!element->is_comment && !is_empty && element->tag_end <= end_tag
            && end_tag <= element->close)
            found = i;
    }
    return found;
}

static void complete_end(struct completion *completion)
{
    const struct lsp_query *query = &completion->query;
    uint32_t open = open_at(query, completion->replaced.start - 2);
    char name[QUERY_NAME], text[QUERY_NAME + 1];
    if (open == MODEL_NONE)
        return;
    query_category(query, open, name, sizeof name);
    size_t len = strlen(name);
    memcpy(text, name, len);
    memcpy(text + len, ">", 2);
    completion->replaced = word_at(query);
    if (query->text->bytes[completion->replaced.end] == '>')
        text[len] = '\0';
    completion_add(completion,
                   (struct completion_item){.label = name, .kind = COMPLETE_CLASS, .text = text});
}

static bool is_end_tag(const struct lsp_query *query, struct span word)
{
    const char *bytes = query->text->bytes;
    return word.start >= 2 && bytes[word.start - 1] == '/' && bytes[word.start - 2] == '<';
}

static void complete(struct completion *completion)
{
    struct lsp_query *query = &completion->query;
    struct place *place = &completion->place;
    completion->replaced = word_at(query);
    if (place->part == PLACE_COMMENT)
        return;
    if (is_end_tag(query, completion->replaced)) {
        complete_end(completion);
    } else if (place->part == PLACE_VALUE) {
        completion->replaced = place->attribute->value;
        complete_values(completion);
    } else if (place->part == PLACE_TAG || place->part == PLACE_ATTRIBUTE) {
        complete_attributes(completion);
    } else if (place->part != PLACE_END_TAG) {
        complete_elements(completion);
    }
}

json_t *handle_completion(struct lsp_session *session, const json_t *params,
                          struct lsp_error *error)
{
    struct completion completion = {.items = NULL};
    if (!lsp_query(session, params, &completion.query, error))
        return NULL;
    completion.items = json_array();
    completion.place = query_place(&completion.query);
    complete(&completion);
    json_t *list = json_object();
    json_object_set_new(list, "isIncomplete", json_boolean(completion.is_cut));
    json_object_set_new(list, "items", completion.items);
    json_decref(completion.range);
    return list;
}
