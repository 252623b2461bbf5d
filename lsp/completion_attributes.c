// SPDX-License-Identifier: Apache-2.0
/* Attributes that an element may have and lacks. */
#include "lsp/completion.h"
#include "lsp/element_infos.h"
#include "program/cli.h"

#include <stdlib.h>
#include <string.h>

/* Attributes that people write most stand first. */
static bool is_common(const char *name)
{
    static const char *const names[] = {"name",     "type",      "value",
                                        "nodename", "nodegraph", "interfacename",
                                        "output",   "nodedef",   "node"};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        if (strcmp(names[i], name) == 0)
            return true;
    return false;
}

void complete_attributes(struct completion *completion)
{
    const struct lsp_query *query = &completion->query;
    const struct place *place = &completion->place;
    char category[QUERY_NAME];
    query_category(query, place->element, category, sizeof category);
    bool has_value = place->attribute && place->attribute->has_value;
    if (place->attribute)
        completion->replaced = place->attribute->name;
    for (size_t i = 0; i < num_attribute_infos; ++i) {
        const struct attribute_info *info = &attribute_infos[i];
        const struct model_attribute *there = query_attribute(query, place->element, info->name);
        if (!elements_fit(info->elements, category) || (there && there != place->attribute))
            continue;
        char *text = cli_format(has_value ? "%s" : "%s=\"\"", info->name),
             *snippet = cli_format("%s=\"$1\"", info->name);
        completion_add(completion, (struct completion_item){.label = info->name,
                                                            .kind = COMPLETE_PROPERTY,
                                                            .doc = info->doc,
                                                            .text = text,
                                                            .snippet = has_value ? NULL : snippet,
                                                            .is_first = is_common(info->name)});
        free(snippet);
        free(text);
    }
}
