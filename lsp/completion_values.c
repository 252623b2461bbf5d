// SPDX-License-Identifier: Apache-2.0
/* Values of attributes: words of the catalogue, names of elements, enumerated values, files. */
#include "lsp/catalogue.h"
#include "lsp/check_document.h"
#include "lsp/completion.h"
#include "lsp/named_elements.h"
#include "program/cli.h"
#include "program/files.h"
#include "program/name_table.h"

#include <stdlib.h>
#include <string.h>

static void add_value(struct completion *completion, const char *value, enum completion_kind kind,
                      const char *detail)
{
    completion_add(completion,
                   (struct completion_item){.label = value, .kind = kind, .detail = detail});
}

/* The words of a kind, all or those that belong to `of`. */
static void add_words(struct completion *completion, enum catalogue_kind words_kind,
                      enum completion_kind kind, const char *of)
{
    const struct catalogue_words *words = catalogue_words(completion->query.session, words_kind);
    for (size_t i = 0; i < words->len; ++i)
        if (!of || !*of || strcmp(words->items[i].of, of) == 0)
            add_value(completion, words->items[i].name, kind, words->items[i].of);
}

/* The items of a list with commas. */
static void add_list(struct completion *completion, const char *list)
{
    while (*list) {
        list += strspn(list, " ,");
        size_t len = strcspn(list, ",");
        size_t kept = len;
        while (kept && list[kept - 1] == ' ')
            --kept;
        char *value = cli_copy(list, kept);
        if (kept)
            add_value(completion, value, COMPLETE_ENUM, NULL);
        free(value);
        list += len;
    }
}

/* The end of the first `count` items of a list with commas. */
static const char *end_of_items(const char *list, size_t count)
{
    const char *end = list + strcspn(list, ",");
    while (--count && *end)
        end += 1 + strcspn(end + 1, ",");
    return end;
}

/* The values of an enumeration with their words; a string has the words as values. */
static void add_enumeration(struct completion *completion, const mxg_port *port)
{
    const char *words = port->enum_names, *values = port->enum_values;
    size_t num_words = cli_count_items(words);
    size_t size = num_words ? cli_count_items(values) / num_words : 0; /* numbers of a value */
    if (!size || strcmp(port->type, "string") == 0) {
        add_list(completion, words);
        return;
    }
    for (size_t i = 0; i < num_words && *values; ++i) {
        const char *word_end = end_of_items(words, 1), *end = end_of_items(values, size);
        char *value = cli_copy(values, (size_t)(end - values));
        char *word = cli_copy(words, (size_t)(word_end - words));
        add_value(completion, value, COMPLETE_ENUM, word);
        free(word);
        free(value);
        words = word_end + strspn(word_end, ", ");
        values = end + strspn(end, ", ");
    }
}

static bool is_texture(const char *name)
{
    static const char *const endings[] = {"/",    ".png",  ".jpg", ".jpeg", ".exr", ".hdr",
                                          ".tif", ".tiff", ".tx",  ".tga",  ".bmp", ".ies"};
    for (size_t i = 0; i < sizeof endings / sizeof *endings; ++i)
        if (files_ends_with(name, endings[i]))
            return true;
    return false;
}

/* The files in the folder that the value names so far. */
static void add_files(struct completion *completion, const char *prefix, const char *ending)
{
    const struct lsp_query *query = &completion->query;
    struct span value = completion->replaced;
    uint32_t name = query->offset;
    while (name > value.start && query->text->bytes[name - 1] != '/')
        --name;
    char *folder =
        cli_format("%s%.*s", prefix, (int)(name - value.start), query->text->bytes + value.start);
    size_t size;
    query->session->disk.from = check_origin(query->document);
    char *names = disk_list(&query->session->disk, folder, &size);
    completion->replaced.start = name;
    for (const char *at = names; at < names + size; at += strlen(at) + 1)
        if (*at != '.'
            && (ending ? files_ends_with(at, ending) || files_ends_with(at, "/") : is_texture(at)))
            add_value(completion, at, files_ends_with(at, "/") ? COMPLETE_FOLDER : COMPLETE_FILE,
                      NULL);
    free(names);
    free(folder);
}

static void complete_textures(struct completion *completion)
{
    char prefix[QUERY_NAME];
    names_file_prefix(&completion->query, completion->place.element, prefix, sizeof prefix);
    add_files(completion, prefix, NULL);
}

/* ---- Attributes ---- */

static void complete_value(struct completion *completion)
{
    char type[QUERY_NAME];
    mxg_port port = {.enum_names = "", .enum_values = "", .value = ""};
    bool is_known = catalogue_port_of(&completion->query, completion->place.element, &port);
    query_text(&completion->query, completion->place.element, "type", type, sizeof type);
    const char *value_type = is_known && !*type ? port.type : type;
    if (strcmp(value_type, "filename") == 0)
        complete_textures(completion);
    else if (strcmp(value_type, "boolean") == 0)
        add_list(completion, "true, false");
    else if (is_known)
        add_enumeration(completion, &port);
    if (is_known && *port.value && !*port.enum_names && strcmp(value_type, "boolean") != 0)
        add_value(completion, port.value, COMPLETE_VALUE, "default");
    if (is_known && strcmp(port.name, "geomprop") == 0)
        add_words(completion, CATALOGUE_GEOMPROPS, COMPLETE_VALUE, NULL);
}

