// SPDX-License-Identifier: Apache-2.0
#include "lsp/query.h"

#include "lsp/element_infos.h"

#include <string.h>

bool query_equals(const struct text *text, struct span span, const char *word)
{
    size_t len = strlen(word);
    return span.end - span.start == len && memcmp(text->bytes + span.start, word, len) == 0;
}

bool query_is_same(const struct text *text, struct span a, struct span b)
{
    return a.end - a.start == b.end - b.start
           && memcmp(text->bytes + a.start, text->bytes + b.start, a.end - a.start) == 0;
}

uint32_t query_parent(const struct lsp_query *query, uint32_t element)
{
    return element == MODEL_NONE ? element : query->model->elements[element].parent;
}

bool query_is(const struct lsp_query *query, uint32_t element, const char *category)
{
    return element != MODEL_NONE
           && query_equals(query->text, query->model->elements[element].name, category);
}

const struct model_attribute *query_attribute(const struct lsp_query *query, uint32_t element,
                                              const char *name)
{
    if (element == MODEL_NONE)
        return NULL;
    const struct model_element *owner = &query->model->elements[element];
    for (uint32_t i = 0; i < owner->num_attributes; ++i) {
        const struct model_attribute *attribute =
            &query->model->attributes[owner->first_attribute + i];
        if (query_equals(query->text, attribute->name, name))
            return attribute;
    }
    return NULL;
}

struct span query_value(const struct lsp_query *query, uint32_t element, const char *name)
{
    const struct model_attribute *attribute = query_attribute(query, element, name);
    return attribute ? attribute->value : (struct span){0, 0};
}

static const char *copy(const struct text *text, struct span span, char *buffer, size_t capacity)
{
    size_t len = span.end - span.start;
    len = len < capacity ? len : capacity - 1;
    memcpy(buffer, text->bytes + span.start, len);
    buffer[len] = '\0';
    return buffer;
}

const char *query_text(const struct lsp_query *query, uint32_t element, const char *name,
                       char *buffer, size_t capacity)
{
    return copy(query->text, query_value(query, element, name), buffer, capacity);
}

const char *query_category(const struct lsp_query *query, uint32_t element, char *buffer,
                           size_t capacity)
{
    struct span none = {0, 0};
    return copy(query->text, element == MODEL_NONE ? none : query->model->elements[element].name,
                buffer, capacity);
}

uint32_t query_child(const struct lsp_query *query, uint32_t parent, struct span name)
{
    if (name.start == name.end)
        return MODEL_NONE;
    uint32_t child = model_first(query->model, parent);
    while (child != MODEL_NONE
           && !query_is_same(query->text, query_value(query, child, "name"), name))
        child = model_next(query->model, child);
    return child;
}

uint32_t query_root(const struct lsp_query *query)
{
    uint32_t root = model_first(query->model, MODEL_NONE);
    while (root != MODEL_NONE && !query_is(query, root, "materialx"))
        root = model_next(query->model, root);
    return root;
}

uint32_t query_child_of(const struct lsp_query *query, uint32_t parent, const char *category,
                        struct span name)
{
    if (parent == MODEL_NONE)
        return parent;
    uint32_t child = model_first(query->model, parent);
    while (child != MODEL_NONE
           && !(query_is(query, child, category)
                && query_is_same(query->text, query_value(query, child, "name"), name)))
        child = model_next(query->model, child);
    return child;
}

uint32_t query_at_root(const struct lsp_query *query, struct span name)
{
    uint32_t root = query_root(query);
    return root == MODEL_NONE ? root : query_child(query, root, name);
}

uint32_t query_around(const struct lsp_query *query, uint32_t element, const char *category)
{
    while (element != MODEL_NONE && !query_is(query, element, category))
        element = query->model->elements[element].parent;
    return element;
}

bool query_is_node(const struct lsp_query *query, uint32_t element)
{
    char category[QUERY_NAME];
    return element != MODEL_NONE && !query->model->elements[element].is_comment
           && !elements_find(query_category(query, element, category, sizeof category));
}

/* In the start tag: the attribute that has the offset. */
static struct place place_in_tag(const struct lsp_query *query, uint32_t element)
{
    const struct model_element *owner = &query->model->elements[element];
    struct place place = {PLACE_TAG, element, NULL};
    if (query->offset <= owner->name.end)
        place.part = PLACE_CATEGORY;
    for (uint32_t i = 0; i < owner->num_attributes; ++i) {
        const struct model_attribute *attribute =
            &query->model->attributes[owner->first_attribute + i];
        bool is_in_name =
            query->offset >= attribute->name.start && query->offset <= attribute->name.end;
        bool is_in_value = attribute->has_value && attribute->value.start > attribute->name.end + 1
                           && query->offset >= attribute->value.start
                           && query->offset <= attribute->value.end;
        if (is_in_name || is_in_value)
            place = (struct place){is_in_name ? PLACE_ATTRIBUTE : PLACE_VALUE, element, attribute};
    }
    return place;
}

struct place query_place(const struct lsp_query *query)
{
    uint32_t element = model_element_at(query->model, query->offset);
    if (element == MODEL_NONE)
        return (struct place){PLACE_CONTENT, MODEL_NONE, NULL};
    const struct model_element *owner = &query->model->elements[element];
    uint32_t offset = query->offset;
    bool is_behind = offset == owner->end && !owner->is_broken;
    if (offset == owner->start || is_behind)
        return (struct place){PLACE_CONTENT, owner->parent, NULL};
    if (owner->is_comment)
        return (struct place){PLACE_COMMENT, element, NULL};
    if (offset < owner->tag_end || (owner->is_broken && offset <= owner->end))
        return place_in_tag(query, element);
    if (owner->close < owner->end && offset > owner->close)
        return (struct place){PLACE_END_TAG, element, NULL};
    return (struct place){PLACE_CONTENT, element, NULL};
}
