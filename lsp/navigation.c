// SPDX-License-Identifier: Apache-2.0
/* From a name to its element and back: definition, references, highlights, rename. */
#include "lsp/handlers.h"
#include "lsp/references.h"
#include "lsp/wire.h"
#include "program/cli.h"

#include <stdlib.h>
#include <string.h>

/* Where an element shows its name: in `name`, or else in its tag. */
static struct span name_of(const struct lsp_query *query, uint32_t element)
{
    struct span name = query_value(query, element, "name");
    return name.start < name.end ? name : query->model->elements[element].name;
}

/* The place of an element of another file. */
static json_t *locate_included(const struct lsp_query *query, const mxg_element_info *info)
{
    struct text own;
    const struct text *text = lsp_file_text(query->session, query->document, info->file, &own);
    uint32_t start = text_place(text, info->line, info->column);
    char *uri = lsp_file_uri(query->session, info->file);
    json_t *location =
        wire_location(query->session, uri, text, (struct span){start, text_skip(text, start, 1)});
    free(uri);
    text_finish(&own);
    return location;
}

static json_t *locate(const struct lsp_query *query, struct span name)
{
    return wire_location(query->session, query->document->uri, query->text, name);
}

/* The <nodedef> of a node whose category is under the cursor, in this text or an included file. */
static json_t *locate_nodedef(const struct lsp_query *query, uint32_t element)
{
    uint32_t index = query_is_node(query, element) ? catalogue_resolve(query, element) : MXG_NONE,
             root = query_root(query);
    mxg_nodedef nodedef;
    mxg_element_info info;
    if (index == MXG_NONE || root == MODEL_NONE || !catalogue_nodedef(query, index, &nodedef))
        return NULL;
    for (uint32_t child = model_first(query->model, root); child != MODEL_NONE;
         child = model_next(query->model, child))
        if (query_is(query, child, "nodedef")
            && query_equals(query->text, query_value(query, child, "name"), nodedef.name))
            return locate(query, name_of(query, child));
    for (mxg_element included = 0; (included = names_next_included(query, included, &info)) != 0;)
        if (strcmp(info.name, nodedef.name) == 0)
            return locate_included(query, &info);
    return NULL;
}

json_t *handle_definition(struct lsp_session *session, const json_t *params,
                          struct lsp_error *error)
{
    struct lsp_query query;
    struct span name;
    mxg_element_info info;
    if (!lsp_query(session, params, &query, error))
        return NULL;
    uint32_t target = references_target(&query, &name);
    struct place place = query_place(&query);
    if (target != MODEL_NONE)
        return locate(&query, name_of(&query, target));
    if (place.part == PLACE_CATEGORY)
        return locate_nodedef(&query, place.element);
    if (place.part == PLACE_VALUE && names_is_reference(&query, place.attribute)
        && names_find_included(&query, place.attribute->value, &info))
        return locate_included(&query, &info);
    return NULL;
}

/* ---- References ---- */

/* Places of a name as JSON; `make` makes one. */
struct places {
    const struct lsp_query *query;
    json_t *list;
    json_t *(*make)(const struct places *places, struct span name);
    const char *new_name;
};

static void take_place(void *user_data, uint32_t element, const struct model_attribute *attribute)
{
    struct places *places = user_data;
    (void)element;
    json_array_append_new(places->list, places->make(places, attribute->value));
}

static json_t *make_location(const struct places *places, struct span name)
{
    return locate(places->query, name);
}

static json_t *make_highlight(const struct places *places, struct span name)
{
    return json_pack("{s:o}", "range",
                     wire_range(places->query->session, places->query->text, name));
}

static json_t *make_edit(const struct places *places, struct span name)
{
    return wire_edit(places->query->session, places->query->text, name, places->new_name);
}

/* Adds the name itself and its references. */
static void collect(struct places *places, uint32_t target, bool with_own)
{
    places->list = json_array();
    if (with_own)
        json_array_append_new(places->list, places->make(places, name_of(places->query, target)));
    references_each(places->query, target, take_place, places);
}

json_t *handle_references(struct lsp_session *session, const json_t *params,
                          struct lsp_error *error)
{
    struct lsp_query query;
    struct span name;
    if (!lsp_query(session, params, &query, error))
        return NULL;
    uint32_t target = references_target(&query, &name);
    const json_t *context = json_object_get(params, "context");
    struct places places = {&query, NULL, make_location, NULL};
    if (target != MODEL_NONE)
        collect(&places, target, json_is_true(json_object_get(context, "includeDeclaration")));
    return places.list;
}

json_t *handle_highlight(struct lsp_session *session, const json_t *params, struct lsp_error *error)
{
    struct lsp_query query;
    struct span name;
    if (!lsp_query(session, params, &query, error))
        return NULL;
    uint32_t target = references_target(&query, &name);
    struct places places = {&query, NULL, make_highlight, NULL};
    if (target != MODEL_NONE)
        collect(&places, target, true);
    return places.list;
}

/* ---- Rename ---- */

/* A name that is the node's own choice; the names of inputs of a node are those of its definition.
 */
static uint32_t find_renamed(const struct lsp_query *query, struct span *out_name)
{
    uint32_t target = references_target(query, out_name);
    bool is_of_definition =
        target != MODEL_NONE
        && (query_is(query, target, "input") || query_is(query, target, "output"))
        && query_is_node(query, query->model->elements[target].parent);
    return is_of_definition ? MODEL_NONE : target;
}

json_t *handle_prepare_rename(struct lsp_session *session, const json_t *params,
                              struct lsp_error *error)
{
    struct lsp_query query;
    struct span name;
    if (!lsp_query(session, params, &query, error) || find_renamed(&query, &name) == MODEL_NONE)
        return NULL;
    json_t *result = json_object();
    json_object_set_new(result, "range", wire_range(session, query.text, name));
    json_object_set_new(result, "placeholder", wire_span(query.text, name));
    return result;
}

/* Letters, digits and '_', and no digit first, as the specification has names. */
static bool is_name(const char *name)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_",
                      all[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";
    return *name && strchr(letters, *name) && strspn(name, all) == strlen(name);
}

static bool is_taken(const struct lsp_query *query, uint32_t target, const char *name)
{
    uint32_t parent = query->model->elements[target].parent;
    for (uint32_t child = model_first(query->model, parent); child != MODEL_NONE;
         child = model_next(query->model, child))
        if (child != target && query_equals(query->text, query_value(query, child, "name"), name))
            return true;
    return false;
}

json_t *handle_rename(struct lsp_session *session, const json_t *params, struct lsp_error *error)
{
    struct lsp_query query;
    struct span name;
    const char *new_name = json_text_of(params, "newName");
    if (!lsp_query(session, params, &query, error))
        return NULL;
    uint32_t target = find_renamed(&query, &name);
    const char *fault = target == MODEL_NONE ? "there is no name here that can change"
                        : !is_name(new_name)
                            ? "a name has letters, digits and '_', and no digit first"
                        : is_taken(&query, target, new_name) ? "another element has this name"
                                                             : NULL;
    if (fault) {
        *error = (struct lsp_error){LSP_REQUEST_FAILED, fault};
        return NULL;
    }
    struct places places = {&query, NULL, make_edit, new_name};
    collect(&places, target, true);
    return wire_workspace_edit(query.document->uri, places.list);
}