/* The types that the definitions of a node give, each once. False: the node has no definition. */
static bool add_types_of_node(struct completion *completion, const char *category)
{
    const struct lsp_query *query = &completion->query;
    struct name_table known = {0};
    for (uint32_t i = 0; (i = catalogue_next(query, category, i)) != MXG_NONE; ++i) {
        mxg_nodedef nodedef;
        mxg_port output = {.type = "multioutput"};
        bool is_new = false;
        if (!catalogue_nodedef(query, i, &nodedef))
            continue;
        if (nodedef.num_outputs == 1)
            catalogue_port(query, i, nodedef.num_inputs, &output);
        names_add(&known, output.type, &is_new);
        if (is_new)
            add_value(completion, output.type, COMPLETE_TYPE, NULL);
    }
    bool is_known = known.num_entries > 0;
    names_finish(&known);
    return is_known;
}

static void complete_type(struct completion *completion)
{
    const struct lsp_query *query = &completion->query;
    uint32_t element = completion->place.element;
    char category[QUERY_NAME];
    mxg_port port;
    query_category(query, element, category, sizeof category);
    if (catalogue_port_of(query, element, &port))
        add_value(completion, port.type, COMPLETE_TYPE, NULL);
    else if (!query_is_node(query, element) || !add_types_of_node(completion, category))
        add_words(completion, CATALOGUE_TYPES, COMPLETE_TYPE, NULL);
}

/* The names of inputs of the node; elsewhere a name is new. */
static void complete_name(struct completion *completion)
{
    const struct lsp_query *query = &completion->query;
    uint32_t input = completion->place.element, node = query->model->elements[input].parent;
    mxg_nodedef nodedef;
    uint32_t index = query_is(query, input, "input") && query_is_node(query, node)
                         ? catalogue_resolve(query, node)
                         : MXG_NONE;
    if (index == MXG_NONE || !catalogue_nodedef(query, index, &nodedef))
        return;
    for (uint32_t i = 0; i < nodedef.num_inputs; ++i) {
        mxg_port port;
        if (catalogue_port(query, index, i, &port))
            completion_add(completion, (struct completion_item){.label = port.name,
                                                                .kind = COMPLETE_FIELD,
                                                                .detail = port.type,
                                                                .doc = port.doc});
    }
}

static void complete_units(struct completion *completion)
{
    char kind[QUERY_NAME];
    mxg_port port;
    query_text(&completion->query, completion->place.element, "unittype", kind, sizeof kind);
    bool is_known =
        !*kind && catalogue_port_of(&completion->query, completion->place.element, &port);
    add_words(completion, CATALOGUE_UNITS, COMPLETE_UNIT, is_known ? port.unittype : kind);
}

static void complete_unit_types(struct completion *completion)
{
    add_words(completion, CATALOGUE_UNIT_TYPES, COMPLETE_UNIT, NULL);
}

static void complete_colorspaces(struct completion *completion)
{
    add_words(completion, CATALOGUE_COLORSPACES, COMPLETE_VALUE, NULL);
}

static void complete_geomprops(struct completion *completion)
{
    char type[QUERY_NAME];
    query_text(&completion->query, completion->place.element, "type", type, sizeof type);
    add_words(completion, CATALOGUE_GEOMPROPS, COMPLETE_VALUE, type);
}

static void complete_targets(struct completion *completion)
{
    add_words(completion, CATALOGUE_TARGETS, COMPLETE_VALUE, NULL);
}

static void complete_booleans(struct completion *completion)
{
    add_list(completion, "true, false");
}

static void complete_spaces(struct completion *completion)
{
    add_list(completion, "model, object, world, tangent");
}

static void complete_versions(struct completion *completion)
{
    if (query_is(&completion->query, completion->place.element, "materialx"))
        add_value(completion, "1.39", COMPLETE_VALUE, NULL);
}

/* Definitions of the node, or all. */
static void complete_nodedefs(struct completion *completion)
{
    const struct lsp_query *query = &completion->query;
    char category[QUERY_NAME];
    query_category(query, completion->place.element, category, sizeof category);
    bool is_node = query_is_node(query, completion->place.element);
    for (uint32_t i = 0, num = catalogue_num_nodedefs(query); i < num; ++i) {
        mxg_nodedef nodedef;
        if (catalogue_nodedef(query, i, &nodedef)
            && (!is_node || strcmp(nodedef.node, category) == 0))
            add_value(completion, nodedef.name, COMPLETE_REFERENCE, nodedef.node);
    }
}

static void complete_includes(struct completion *completion)
{
    add_files(completion, "", ".mtlx");
}

static void complete_sources(struct completion *completion)
{
    add_files(completion, "", ".glsl");
}

/* Who knows the values of an attribute. */
static const struct {
    const char *attribute;
    void (*complete)(struct completion *completion);
} sources[] = {
    {"value", complete_value},
    {"type", complete_type},
    {"name", complete_name},
    {"nodename", complete_nodes},
    {"nodegraph", complete_graphs},
    {"output", complete_outputs},
    {"interfacename", complete_interface},
    {"nodedef", complete_nodedefs},
    {"inherit", complete_nodedefs},
    {"colorspace", complete_colorspaces},
    {"unit", complete_units},
    {"unittype", complete_unit_types},
    {"defaultgeomprop", complete_geomprops},
    {"target", complete_targets},
    {"version", complete_versions},
    {"material", complete_materials},
    {"space", complete_spaces},
    {"href", complete_includes},
    {"file", complete_sources},
    {"uniform", complete_booleans},
    {"uiadvanced", complete_booleans},
    {"uivisible", complete_booleans},
    {"isdefaultversion", complete_booleans},
    {"visible", complete_booleans},
    {"exclusive", complete_booleans},
};

void complete_values(struct completion *completion)
{
    const struct model_attribute *attribute = completion->place.attribute;
    bool is_found = false;
    for (size_t i = 0; i < sizeof sources / sizeof *sources && !is_found; ++i) {
        is_found = query_equals(completion->query.text, attribute->name, sources[i].attribute);
        if (is_found)
            sources[i].complete(completion);
    }
    if (!is_found)
        complete_named(completion);
}
