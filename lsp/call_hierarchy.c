// SPDX-License-Identifier: Apache-2.0
/* The graph as a call hierarchy: what a node reads is what it calls; what reads it calls it. */
#include "lsp/handlers.h"
#include "lsp/references.h"
#include "lsp/wire.h"

#include <string.h>

static json_t *item_of(const struct lsp_query *query, uint32_t element)
{
    char category[QUERY_NAME];
    const struct model_element *owner = &query->model->elements[element];
    struct span name = query_value(query, element, "name");
    query_category(query, element, category, sizeof category);
    json_t *item = json_object();
    json_object_set_new(item, "name", wire_span(query->text, name));
    json_object_set_new(item, "detail", json_text(category));
    json_object_set_new(item, "kind", json_integer(query_is(query, element, "nodegraph") ? 2 : 12));
    json_object_set_new(item, "uri", json_text(query->document->uri));
    json_object_set_new(
        item, "range",
        wire_range(query->session, query->text, (struct span){owner->start, owner->end}));
    json_object_set_new(item, "selectionRange", wire_range(query->session, query->text, name));
    return item;
}

/* The node or nodegraph that has the element, or is it. */
static uint32_t node_of(const struct lsp_query *query, uint32_t element)
{
    while (element != MODEL_NONE && !query_is_node(query, element)
           && !query_is(query, element, "nodegraph"))
        element = query->model->elements[element].parent;
    return element;
}

json_t *handle_prepare_calls(struct lsp_session *session, const json_t *params,
                             struct lsp_error *error)
{
    struct lsp_query query;
    struct span name;
    if (!lsp_query(session, params, &query, error))
        return NULL;
    uint32_t target = references_target(&query, &name),
             node = node_of(&query, target != MODEL_NONE
                                        ? target
                                        : model_element_at(query.model, query.offset));
    return node == MODEL_NONE ? NULL : json_pack("[o]", item_of(&query, node));
}

/* Finds the element of an item again by the place of its name. */
static bool read_item(struct lsp_session *session, const json_t *params, struct lsp_query *out,
                      uint32_t *out_element, struct lsp_error *error)
{
    const json_t *item = json_object_get(params, "item");
    json_t *place =
        json_pack("{s:{s:O}, s:O?}", "textDocument", "uri", json_object_get(item, "uri"),
                  "position", json_object_get(json_object_get(item, "selectionRange"), "start"));
    bool is_open = place && lsp_query(session, place, out, error);
    json_decref(place);
    *out_element = is_open ? node_of(out, model_element_at(out->model, out->offset)) : MODEL_NONE;
    return *out_element != MODEL_NONE;
}

/* Calls by the other end, each with the places of its connections. */
struct calls {
    const struct lsp_query *query;
    json_t *list;
    const char *key; /* "from" or "to" */
};

static void add_call(struct calls *calls, uint32_t other, struct span place)
{
    json_t *item = item_of(calls->query, other), *call,
           *range = wire_range(calls->query->session, calls->query->text, place);
    size_t index;
    json_array_foreach(calls->list, index, call)
    {
        if (!json_equal(json_object_get(call, calls->key), item))
            continue;
        json_array_append_new(json_object_get(call, "fromRanges"), range);
        json_decref(item);
        return;
    }
    json_array_append_new(calls->list,
                          json_pack("{s:o, s:[o]}", calls->key, item, "fromRanges", range));
}

static bool is_connection(const struct lsp_query *query, const struct model_attribute *attribute)
{
    return query_equals(query->text, attribute->name, "nodename")
           || query_equals(query->text, attribute->name, "nodegraph");
}

static void take_reader(void *user_data, uint32_t element, const struct model_attribute *attribute,
                        struct span name)
{
    struct calls *calls = user_data;
    uint32_t reader = node_of(calls->query, element);
    if (reader != MODEL_NONE && is_connection(calls->query, attribute))
        add_call(calls, reader, name);
}

json_t *handle_incoming_calls(struct lsp_session *session, const json_t *params,
                              struct lsp_error *error)
{
    struct lsp_query query;
    uint32_t element;
    if (!read_item(session, params, &query, &element, error))
        return NULL;
    struct calls calls = {&query, json_array(), "from"};
    references_each(&query, element, take_reader, &calls);
    return calls.list;
}

json_t *handle_outgoing_calls(struct lsp_session *session, const json_t *params,
                              struct lsp_error *error)
{
    struct lsp_query query;
    uint32_t element;
    if (!read_item(session, params, &query, &element, error))
        return NULL;
    struct calls calls = {&query, json_array(), "to"};
    for (uint32_t i = element + 1; i < query.model->elements[element].after; ++i) {
        const struct model_element *port = &query.model->elements[i];
        for (uint32_t a = 0; a < port->num_attributes; ++a) {
            const struct model_attribute *attribute =
                &query.model->attributes[port->first_attribute + a];
            uint32_t source = is_connection(&query, attribute)
                                  ? node_of(&query, names_target(&query, i, attribute))
                                  : MODEL_NONE;
            if (source != MODEL_NONE && node_of(&query, port->parent) == element)
                add_call(&calls, source, attribute->value);
        }
    }
    return calls.list;
}
