// SPDX-License-Identifier: Apache-2.0
#include "lsp/definition_inputs.h"

#include "lsp/catalogue.h"

static uint32_t first_at_root(const struct lsp_query *query)
{
    uint32_t root = query_root(query);
    return root == MODEL_NONE ? root : model_first(query->model, root);
}

/* The element at the root that an attribute names. */
static uint32_t named_by(const struct lsp_query *query, uint32_t element, const char *attribute)
{
    struct span name = query_value(query, element, attribute);
    return name.start == name.end ? MODEL_NONE : query_at_root(query, name);
}

/* The input of a definition, or of the first one that it inherits the input from. */
static uint32_t input_of(const struct lsp_query *query, uint32_t nodedef, struct span name)
{
    enum { MAX_DEPTH = 64 }; /* of definitions that inherit; they may be a circle */
    uint32_t found = MODEL_NONE;
    for (unsigned i = 0; i < MAX_DEPTH && nodedef != MODEL_NONE; ++i) {
        uint32_t input = query_child_of(query, nodedef, "input", name);
        found = input == MODEL_NONE ? found : input;
        nodedef = named_by(query, nodedef, "inherit");
    }
    return found;
}

/* ---- Nodegraphs ---- */

/* The definition that a nodegraph implements, as `element` of the root says. */
static uint32_t definition_by(const struct lsp_query *query, uint32_t element, uint32_t graph)
{
    bool says = element == graph
                || (query_is(query, element, "implementation")
                    && named_by(query, element, "nodegraph") == graph);
    return says ? named_by(query, element, "nodedef") : MODEL_NONE;
}

uint32_t inputs_of_graph(const struct lsp_query *query, uint32_t element, struct span name)
{
    uint32_t graph = query_around(query, query_parent(query, element), "nodegraph"),
             found = query_child_of(query, graph, "input", name);
    if (found != MODEL_NONE || graph == MODEL_NONE)
        return found;
    found = input_of(query, definition_by(query, graph, graph), name);
    for (uint32_t e = first_at_root(query); e != MODEL_NONE && found == MODEL_NONE;
         e = model_next(query->model, e))
        found = input_of(query, definition_by(query, e, graph), name);
    return found;
}

static bool is_shared_graph(const struct lsp_query *query, uint32_t graph, uint32_t target)
{
    bool has_target = false, has_other = false;
    struct span name = query_value(query, target, "name");
    for (uint32_t e = first_at_root(query); e != MODEL_NONE; e = model_next(query->model, e)) {
        uint32_t input = input_of(query, definition_by(query, e, graph), name);
        has_target |= input == target;
        has_other |= input != target && input != MODEL_NONE;
    }
    return has_target && has_other;
}

bool inputs_share_graph(const struct lsp_query *query, uint32_t target)
{
    bool is_shared = false,
         is_of_nodedef = query_is(query, target, "input")
                         && query_is(query, query_parent(query, target), "nodedef");
    for (uint32_t e = first_at_root(query); is_of_nodedef && e != MODEL_NONE && !is_shared;
         e = model_next(query->model, e))
        is_shared = query_is(query, e, "nodegraph") && is_shared_graph(query, e, target);
    return is_shared;
}

/* ---- Names of inputs ---- */

static uint32_t input_of_node(const struct lsp_query *query, uint32_t node, struct span name)
{
    mxg_nodedef nodedef;
    uint32_t index = catalogue_resolve(query, node), e = first_at_root(query);
    if (index == MXG_NONE || index < mxg_library_num_nodedefs(query->session->desc.library)
        || !catalogue_nodedef(query, index, &nodedef))
        return MODEL_NONE;
    while (e != MODEL_NONE
           && !(query_is(query, e, "nodedef")
                && query_equals(query->text, query_value(query, e, "name"), nodedef.name)))
        e = model_next(query->model, e);
    return input_of(query, e, name);
}

static bool is_empty_or(const struct lsp_query *query, struct span wanted, struct span value)
{
    return wanted.start == wanted.end || query_is_same(query->text, wanted, value);
}

/* The only input of this name among the definitions that a set of variants is for. */
static uint32_t input_of_set(const struct lsp_query *query, uint32_t set, struct span name)
{
    const struct span node = query_value(query, set, "node"),
                      nodedef = query_value(query, set, "nodedef");
    uint32_t found = MODEL_NONE;
    for (uint32_t e = first_at_root(query); e != MODEL_NONE; e = model_next(query->model, e)) {
        bool is_meant = query_is(query, e, "nodedef")
                        && is_empty_or(query, node, query_value(query, e, "node"))
                        && is_empty_or(query, nodedef, query_value(query, e, "name"));
        uint32_t input = is_meant ? input_of(query, e, name) : MODEL_NONE;
        if (input != MODEL_NONE && found != MODEL_NONE && input != found)
            return MODEL_NONE;
        found = input != MODEL_NONE ? input : found;
    }
    return found;
}

uint32_t inputs_of_owner(const struct lsp_query *query, uint32_t element, struct span name)
{
    uint32_t owner = query_parent(query, element);
    if (!query_is(query, element, "input"))
        return MODEL_NONE;
    if (query_is(query, owner, "nodedef"))
        return input_of(query, named_by(query, owner, "inherit"), name);
    if (query_is(query, owner, "implementation"))
        return input_of(query, named_by(query, owner, "nodedef"), name);
    if (query_is(query, owner, "variant"))
        return input_of_set(query, query_parent(query, owner), name);
    return query_is_node(query, owner) ? input_of_node(query, owner, name) : MODEL_NONE;
}

uint32_t inputs_of_source(const struct lsp_query *query, uint32_t element, struct span name)
{
    uint32_t implementation = query_around(query, element, "implementation");
    return input_of(query, named_by(query, implementation, "nodedef"), name);
}

uint32_t inputs_passed_through(const struct lsp_query *query, uint32_t element, struct span name)
{
    return input_of(query, query_parent(query, element), name);
}
