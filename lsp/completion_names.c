// SPDX-License-Identifier: Apache-2.0
/* Names of elements of the document, for connections and references. */
#include "lsp/completion.h"
#include "lsp/element_infos.h"
#include "lsp/named_elements.h"

#include <string.h>

static bool fits(const char *wanted, const char *type)
{
    return !*wanted || !*type || strcmp(wanted, type) == 0 || strcmp(type, "multioutput") == 0;
}

static void add_element(struct completion *completion, uint32_t element, const char *wanted)
{
    const struct lsp_query *query = &completion->query;
    char name[QUERY_NAME], type[QUERY_NAME];
    query_text(query, element, "name", name, sizeof name);
    names_own_type(query, element, type, sizeof type);
    if (*name && fits(wanted, type))
        completion_add(completion, (struct completion_item){
                                       .label = name, .kind = COMPLETE_REFERENCE, .detail = type});
}

/* Elements of the included files, which stand at the root. */
static void add_included(struct completion *completion, bool (*is_wanted)(const char *category),
                         const char *wanted)
{
    mxg_element_info info;
    for (mxg_element element = 0;
         (element = names_next_included(&completion->query, element, &info)) != 0;)
        if (*info.name && is_wanted(info.category) && fits(wanted, info.type))
            completion_add(completion, (struct completion_item){.label = info.name,
                                                                .kind = COMPLETE_REFERENCE,
                                                                .detail = info.type,
                                                                .doc = info.file});
}

static bool is_node(const char *category)
{
    return !elements_find(category);
}

static bool is_graph(const char *category)
{
    return strcmp(category, "nodegraph") == 0;
}

static bool is_material(const char *category)
{
    return strcmp(category, "surfacematerial") == 0 || strcmp(category, "volumematerial") == 0;
}

void complete_nodes(struct completion *completion)
{
    const struct lsp_query *query = &completion->query;
    uint32_t element = completion->place.element, scope = names_scope(query, element),
             own = query->model->elements[element].parent;
    char wanted[QUERY_NAME];
    names_type(query, element, wanted, sizeof wanted);
    for (uint32_t child = scope == MODEL_NONE ? scope : model_first(query->model, scope);
         child != MODEL_NONE && !completion->is_cut; child = model_next(query->model, child))
        if (child != own && query_is_node(query, child))
            add_element(completion, child, wanted);
    if (scope != MODEL_NONE && scope == query_root(query))
        add_included(completion, is_node, wanted);
}

/* The children of a category. */
static void add_children(struct completion *completion, uint32_t parent, const char *category,
                         const char *wanted)
{
    const struct lsp_query *query = &completion->query;
    for (uint32_t child = parent == MODEL_NONE ? parent : model_first(query->model, parent);
         child != MODEL_NONE && !completion->is_cut; child = model_next(query->model, child))
        if (query_is(query, child, category))
            add_element(completion, child, wanted);
}

static bool has_output(const struct lsp_query *query, uint32_t graph, const char *wanted)
{
    for (uint32_t child = model_first(query->model, graph); child != MODEL_NONE;
         child = model_next(query->model, child)) {
        char type[QUERY_NAME];
        if (query_is(query, child, "output")
            && fits(wanted, names_own_type(query, child, type, sizeof type)))
            return true;
    }
    return false;
}

void complete_graphs(struct completion *completion)
{
    const struct lsp_query *query = &completion->query;
    uint32_t element = completion->place.element, root = query_root(query);
    char wanted[QUERY_NAME] = "";
    bool is_port = query_is(query, element, "input") || query_is(query, element, "output");
    if (is_port)
        names_type(query, element, wanted, sizeof wanted);
    for (uint32_t child = root == MODEL_NONE ? root : model_first(query->model, root);
         child != MODEL_NONE && !completion->is_cut; child = model_next(query->model, child))
        if (query_is(query, child, "nodegraph") && has_output(query, child, wanted))
            add_element(completion, child, "");
    add_included(completion, is_graph, "");
}

void complete_outputs(struct completion *completion)
{
    const struct lsp_query *query = &completion->query;
    uint32_t element = completion->place.element;
    const struct model_attribute *graph = query_attribute(query, element, "nodegraph"),
                                 *node = query_attribute(query, element, "nodename");
    char wanted[QUERY_NAME];
    names_type(query, element, wanted, sizeof wanted);
    if (graph)
        add_children(completion, names_target(query, element, graph), "output", wanted);
    uint32_t source = node ? names_target(query, element, node) : MODEL_NONE,
             index = catalogue_resolve(query, source);
    mxg_nodedef nodedef;
    if (index == MXG_NONE || !catalogue_nodedef(query, index, &nodedef))
        return;
    for (uint32_t i = 0; i < nodedef.num_outputs; ++i) {
        mxg_port port;
        if (catalogue_port(query, index, nodedef.num_inputs + i, &port) && fits(wanted, port.type))
            completion_add(completion, (struct completion_item){.label = port.name,
                                                                .kind = COMPLETE_REFERENCE,
                                                                .detail = port.type});
    }
}

void complete_interface(struct completion *completion)
{
    const struct lsp_query *query = &completion->query;
    uint32_t element = completion->place.element,
             graph = query_around(query, query->model->elements[element].parent, "nodegraph");
    char wanted[QUERY_NAME];
    names_type(query, element, wanted, sizeof wanted);
    add_children(completion, graph, "input", wanted);
    const struct model_attribute *nodedef = query_attribute(query, graph, "nodedef");
    if (nodedef)
        add_children(completion, names_target(query, graph, nodedef), "input", wanted);
}

void complete_materials(struct completion *completion)
{
    const struct lsp_query *query = &completion->query;
    add_children(completion, query_root(query), "surfacematerial", "");
    add_children(completion, query_root(query), "volumematerial", "");
    add_included(completion, is_material, "");
}

void complete_named(struct completion *completion)
{
    const struct lsp_query *query = &completion->query;
    const struct place *place = &completion->place;
    uint32_t root = query_root(query);
    char category[QUERY_NAME];
    for (uint32_t child = root == MODEL_NONE ? root : model_first(query->model, root);
         child != MODEL_NONE && !completion->is_cut; child = model_next(query->model, child)) {
        query_category(query, child, category, sizeof category);
        if (child != place->element && names_other_files(query, place->element, place->attribute)
            && names_category(query, place->element, place->attribute, category))
            add_element(completion, child, "");
    }
}
