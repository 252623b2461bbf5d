// SPDX-License-Identifier: Apache-2.0
/*
 * Looks of the document, with their collections and sets of properties, over the materials of the
 * new one. Layers that are nodegraphs and variants change inputs that may be images now, so they
 * are left out, and told.
 */
#include "render/bake.h"

#include <stdlib.h>
#include <string.h>

bool bake_is_of_look(const mxg_document *document, mxg_element element)
{
    static const char *const categories[] = {"look", "lookgroup", "collection", "propertyset",
                                             NULL};
    return args_is_one_of(bake_element(document, element).category, categories);
}

/* Why an element of a look cannot stay; NULL: it can. */
static const char *why_lost(const struct baking *baking, mxg_edit *edit, mxg_element element)
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
    return material && *material && !mxg_edit_find_element(edit, 0, material)
               ? "its material is not there"
               : NULL;
}

static void tell_lost(struct baking *baking, mxg_element element, const char *why)
{
    char *path = bake_path(baking->document, element), *place = bake_place(baking, element);
    report_warning(&baking->cli.report, "bake-look", "'%s' (%s) is not in the baked document: %s",
                   path, place, why);
    free(path);
    free(place);
}

/* Removes what cannot stay of the copy of a look, which has its name. */
static void remove_lost(struct baking *baking, mxg_edit *edit, mxg_element look)
{
    for (mxg_element child = bake_element(baking->document, look).first_child; child;) {
        mxg_element_info info = bake_element(baking->document, child);
        const char *why = why_lost(baking, edit, child);
        if (why) {
            char *path = bake_path(baking->document, child);
            mxg_edit_remove_element(edit, mxg_edit_find_element(edit, 0, path));
            tell_lost(baking, child, why);
            free(path);
        }
        child = info.next;
    }
}

void bake_add_looks(struct baking *baking, mxg_edit *edit)
{
    const mxg_document *document = baking->document;
    for (mxg_element child = bake_element(document, 0).first_child; child;
         child = bake_element(document, child).next) {
        if (!bake_is_of_look(document, child))
            continue;
        mxg_edit_copy_element(edit, 0, document, child, NULL);
        remove_lost(baking, edit, child);
    }
}
