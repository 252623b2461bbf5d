// SPDX-License-Identifier: Apache-2.0
/*
 * Builds a document without a file, makes a second one from it with another value, and writes both
 * as MaterialX.
 */
#include <mxgen/mxgen.h>

#include <stdio.h>

/* A standard surface with noise as its roughness, and its material. */
static void build(mxg_edit *edit)
{
    mxg_element noise = mxg_edit_add_element(edit, 0, "noise2d", "Spots", "float"),
                shader = mxg_edit_add_element(edit, 0, "standard_surface", "SR", "surfaceshader"),
                material = mxg_edit_add_element(edit, 0, "surfacematerial", "Copper", "material");
    const float copper[] = {0.93f, 0.62f, 0.52f};
    mxg_edit_set_numbers(edit, shader, "base_color", "color3", copper, 3);
    mxg_edit_set_value(edit, shader, "metalness", "float", "1");
    mxg_edit_connect_input(edit, shader, "specular_roughness", noise, NULL);
    mxg_edit_connect_input(edit, material, "surfaceshader", shader, NULL);
}

static void print(const mxg_document *document)
{
    fputs(mxg_document_xml(document, NULL), stdout);
}

int main(void)
{
    mxg_context *context = NULL;
    mxg_edit *edit = NULL;
    mxg_document *copper = NULL, *polished = NULL;
    if (mxg_context_create(NULL, &context) != MXG_OK)
        return 1;
    mxg_library *library = mxg_library_builtin(context);
    mxg_edit_create(context, library, NULL, "copper", &edit);
    build(edit);
    char reason[256];
    if (mxg_edit_error(edit, reason, sizeof reason))
        fprintf(stderr, "%s\n", reason);
    if (mxg_edit_commit(edit, &copper) != MXG_OK)
        return 1;
    mxg_edit_destroy(edit);
    print(copper);

    /* The first document stays as it is. Elements keep their numbers. */
    mxg_edit_create(context, library, copper, NULL, &edit);
    mxg_edit_set_value(edit, mxg_document_find_element(copper, 0, "SR"), "specular_roughness", NULL,
                       "0.1");
    mxg_edit_remove_element(edit, mxg_document_find_element(copper, 0, "Spots"));
    if (mxg_edit_commit(edit, &polished) != MXG_OK)
        return 1;
    mxg_edit_destroy(edit);
    print(polished);
    mxg_document_destroy(copper);
    mxg_document_destroy(polished);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    return 0;
}
