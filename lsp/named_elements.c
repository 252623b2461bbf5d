// SPDX-License-Identifier: Apache-2.0
#include "lsp/named_elements.h"

#include "lsp/definition_inputs.h"

#include <stdio.h>
#include <string.h>

static uint32_t parent_of(const struct lsp_query *query, uint32_t element)
{
    return element == MODEL_NONE ? element : query->model->elements[element].parent;
}

/* An <output> names nodes beside it; an <input> names those beside the element that has it. */
uint32_t names_scope(const struct lsp_query *query, uint32_t element)
{
    uint32_t owner = parent_of(query, element);
    return query_is(query, element, "output") ? owner : parent_of(query, owner);
}

const char *names_own_type(const struct lsp_query *query, uint32_t element, char *buffer,
                           size_t capacity)
{
    mxg_port port = {.type = ""};
    query_text(query, element, "type", buffer, capacity);
    if (!*buffer && query_is(query, element, "input") && catalogue_port_of(query, element, &port))
        snprintf(buffer, capacity, "%s", port.type);
    return buffer;
}

const char *names_type(const struct lsp_query *query, uint32_t element, char *buffer,
                       size_t capacity)
{
    mxg_port port = {.type = ""};
    if (query_is(query, element, "input") && catalogue_port_of(query, element, &port))
        snprintf(buffer, capacity, "%s", port.type);
    else
        query_text(query, element, "type", buffer, capacity);
    return buffer;
}

const char *names_file_prefix(const struct lsp_query *query, uint32_t element, char *buffer,
                              size_t capacity)
{
    while (element != MODEL_NONE && !query_attribute(query, element, "fileprefix"))
        element = parent_of(query, element);
    return query_text(query, element, "fileprefix", buffer, capacity);
}

const struct model_attribute *names_file(const struct lsp_query *query, uint32_t element,
                                         char *prefix, size_t capacity)
{
    *prefix = '\0';
    if (query_is(query, element, "xi:include"))
        return query_attribute(query, element, "href");
    if (!query_is(query, element, "input")
        || !query_equals(query->text, query_value(query, element, "type"), "filename"))
        return NULL;
    names_file_prefix(query, element, prefix, capacity);
    return query_attribute(query, element, "value");
}

/* ---- What a name means ---- */

static uint32_t at_root(const struct lsp_query *query, uint32_t element, struct span name)
{
    (void)element;
    return query_at_root(query, name);
}

static uint32_t in_scope(const struct lsp_query *query, uint32_t element, struct span name)
{
    uint32_t scope = names_scope(query, element);
    uint32_t found = scope == MODEL_NONE ? scope : query_child(query, scope, name);
    return found != MODEL_NONE && query_is(query, found, "input") ? MODEL_NONE : found;
}

/* The look that a <lookgroup> has by default; other defaults are values. */
static uint32_t of_group(const struct lsp_query *query, uint32_t element, struct span name)
{
    return query_is(query, element, "lookgroup") ? at_root(query, element, name) : MODEL_NONE;
}

/* A nodegraph stands beside the element that reads it, or at the root. */
static uint32_t graph_of(const struct lsp_query *query, uint32_t element, struct span name)
{
    uint32_t scope = names_scope(query, element),
             beside = scope == MODEL_NONE ? scope : query_child(query, scope, name);
    return query_is(query, beside, "nodegraph") ? beside : at_root(query, element, name);
}

static uint32_t output_of_source(const struct lsp_query *query, uint32_t element, struct span name)
{
    struct span graph = query_value(query, element, "nodegraph");
    if (graph.start == graph.end)
        return MODEL_NONE;
    return query_child_of(query, graph_of(query, element, graph), "output", name);
}

/* A frame has nodes that stand beside it. */
static uint32_t beside(const struct lsp_query *query, uint32_t element, struct span name)
{
    uint32_t parent = parent_of(query, element);
    return parent == MODEL_NONE ? parent : query_child(query, parent, name);
}

