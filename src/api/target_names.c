// SPDX-License-Identifier: Apache-2.0
/* The names under which implementations serve a target. */
#include "api/generation.h"

/* A chain of targetdefs that is longer has a cycle, which validation tells. */
enum { MAX_ANCESTORS = 16 };

struct target_list { /* layout of VEC(str_id) */
    str_id *items;
    uint32_t len, cap;
};

static bool has(const struct target_list *list, str_id name)
{
    for (uint32_t i = 0; i < list->len; i++)
        if (list->items[i] == name)
            return true;
    return false;
}

/* Adds what the targets inherit by <targetdef>, in the document or in the library. */
static void add_ancestors(struct generation *g, struct target_list *list)
{
    const struct document *doc = &g->document->layer.doc;
    str_id name = list->items[0];
    for (unsigned i = 0; i < MAX_ANCESTORS && name; i++) {
        elem_id definition = doc_top_level(doc, KIND_TARGETDEF, name);
        name = definition ? doc_attr_value(doc, definition, STR_inherit) : 0;
        if (name && !has(list, name))
            vec_push(&g->result->object.arena, list, name);
    }
}

void generation_name_targets(struct generation *g)
{
    struct target_list list = {0};
    for (const struct target *target = g->result->target; target; target = target->base)
        vec_push(&g->result->object.arena, &list,
                 str_intern_z(&g->result->strings, target->materialx_name));
    g->build_options.num_languages = list.len;
    add_ancestors(g, &list);
    g->build_options.targets = list.items;
    g->build_options.num_targets = list.len;
}
