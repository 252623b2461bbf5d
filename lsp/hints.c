// SPDX-License-Identifier: Apache-2.0
/* Hints say what the text does not: the definition that a node has, units and colour spaces of
 * values. */
#include "lsp/handlers.h"
#include "lsp/named_elements.h"
#include "lsp/wire.h"

#include <string.h>

static void add_hint(const struct lsp_query *query, json_t *list, uint32_t offset,
                     const char *label, const char *about)
{
    json_array_append_new(list, json_pack("{s:o, s:s, s:s, s:b}", "position",
                                          wire_position(query->session, query->text, offset),
                                          "label", label, "tooltip", about, "paddingLeft", 1));
}

/* Nodes with several definitions show theirs. */
static void hint_node(const struct lsp_query *query, json_t *list, uint32_t element)
{
    char category[QUERY_NAME];
    mxg_nodedef nodedef;
    query_category(query, element, category, sizeof category);
    uint32_t first = catalogue_next(query, category, 0),
             second = first == MXG_NONE ? first : catalogue_next(query, category, first + 1);
    bool is_named = query_attribute(query, element, "nodedef") != NULL;
    uint32_t index = second == MXG_NONE || is_named ? MXG_NONE : catalogue_resolve(query, element);
    if (index != MXG_NONE && catalogue_nodedef(query, index, &nodedef))
        add_hint(query, list, query->model->elements[element].name.end, nodedef.name,
                 "the definition of the node");
}

/* Values have the unit of their definition, and the colour space of an element around them. */
static void hint_input(const struct lsp_query *query, json_t *list, uint32_t element)
{
    const struct model_attribute *value = query_attribute(query, element, "value");
    mxg_port port;
    char type[QUERY_NAME], space[QUERY_NAME] = "";
    if (!value || !value->is_closed)
        return;
    if (!query_attribute(query, element, "unit") && catalogue_port_of(query, element, &port)
        && *port.unit)
        add_hint(query, list, value->end, port.unit, "the unit of the definition");
    query_text(query, element, "type", type, sizeof type);
    bool has_space = query_attribute(query, element, "colorspace") != NULL,
         is_colour = strncmp(type, "color", 5) == 0;
    for (uint32_t around = query->model->elements[element].parent;
         is_colour && !has_space && around != MODEL_NONE && !*space;
         around = query->model->elements[around].parent)
        query_text(query, around, "colorspace", space, sizeof space);
    if (*space)
        add_hint(query, list, value->end, space, "the colour space of an element around this one");
}

json_t *handle_hints(struct lsp_session *session, const json_t *params, struct lsp_error *error)
{
    struct lsp_query query;
    struct span range;
    if (!lsp_query(session, params, &query, error))
        return NULL;
    if (!wire_read_range(session, query.text, json_object_get(params, "range"), &range))
        range = (struct span){0, query.text->len};
    json_t *list = json_array();
    for (uint32_t i = 0; i < query.model->num_elements; ++i) {
        const struct model_element *element = &query.model->elements[i];
        if (element->start < range.start || element->start >= range.end || element->is_comment)
            continue;
        if (query_is_node(&query, i))
            hint_node(&query, list, i);
        else if (query_is(&query, i, "input"))
            hint_input(&query, list, i);
    }
    return list;
}
