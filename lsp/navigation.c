// SPDX-License-Identifier: Apache-2.0
/* From a name to its element and back: definition, references, highlights, rename. */
#include "lsp/definition_inputs.h"
#include "lsp/diagnostics.h"
#include "lsp/family.h"
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

/* A query of a document whose included files are known: the first one waits for its check. */
static bool query_files(struct lsp_session *session, const json_t *params, struct lsp_query *out,
                        struct lsp_error *error)
{
    if (!lsp_query(session, params, out, error))
        return false;
    if (!out->document->parsed)
        diagnostics_settle(session, out->document);
    return true;
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
    if (!query_files(session, params, &query, error))
        return NULL;
    uint32_t target = references_target(&query, &name);
    struct place place = query_place(&query);
    if (target != MODEL_NONE)
        return locate(&query, name_of(&query, target));
    if (place.part == PLACE_CATEGORY)
        return locate_nodedef(&query, place.element);
    if (place.part == PLACE_VALUE && names_other_files(&query, place.element, place.attribute)
        && names_find_included(&query, name, &info))
        return locate_included(&query, &info);
    return NULL;
}

/* ---- References ---- */

/* The element under the cursor, which may stand in another file, and the files that name it. */
struct aim {
    struct lsp_query query; /* of the text that has it */
    uint32_t target;        /* MODEL_NONE: there is none */
    struct span name;       /* under the cursor */
    struct family family;
};

/* The element at the root of a file of the family that a reference names. */
static void aim_at_included(struct aim *aim, const struct lsp_query *query)
{
    mxg_element_info info;
    struct place place = query_place(query);
    if (place.part != PLACE_VALUE || !names_other_files(query, place.element, place.attribute)
        || !names_find_included(query, aim->name, &info))
        return;
    for (size_t i = 0; i < aim->family.num_files; ++i) {
        struct lsp_query of;
        if (!family_query(&aim->family, i, query->session, &of)
            || strcmp(of.document->path, info.file) != 0)
            continue;
        const char *colon = strrchr(info.name, ':');
        for (uint32_t child = model_first(of.model, query_root(&of)); child != MODEL_NONE;
             child = model_next(of.model, child))
            if (query_equals(of.text, query_value(&of, child, "name"),
                             colon ? colon + 1 : info.name)) {
                aim->query = of;
                aim->target = child;
                aim->name = family_local_name(query, aim->name);
            }
    }
}

/* False: there is nothing with a name under the cursor. Call family_finish in any case. */
static bool find_aim(const struct lsp_query *query, struct aim *out)
{
    *out = (struct aim){.query = *query};
    out->target = references_target(query, &out->name);
    if (out->target == MODEL_NONE || family_can_name(query, out->target)
        || query_is(query, out->target, "input"))
        family_find(query->session, query->document, &out->family);
    if (out->target == MODEL_NONE)
        aim_at_included(out, query);
    return out->target != MODEL_NONE;
}

/* Places of a name as JSON; `make` makes one. */
struct places {
    const struct lsp_query *query;
    json_t *list;
    json_t *(*make)(const struct places *places, struct span name);
    const char *new_name;
};

