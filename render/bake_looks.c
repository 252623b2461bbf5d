// SPDX-License-Identifier: Apache-2.0
/*
 * Looks of the document, with their collections, sets of properties and what the document says of
 * geometries, over the materials of the new one. Layers that are nodegraphs and variants change
 * inputs that may be images now, so they are left out, and told.
 */
#include "render/bake.h"

#include <stdlib.h>
#include <string.h>

bool bake_is_of_look(const mxg_document *document, mxg_element element)
{
    static const char *const categories[] = {
        "look", "lookgroup", "collection", "propertyset", "geominfo", "tokendefault", NULL};
    return args_is_one_of(bake_element(document, element).category, categories);
}

/* The name that the new document has for a material; NULL: it does not have it. */
static const char *name_of(const struct baking *baking, const char *material)
{
    const struct bake_plan *plan = &baking->plan;
    size_t index = bake_plan_find(plan, mxg_document_find_element(baking->document, 0, material));
    return index < plan->num_nodes ? plan->nodes[index].name : NULL;
}

/* Why an element of a look cannot stay; NULL: it can. */
static const char *why_lost(const struct baking *baking, mxg_element element)
{
    const mxg_document *document = baking->document;
    const char *category = bake_element(document, element).category,
               *material = bake_attribute(document, element, "material"),
               *graph = bake_attribute(document, element, "nodegraph");
    if (strcmp(category, "variantassign") == 0)
        return "variants change inputs that are baked";
    if (strcmp(category, "materialassign") != 0)
        return NULL;
    if (graph && *graph)
        return "a layer that is a nodegraph changes inputs that are baked";
    return material && *material && !name_of(baking, material) ? "its material is not there" : NULL;
}

static void tell_lost(struct baking *baking, mxg_element element, const char *why)
{
    char *path = bake_path(baking->document, element), *place = bake_place(baking, element);
    report_warning(&baking->cli.report, "bake-look", "'%s' (%s) is not in the baked document: %s",
                   path, place, why);
    free(path);
    free(place);
}

/*
 * Removes what cannot stay of the copy of a look, which has its name, and names materials as they
 * are now.
 */
static void adapt(struct baking *baking, mxg_edit *edit, mxg_element look)
{
    for (mxg_element child = bake_element(baking->document, look).first_child; child;
         child = bake_element(baking->document, child).next) {
        const char *why = why_lost(baking, child),
                   *material = bake_attribute(baking->document, child, "material");
        char *path = bake_path(baking->document, child);
        mxg_element copy = mxg_edit_find_element(edit, 0, path);
        if (why) {
            mxg_edit_remove_element(edit, copy);
            tell_lost(baking, child, why);
        } else if (material && *material) {
            mxg_edit_set_attribute(edit, copy, "material", name_of(baking, material));
        }
        free(path);
    }
}

void bake_add_looks(struct baking *baking, mxg_edit *edit)
{
    const mxg_document *document = baking->document;
    for (mxg_element child = bake_element(document, 0).first_child; child;
         child = bake_element(document, child).next) {
        if (!bake_is_of_look(document, child))
            continue;
        bake_copy(baking, edit, child);
        adapt(baking, edit, child);
    }
}
