// SPDX-License-Identifier: Apache-2.0
/*
 * An edit of a large document changes few elements. The document that it makes shares the rest with
 * its origin: elements, names, strings, definitions and renderables. This file decides whether the
 * changes leave the definitions as they are, need no upgrade, and inherit no values.
 */
#include "api/api.h"

#include <assert.h>

/*
 * With more changes the document stands alone: that takes time for each element, so the mean cost
 * of an edit stays small, and what is no longer in the document is gone.
 */
static bool are_many(const struct document *doc)
{
    enum { FEW = 1024 };
    uint64_t num = doc_num_changes(doc);
    return num > FEW && num > doc->whole->elements.len;
}

static bool is_definition(const struct document *doc, elem_id top)
{
    switch ((enum element_kind)doc_element(doc, top)->kind) {
    case KIND_NODE:
    case KIND_LOOK:
    case KIND_LOOKGROUP:
    case KIND_COLLECTION:
    case KIND_VARIANTSET:
    case KIND_PROPERTYSET:
    case KIND_GEOMINFO:
    case KIND_OUTPUT: return false;
    case KIND_NODEGRAPH: return doc_attr(doc, top, STR_nodedef) != NULL;
    default: return true;
    }
}

/* True if an element of the tree is a part of a definition. */
static bool defines(const struct document *doc, elem_id element)
{
    if (!doc_has_element(doc, element) || element == doc->root)
        return false;
    while (doc_element(doc, element)->parent != doc->root)
        element = doc_element(doc, element)->parent;
    return is_definition(doc, element);
}

static bool leaves_definitions(const struct document *doc, const struct doc_change *change)
{
    elem_id element = doc->first_element + change->index;
    if (doc_is_same(doc, change))
        return true;
    bool is_shared = change->index < doc->shared.elements;
    return element != doc->root && !doc_attr(doc, element, STR_namespace) && !defines(doc, element)
           && !doc_needs_upgrade(doc, element) && !doc_inherits_values(doc, element)
           && !(is_shared && defines(doc->origin, element));
}

static bool can_share(const mxg_document *document)
{
    const struct document *doc = &document->layer.doc;
    const mxg_document *origin = document->origin;
    if (!origin->is_silent || doc->has_templates || !doc->is_global
        || origin->layer.trust != document->layer.trust
        || doc->has_attributedefs != doc->origin->has_attributedefs || are_many(doc))
        return false;
    for (uint32_t i = 0; i < doc->changes.len; i++)
        if (doc->changes.items[i]->is_fresh && !leaves_definitions(doc, doc->changes.items[i]))
            return false;
    return true;
}

bool edit_share(mxg_document *document, struct arena *scratch, struct diag_list *diags)
{
    struct document *doc = &document->layer.doc;
    if (!can_share(document) || !renderables_follow(document, scratch))
        return false;
    for (uint32_t i = 0; i < doc->changes.len; i++)
        if (doc->changes.items[i]->is_fresh && !doc_is_same(doc, doc->changes.items[i]))
            doc_fix_paths_of(doc, doc->first_element + doc->changes.items[i]->index, diags);
    doc_keep_paths(doc);
    library_share(&document->layer, &document->origin->layer);
    document->is_silent = true;
    return true;
}