/* Attributes that name elements, and who finds what they name. */
static const struct reference {
    const char *attribute;
    uint32_t (*find)(const struct lsp_query *query, uint32_t element, struct span name);
} references[] = {
    {"nodename", in_scope},
    {"nodegraph", graph_of},
    {"interfacename", inputs_of_graph},
    {"output", output_of_source},
    {"nodedef", at_root},
    {"inherit", at_root},
    {"material", at_root},
    {"collection", at_root},
    {"includecollection", at_root},
    {"active", at_root},
    {"variantset", at_root},
    {"propertyset", at_root},
    {"looks", at_root},
    {"default", of_group},
    {"viewercollection", at_root},
    {"contains", beside},
    {"defaultinput", inputs_passed_through},
    {"sourcecode", inputs_of_source},
    {"name", inputs_of_owner},
};

static const struct reference *reference_of(const struct lsp_query *query,
                                            const struct model_attribute *attribute)
{
    for (size_t i = 0; i < sizeof references / sizeof *references; ++i)
        if (query_equals(query->text, attribute->name, references[i].attribute))
            return &references[i];
    return NULL;
}

uint32_t names_target_of(const struct lsp_query *query, uint32_t element,
                         const struct model_attribute *attribute, struct span name)
{
    const struct reference *reference = reference_of(query, attribute);
    return reference && name.end > name.start ? reference->find(query, element, name) : MODEL_NONE;
}

uint32_t names_target(const struct lsp_query *query, uint32_t element,
                      const struct model_attribute *attribute)
{
    return names_target_of(query, element, attribute, attribute->value);
}

/* Source text names inputs as "{{tint}}". */
static bool next_in_source(const struct lsp_query *query, struct span value, struct span *item)
{
    const char *bytes = query->text->bytes;
    uint32_t at = item->end;
    while (at + 1 < value.end && memcmp(bytes + at, "{{", 2) != 0)
        ++at;
    item->start = item->end = at + 1 < value.end ? at + 2 : value.end;
    while (item->end < value.end && bytes[item->end] != '}')
        ++item->end;
    return item->end > item->start;
}

bool names_next_item(const struct lsp_query *query, const struct model_attribute *attribute,
                     struct span *item)
{
    const char *bytes = query->text->bytes;
    const struct span value = attribute->value;
    if (query_equals(query->text, attribute->name, "sourcecode"))
        return next_in_source(query, value, item);
    uint32_t at = item->end;
    while (at < value.end && strchr(", \t\r\n", bytes[at]))
        ++at;
    item->start = item->end = at;
    while (item->end < value.end && bytes[item->end] != ',')
        ++item->end;
    while (item->end > at && strchr(" \t\r\n", bytes[item->end - 1]))
        --item->end;
    return item->end > at;
}

bool names_is_reference(const struct lsp_query *query, uint32_t element,
                        const struct model_attribute *attribute)
{
    bool is_value = query_equals(query->text, attribute->name, "default")
                    && !query_is(query, element, "lookgroup");
    return reference_of(query, attribute) && !is_value
           && !query_equals(query->text, attribute->name, "sourcecode")
           && !query_equals(query->text, attribute->name, "name");
}

/* ---- Included files ---- */

mxg_element names_next_included(const struct lsp_query *query, mxg_element after,
                                mxg_element_info *out)
{
    const mxg_document *document = query->document->parsed;
    mxg_element element = 0;
    *out = (mxg_element_info){sizeof *out};
    if (!document || mxg_document_num_files(document) < 2)
        return 0;
    if (after) {
        mxg_document_element(document, after, out);
        element = out->next;
    } else {
        mxg_document_element(document, mxg_document_find_element(document, 0, ""), out);
        element = out->first_child;
    }
    for (; element; element = out->next) {
        *out = (mxg_element_info){sizeof *out};
        if (mxg_document_element(document, element, out) != MXG_OK)
            return 0;
        if (out->file && strcmp(out->file, query->document->path) != 0)
            return element;
    }
    return 0;
}

mxg_element names_find_included(const struct lsp_query *query, struct span name,
                                mxg_element_info *out)
{
    for (mxg_element element = 0; (element = names_next_included(query, element, out)) != 0;)
        if (query_equals(query->text, name, out->name))
            return element;
    return 0;
}
