// SPDX-License-Identifier: Apache-2.0
#include "lsp/named_elements.h"

#include "lsp/definition_inputs.h"

#include <stdio.h>
#include <string.h>

/* An <output> names nodes beside it; an <input> names those beside the element that has it. */
uint32_t names_scope(const struct lsp_query *query, uint32_t element)
{
    uint32_t owner = query_parent(query, element);
    return query_is(query, element, "output") ? owner : query_parent(query, owner);
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
        element = query_parent(query, element);
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

/* ---- Attributes that name elements: the table of the library ---- */

enum {
    KIND_NODE,
#define KIND(ID, word) KIND_##ID,
#include "src/document/kinds.def"
#undef KIND
    NUM_KINDS
};

static const char *const kinds[NUM_KINDS] = {
#define KIND(ID, word) [KIND_##ID] = #word,
#include "src/document/kinds.def"
#undef KIND
};

enum place_of_name {
    AT_ROOT,
    IN_SCOPE,
    IN_SCOPE_OR_AT_ROOT,
    BESIDE,
    BESIDE_OR_AT_ROOT,
    IN_INTERFACE,
    IN_SOURCE,
    IN_DEFINITION,
    IN_UNITS,
    IN_VARIANTSET,
    NUM_PLACES
};

#define IN(KIND) ((uint64_t)1 << KIND_##KIND)
#define ANYWHERE UINT64_MAX
#define SAME UINT64_MAX

static const struct reference {
    const char *attribute;
    enum place_of_name place;
    uint64_t users, targets;
} references[] = {
#define REFERENCE(attribute, users, targets, place, checked) {#attribute, place, users, targets},
#include "src/document/references.def"
#undef REFERENCE
};

static unsigned kind_of_category(const char *category)
{
    unsigned kind = NUM_KINDS - 1;
    while (kind != KIND_NODE && strcmp(kinds[kind], category) != 0)
        --kind;
    return kind;
}

static unsigned kind_of(const struct lsp_query *query, uint32_t element)
{
    char category[QUERY_NAME];
    return kind_of_category(query_category(query, element, category, sizeof category));
}

/* NULL: the attribute of this element names no elements. */
static const struct reference *reference_of(const struct lsp_query *query, uint32_t element,
                                            const struct model_attribute *attribute)
{
    for (size_t i = 0; i < sizeof references / sizeof *references; ++i)
        if (query_equals(query->text, attribute->name, references[i].attribute))
            return references[i].users >> kind_of(query, element) & 1 ? &references[i] : NULL;
    return NULL;
}

bool names_is_reference(const struct lsp_query *query, uint32_t element,
                        const struct model_attribute *attribute)
{
    return reference_of(query, element, attribute);
}

bool names_other_files(const struct lsp_query *query, uint32_t element,
                       const struct model_attribute *attribute)
{
    const struct reference *reference = reference_of(query, element, attribute);
    bool is_inside = reference
                     && (reference->place == IN_INTERFACE || reference->place == IN_DEFINITION
                         || reference->place == IN_UNITS || reference->place == IN_VARIANTSET);
    return reference && !is_inside;
}

bool names_category(const struct lsp_query *query, uint32_t element,
                    const struct model_attribute *attribute, const char *category)
{
    const struct reference *reference = reference_of(query, element, attribute);
    return reference && reference->targets >> kind_of_category(category) & 1;
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

/* A nodegraph stands beside the element that reads it, or at the root. */
static uint32_t graph_of(const struct lsp_query *query, uint32_t element, struct span name)
{
    uint32_t scope = names_scope(query, element),
             beside = scope == MODEL_NONE ? scope : query_child(query, scope, name);
    return query_is(query, beside, "nodegraph") ? beside : at_root(query, element, name);
}

/* An output of the nodegraph that the element names, or one at the root. */
static uint32_t output_of_source(const struct lsp_query *query, uint32_t element, struct span name)
{
    struct span graph = query_value(query, element, "nodegraph"),
                node = query_value(query, element, "nodename");
    if (graph.start < graph.end)
        return query_child_of(query, graph_of(query, element, graph), "output", name);
    return node.start < node.end ? MODEL_NONE : at_root(query, element, name);
}

static uint32_t beside(const struct lsp_query *query, uint32_t element, struct span name)
{
    uint32_t parent = query_parent(query, element);
    return parent == MODEL_NONE ? parent : query_child(query, parent, name);
}

static uint32_t beside_or_at_root(const struct lsp_query *query, uint32_t element, struct span name)
{
    uint32_t found = beside(query, element, name);
    return found == MODEL_NONE ? at_root(query, element, name) : found;
}

static uint32_t in_variantset(const struct lsp_query *query, uint32_t element, struct span name)
{
    uint32_t set = query_at_root(query, query_value(query, element, "variantset"));
    return query_child_of(query, set, "variant", name);
}

/* The unit of this name in the units of the element's unit type, or of any if it has none. */
static uint32_t in_units(const struct lsp_query *query, uint32_t element, struct span name)
{
    struct span type = query_value(query, element, "unittype");
    uint32_t root = query_root(query), found = MODEL_NONE;
    for (uint32_t child = root == MODEL_NONE ? root : model_first(query->model, root);
         child != MODEL_NONE && found == MODEL_NONE; child = model_next(query->model, child)) {
        bool fits = query_is(query, child, "unitdef")
                    && (type.start == type.end
                        || query_is_same(query->text, type, query_value(query, child, "unittype")));
        found = fits ? query_child_of(query, child, "unit", name) : found;
    }
    return found;
}

/* Who finds the elements of a place. */
static uint32_t (*const finders[NUM_PLACES])(const struct lsp_query *query, uint32_t element,
                                             struct span name) = {
    [AT_ROOT] = at_root,
    [IN_SCOPE] = in_scope,
    [IN_SCOPE_OR_AT_ROOT] = graph_of,
    [BESIDE] = beside,
    [BESIDE_OR_AT_ROOT] = beside_or_at_root,
    [IN_INTERFACE] = inputs_of_graph,
    [IN_SOURCE] = output_of_source,
    [IN_DEFINITION] = inputs_passed_through,
    [IN_UNITS] = in_units,
    [IN_VARIANTSET] = in_variantset,
};

/* Two attributes that name inputs of definitions without a row of the table. */
static uint32_t input_of_definition(const struct lsp_query *query, uint32_t element,
                                    const struct model_attribute *attribute, struct span name)
{
    if (query_equals(query->text, attribute->name, "sourcecode"))
        return inputs_of_source(query, element, name);
    bool is_name = query_equals(query->text, attribute->name, "name");
    return is_name ? inputs_of_owner(query, element, name) : MODEL_NONE;
}

uint32_t names_target_of(const struct lsp_query *query, uint32_t element,
                         const struct model_attribute *attribute, struct span name)
{
    const struct reference *reference = reference_of(query, element, attribute);
    if (name.end <= name.start)
        return MODEL_NONE;
    if (!reference)
        return input_of_definition(query, element, attribute, name);
    uint32_t found = finders[reference->place](query, element, name);
    bool fits = found != MODEL_NONE && reference->targets >> kind_of(query, found) & 1;
    return fits ? found : MODEL_NONE;
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
