// SPDX-License-Identifier: Apache-2.0
/* From a document to GLSL: prints the pixel stage of the first material of a file. */
#include <mxgen/mxgen.h>

#include <stdio.h>

static void print_diagnostics(const mxg_diagnostics *list)
{
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(list); ++i) {
        char text[1024];
        mxg_diagnostics_format(list, i, NULL, 0, false, text, sizeof text);
        fprintf(stderr, "%s\n", text);
    }
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fputs("usage: c_minimal MATERIAL.mtlx\n", stderr);
        return 2;
    }
    mxg_context *context = NULL;
    mxg_document *document = NULL;
    mxg_result *result = NULL;
    if (mxg_context_create(NULL, &context) != MXG_OK)
        return 1;
    mxg_library *library = mxg_library_builtin(context);
    mxg_status status = mxg_document_load(context, library, argv[1], &document);
    print_diagnostics(mxg_document_diagnostics(document));
    if (status == MXG_OK) {
        mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
        desc.target = "glsl";
        status = mxg_generate(context, document, &desc, &result);
        print_diagnostics(mxg_result_diagnostics(result));
    }
    if (status == MXG_OK)
        puts(mxg_result_source(result, MXG_STAGE_PIXEL, NULL));
    mxg_result_destroy(result); /* NULL is allowed everywhere here */
    mxg_document_destroy(document);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    return status == MXG_OK ? 0 : 1;
}
