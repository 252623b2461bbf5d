// SPDX-License-Identifier: Apache-2.0
/* The shape of a document: symbols, parts that fold, links to files. */
#include "lsp/handlers.h"
#include "lsp/named_elements.h"
#include "lsp/wire.h"
#include "program/cli.h"

#include <stdlib.h>
#include <string.h>

/* `SymbolKind` of categories; nodes are functions. */
static const struct {
    const char *category;
    int kind;
} kinds[] = {
    {"nodegraph", 2},        {"nodedef", 11},        {"implementation", 6}, {"input", 8},
    {"output", 8},           {"token", 15},          {"look", 5},           {"lookgroup", 5},
    {"collection", 18},      {"materialassign", 20}, {"typedef", 23},       {"geominfo", 19},
    {"surfacematerial", 19}, {"volumematerial", 19}, {"propertyset", 19},   {"variantset", 10},
};

enum { KIND_NODE = 12 };

static int kind_of(const struct lsp_query *query, uint32_t element)
{
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; ++i)
        if (query_is(query, element, kinds[i].category))
            return kinds[i].kind;
    return KIND_NODE;
}

static json_t *symbol_of(const struct lsp_query *query, uint32_t element)
{
    char category[QUERY_NAME], type[QUERY_NAME];
    const struct model_element *owner = &query->model->elements[element];
    struct span name = query_value(query, element, "name"),
                shown = name.start < name.end ? name : owner->name;
    query_category(query, element, category, sizeof category);
    query_text(query, element, "type", type, sizeof type);
    json_t *symbol = json_object();
    json_object_set_new(symbol, "name", wire_span(query->text, shown));
    json_object_set_new(symbol, "detail", json_sprintf("%s%s%s", category, *type ? " " : "", type));
    json_object_set_new(symbol, "kind", json_integer(kind_of(query, element)));
    json_object_set_new(
        symbol, "range",
        wire_range(query->session, query->text, (struct span){owner->start, owner->end}));
    json_object_set_new(symbol, "selectionRange", wire_range(query->session, query->text, shown));
    return symbol;
}

/*
 * The symbols of the elements in `parent`, without the inputs of nodes. A broken text may nest
 * deeply: what is deeper than documents are is left out.
 */
static json_t *symbols_in(const struct lsp_query *query, uint32_t parent, int depth)
{
    enum { MAX_DEPTH = 16 };
    json_t *symbols = json_array();
    for (uint32_t child = model_first(query->model, parent); child != MODEL_NONE;
         child = model_next(query->model, child)) {
        const struct model_element *element = &query->model->elements[child];
        if (element->name.start == element->name.end)
            continue;
        json_t *symbol = symbol_of(query, child);
        bool is_open = depth < MAX_DEPTH && !query_is_node(query, child)
                       && model_first(query->model, child) != MODEL_NONE;
        if (is_open)
            json_object_set_new(symbol, "children", symbols_in(query, child, depth + 1));
        json_array_append_new(symbols, symbol);
    }
    return symbols;
}

json_t *handle_symbols(struct lsp_session *session, const json_t *params, struct lsp_error *error)
{
    struct lsp_query query;
    if (!lsp_query(session, params, &query, error))
        return NULL;
    uint32_t root = query_root(&query);
    return symbols_in(&query, root, 0);
}

/* Elements and comments of several lines; the last line, with the end tag, stays in sight. */
json_t *handle_folding(struct lsp_session *session, const json_t *params, struct lsp_error *error)
{
    struct lsp_query query;
    if (!lsp_query(session, params, &query, error))
        return NULL;
    json_t *list = json_array();
    for (uint32_t i = 0; i < query.model->num_elements; ++i) {
        const struct model_element *element = &query.model->elements[i];
        uint32_t first = text_line(query.text, element->start),
                 last = text_line(query.text, element->end ? element->end - 1 : 0);
        last = element->is_comment || last == first ? last : last - 1;
        if (last <= first)
            continue;
        json_t *fold = json_object();
        json_object_set_new(fold, "startLine", json_integer(first));
        json_object_set_new(fold, "endLine", json_integer(last));
        if (element->is_comment)
            json_object_set_new(fold, "kind", json_string("comment"));
        json_array_append_new(list, fold);
    }
    return list;
}

/* ---- Links ---- */

static void add_link(const struct lsp_query *query, json_t *list, struct span value,
                     const char *prefix)
{
    char *file = cli_format("%s%.*s", prefix, (int)(value.end - value.start),
                            query->text->bytes + value.start);
    bool is_plain = *file && !strpbrk(file, "<{[&\\") && !strstr(file, "://");
    if (is_plain && query->document->is_file) {
        char *path = disk_join(query->document->path, file), *uri = wire_uri(path);
        json_t *link = json_object();
        json_object_set_new(link, "range", wire_range(query->session, query->text, value));
        json_object_set_new(link, "target", json_text(uri));
        json_array_append_new(list, link);
        free(uri);
        free(path);
    }
    free(file);
}

json_t *handle_links(struct lsp_session *session, const json_t *params, struct lsp_error *error)
{
    struct lsp_query query;
    if (!lsp_query(session, params, &query, error))
        return NULL;
    json_t *list = json_array();
    for (uint32_t i = 0; i < query.model->num_elements; ++i) {
        char prefix[QUERY_NAME];
        const struct model_attribute *file = names_file(&query, i, prefix, sizeof prefix);
        if (file)
            add_link(&query, list, file->value, prefix);
    }
    return list;
}
