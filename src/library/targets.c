// SPDX-License-Identifier: Apache-2.0
/* The targets that definitions and implementations are for (specification, "NodeDef Elements"). */
#include "library/index_priv.h"

static bool add_target(struct index_targets *targets, str_id name)
{
    for (uint32_t i = 0; i < targets->len; i++)
        if (targets->items[i] == name)
            return true;
    if (targets->len == INDEX_MAX_TARGETS)
        return false;
    targets->items[targets->len++] = name;
    return true;
}

void index_read_targets(struct indexer *ix, elem_id element, struct index_targets *out)
{
    str_id attr = index_attr(ix, element, STR_target);
    const char *rest = attr ? index_text(ix, attr) : "";
    struct text_word name;
    bool has_room = true;
    out->len = 0;
    while (has_room && text_next_item(&rest, &name))
        if (name.len)
            has_room =
                add_target(out, str_intern(&ix->lib->strings, name.bytes, (uint32_t)name.len));
    if (!has_room)
        diag_add(ix->diags, DIAG_ID_too_many_variants,
                 doc_attr_place(&ix->lib->doc, element, STR_target),
                 index_text(ix, doc_element(&ix->lib->doc, element)->name),
                 (unsigned)INDEX_MAX_TARGETS, "targets");
    if (!out->len)
        out->items[out->len++] = 0;
}

static bool is_for(const struct library *layer, const struct nodedef *def, str_id target)
{
    for (unsigned i = 0; i < def->num_targets; i++)
        if (layer->refs.items[def->first_target + i] == target)
            return true;
    return false;
}

unsigned library_target_fit(const struct library *lib, uint32_t nodedef)
{
    const struct library *layer = lib;
    while (nodedef < layer->base_nodedefs)
        layer = layer->base;
    const struct nodedef *def = &layer->nodedefs.items[nodedef - layer->base_nodedefs];
    if (!lib->num_targets)
        return def->num_targets ? 1 : 2;
    for (unsigned i = 0; def->num_targets && i < lib->num_targets; i++)
        if (is_for(layer, def, lib->targets[i]))
            return 1 + lib->num_targets - i;
    return def->num_targets ? 0 : 1;
}

bool library_share_target(const struct library *layer, const struct nodedef *a,
                          const struct nodedef *b)
{
    for (unsigned i = 0; i < a->num_targets; i++)
        if (is_for(layer, b, layer->refs.items[a->first_target + i]))
            return true;
    return !a->num_targets && !b->num_targets;
}

bool library_depends_on_target(const struct library *lib, elem_id node)
{
    str_id category = doc_element(&lib->doc, node)->category;
    for (const struct library *layer = lib; layer; layer = layer->base)
        for (uint32_t own = library_first_of_node(layer, category); own != LIBRARY_NONE;
             own = layer->nodedefs.items[own].next_same_node)
            if (layer->nodedefs.items[own].num_targets)
                return true;
    return false;
}
