// SPDX-License-Identifier: Apache-2.0
/* Elements that fit a place: MaterialX's own, nodes of the library and the document, inputs of a
 * node. */
#include "lsp/catalogue.h"
#include "lsp/completion.h"
#include "lsp/element_infos.h"
#include "program/cli.h"
#include "program/name_table.h"

#include <stdlib.h>
#include <string.h>

/* The text around the cursor: an item brings the '<', the attributes and the end that are
 * missing. */
struct setting {
    uint32_t parent;
    const char *before;      /* "<" or "" */
    bool is_alone;           /* the name alone is written, so the rest comes with it */
    struct name_table names; /* of the children of the parent */
};

static struct setting setting_of(struct completion *completion)
{
    const struct lsp_query *query = &completion->query;
    struct setting setting = {.parent = completion->place.element, .before = "<", .is_alone = true};
    if (completion->place.part != PLACE_CATEGORY)
        return setting;
    const struct model_element *element = &query->model->elements[completion->place.element];
    setting.parent = element->parent;
    setting.before = "";
    setting.is_alone = element->num_attributes == 0 && element->is_broken;
    completion->replaced = element->name;
    return setting;
}

static void note_names(const struct lsp_query *query, uint32_t parent, struct name_table *names)
{
    for (uint32_t child = model_first(query->model, parent); child != MODEL_NONE;
         child = model_next(query->model, child)) {
        char name[QUERY_NAME];
        bool is_new;
        names_add(names, query_text(query, child, "name", name, sizeof name), &is_new);
    }
}

/* A name that no element beside the new one has: the category with a number. */
static char *new_name(const struct name_table *names, const char *stem)
{
    for (unsigned number = 1;; ++number) {
        char *name = cli_format("%s%u", stem, number);
        if (!names_find(names, name))
            return name;
        free(name);
    }
}

static const char *type_of(const struct lsp_query *query, uint32_t index,
                           const mxg_nodedef *nodedef, mxg_port *port)
{
    bool is_single =
        nodedef->num_outputs == 1 && catalogue_port(query, index, nodedef->num_inputs, port);
    return is_single ? port->type : "multioutput";
}

static void add_node(struct completion *completion, const struct setting *setting, uint32_t index)
{
    const struct lsp_query *query = &completion->query;
    mxg_nodedef nodedef;
    mxg_port port;
    if (!catalogue_nodedef(query, index, &nodedef))
        return;
    const char *type = type_of(query, index, &nodedef, &port);
    char *name = new_name(&setting->names, nodedef.node),
         *plain = cli_format("%s%s", setting->before, nodedef.node),
         *snippet = cli_format("%s%s name=\"${1:%s}\" type=\"${2:%s}\">\n  $0\n</%s>",
                               setting->before, nodedef.node, name, type, nodedef.node);
    completion_add(completion,
                   (struct completion_item){.label = nodedef.node,
                                            .kind = COMPLETE_FUNCTION,
                                            .detail = nodedef.group,
                                            .doc = nodedef.doc,
                                            .text = plain,
                                            .filter = plain,
                                            .snippet = setting->is_alone ? snippet : NULL});
    free(snippet);
    free(plain);
    free(name);
}

/* Each node once, by its first definition. */
static void add_nodes(struct completion *completion, const struct setting *setting)
{
    struct name_table known = {0};
    uint32_t num = catalogue_num_nodedefs(&completion->query);
    for (uint32_t i = 0; i < num; ++i) {
        mxg_nodedef nodedef;
        bool is_new = false;
        if (catalogue_nodedef(&completion->query, i, &nodedef) && *nodedef.node)
            names_add(&known, nodedef.node, &is_new);
        if (is_new)
            add_node(completion, setting, i);
    }
    names_finish(&known);
}

/* MaterialX's own elements; an <input> of a node comes with its name. */
static void add_elements(struct completion *completion, const struct setting *setting,
                         const char *parent)
{
    for (size_t i = 0; i < num_element_infos; ++i) {
        const struct element_info *info = &element_infos[i];
        if (!elements_fit(info->parents, parent))
            continue;
        char *plain = cli_format("%s%s", setting->before, info->category);
        char *snippet = strcmp(info->category, "xi:include") == 0
                            ? cli_format("%s href=\"$1\"/>", plain)
                            : cli_format("%s name=\"$1\"$2/>", plain);
        completion_add(completion,
                       (struct completion_item){.label = info->category,
                                                .kind = COMPLETE_CLASS,
                                                .doc = info->doc,
                                                .text = plain,
                                                .filter = plain,
                                                .snippet = setting->is_alone ? snippet : NULL});
        free(snippet);
        free(plain);
    }
}

static void add_input(struct completion *completion, const struct setting *setting,
                      const mxg_port *port)
{
    char *label = cli_format("input %s", port->name), *value = completion_escape(port->value),
         *detail = cli_format("%s%s%s", port->type, *port->value ? " = " : "", port->value),
         *plain = cli_format("%sinput name=\"%s\" type=\"%s\" value=\"%s\"/>", setting->before,
                             port->name, port->type, port->value),
         *snippet = cli_format("%sinput name=\"%s\" type=\"%s\" value=\"${1:%s}\"/>$0",
                               setting->before, port->name, port->type, value),
         *filter = cli_format("%sinput %s", setting->before, port->name);
    completion_add(completion, (struct completion_item){.label = label,
                                                        .kind = COMPLETE_FIELD,
                                                        .detail = detail,
                                                        .doc = port->doc,
                                                        .text = plain,
                                                        .filter = filter,
                                                        .snippet = snippet,
                                                        .is_first = true});
    free(filter);
    free(snippet);
    free(plain);
    free(detail);
    free(value);
    free(label);
}

/* The inputs of the node that it does not have yet. */
static void add_inputs(struct completion *completion, const struct setting *setting)
{
    const struct lsp_query *query = &completion->query;
    uint32_t nodedef = catalogue_resolve(query, setting->parent);
    mxg_nodedef info;
    if (!setting->is_alone || nodedef == MXG_NONE || !catalogue_nodedef(query, nodedef, &info))
        return;
    for (uint32_t i = 0; i < info.num_inputs; ++i) {
        mxg_port port;
        if (catalogue_port(query, nodedef, i, &port) && !names_find(&setting->names, port.name))
            add_input(completion, setting, &port);
    }
}

void complete_elements(struct completion *completion)
{
    char parent[QUERY_NAME];
    struct setting setting = setting_of(completion);
    query_category(&completion->query, setting.parent, parent, sizeof parent);
    bool is_graph = strcmp(parent, "nodegraph") == 0 || strcmp(parent, "materialx") == 0;
    if (setting.parent == MODEL_NONE)
        return;
    note_names(&completion->query, setting.parent, &setting.names);
    if (query_is_node(&completion->query, setting.parent))
        add_inputs(completion, &setting);
    add_elements(completion, &setting, parent);
    if (is_graph)
        add_nodes(completion, &setting);
    names_finish(&setting.names);
}