static void take_place(void *user_data, uint32_t element, const struct model_attribute *attribute,
                       struct span name)
{
    struct places *places = user_data;
    (void)element;
    (void)attribute;
    json_array_append_new(places->list, places->make(places, name));
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

/* Adds the name itself and its references in its text. */
static void collect(struct places *places, uint32_t target, bool with_own)
{
    if (with_own)
        json_array_append_new(places->list, places->make(places, name_of(places->query, target)));
    references_each(places->query, target, take_place, places);
}

/* Adds the references of another file. */
static void collect_in(struct places *places, const struct aim *aim)
{
    const struct lsp_query *in = places->query;
    for (uint32_t i = 0; i < in->model->num_elements; ++i) {
        const struct model_element *element = &in->model->elements[i];
        for (uint32_t a = 0; a < element->num_attributes; ++a) {
            const struct model_attribute *attribute =
                &in->model->attributes[element->first_attribute + a];
            struct span item = {attribute->value.start, attribute->value.start};
            while (names_next_item(in, attribute, &item)) {
                struct span name = item;
                if (family_names(&aim->query, aim->target, in, i, attribute, &name))
                    take_place(places, i, attribute, name);
            }
        }
    }
}

/* The next other file of the family; begin with *number 0. False: there are no more. */
static bool next_other(const struct aim *aim, size_t *number, struct lsp_query *out)
{
    while (*number < aim->family.num_files) {
        bool is_member = family_query(&aim->family, (*number)++, aim->query.session, out);
        if (is_member && out->document != aim->query.document)
            return true;
    }
    return false;
}

json_t *handle_references(struct lsp_session *session, const json_t *params,
                          struct lsp_error *error)
{
    struct lsp_query query, in;
    struct aim aim;
    if (!query_files(session, params, &query, error))
        return NULL;
    const json_t *context = json_object_get(params, "context");
    struct places places = {&aim.query, json_array(), make_location, NULL};
    if (find_aim(&query, &aim)) {
        collect(&places, aim.target, json_is_true(json_object_get(context, "includeDeclaration")));
        places.query = &in;
        for (size_t i = 0; next_other(&aim, &i, &in);)
            collect_in(&places, &aim);
    }
    family_finish(&aim.family);
    return places.list;
}

json_t *handle_highlight(struct lsp_session *session, const json_t *params, struct lsp_error *error)
{
    struct lsp_query query;
    struct span name;
    if (!query_files(session, params, &query, error))
        return NULL;
    uint32_t target = references_target(&query, &name);
    struct places places = {&query, json_array(), make_highlight, NULL};
    if (target != MODEL_NONE)
        collect(&places, target, true);
    return places.list;
}

/* ---- Rename ---- */

/* Outputs of a definition have their names in its nodegraph, too. */
static bool is_shared_output(const struct lsp_query *query, uint32_t output)
{
    uint32_t parent = query->model->elements[output].parent;
    return query_is(query, parent, "nodedef") || query_attribute(query, parent, "nodedef");
}

/*
 * True for an element whose references are all known. The names of inputs of a node are those of
 * its definition.
 */
static bool can_rename(const struct lsp_query *query, uint32_t target)
{
    static const char *const others[] = {"nodegraph",   "nodedef",     "look",       "lookgroup",
                                         "collection",  "propertyset", "variantset", "typedef",
                                         "unittypedef", "targetdef"};
    bool is_input = query_is(query, target, "input"), is_output = query_is(query, target, "output");
    bool is_known = is_input || is_output || query_is_node(query, target);
    for (size_t i = 0; i < sizeof others / sizeof *others; ++i)
        is_known |= query_is(query, target, others[i]);
    bool is_of_node =
        (is_input || is_output) && query_is_node(query, query->model->elements[target].parent);
    return is_known && !is_of_node && !(is_output && is_shared_output(query, target));
}

json_t *handle_prepare_rename(struct lsp_session *session, const json_t *params,
                              struct lsp_error *error)
{
    struct lsp_query query;
    struct aim aim;
    json_t *result = NULL;
    if (!query_files(session, params, &query, error))
        return NULL;
    if (find_aim(&query, &aim) && can_rename(&aim.query, aim.target)
        && !inputs_share_graph(&aim.query, aim.target)
        && !family_uses_input(&aim.family, &aim.query, aim.target)) {
        result = json_object();
        json_object_set_new(result, "range", wire_range(session, query.text, aim.name));
        json_object_set_new(result, "placeholder", wire_span(query.text, aim.name));
    }
    family_finish(&aim.family);
    return result;
}

/* Letters, digits and '_', and no digit first, as the specification has names. */
static bool is_name(const char *name)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_",
                      all[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";
    return *name && strchr(letters, *name) && strspn(name, all) == strlen(name);
}

static bool has_child(const struct lsp_query *query, uint32_t parent, uint32_t except,
                      const char *name)
{
    for (uint32_t child = model_first(query->model, parent); child != MODEL_NONE;
         child = model_next(query->model, child))
        if (child != except && query_equals(query->text, query_value(query, child, "name"), name))
            return true;
    return false;
}

/* Beside the element, and at the root of the family's files for one there. */
static bool is_taken(const struct aim *aim, const char *name)
{
    struct lsp_query in;
    uint32_t parent = aim->query.model->elements[aim->target].parent;
    bool is_taken = has_child(&aim->query, parent, aim->target, name);
    for (size_t i = 0; parent == query_root(&aim->query) && next_other(aim, &i, &in);)
        is_taken |=
            query_root(&in) != MODEL_NONE && has_child(&in, query_root(&in), MODEL_NONE, name);
    return is_taken;
}

static json_t *rename_aim(const struct aim *aim, const char *new_name)
{
    struct lsp_query in;
    struct places places = {&aim->query, json_array(), make_edit, new_name};
    json_t *edit = wire_workspace_edit();
    collect(&places, aim->target, true);
    wire_add_edits(edit, places.query->document->uri, places.list);
    places.query = &in;
    for (size_t i = 0; next_other(aim, &i, &in);) {
        places.list = json_array();
        collect_in(&places, aim);
        wire_add_edits(edit, places.query->document->uri, places.list);
    }
    return edit;
}

json_t *handle_rename(struct lsp_session *session, const json_t *params, struct lsp_error *error)
{
    struct lsp_query query;
    struct aim aim;
    const char *new_name = json_text_of(params, "newName");
    if (!query_files(session, params, &query, error))
        return NULL;
    const char *fault = !find_aim(&query, &aim) || !can_rename(&aim.query, aim.target)
                            ? "there is no name here that can change"
                        : inputs_share_graph(&aim.query, aim.target)
                            ? "another definition has the same nodegraph, and would lose the input"
                        : family_uses_input(&aim.family, &aim.query, aim.target)
                            ? "other files use this input of the definition, and would lose it"
                        : !is_name(new_name)
                            ? "a name has letters, digits and '_', and no digit first"
                        : is_taken(&aim, new_name) ? "another element has this name"
                                                   : NULL;
    json_t *result = fault ? NULL : rename_aim(&aim, new_name);
    if (fault)
        *error = (struct lsp_error){LSP_REQUEST_FAILED, fault};
    family_finish(&aim.family);
    return result;
}
