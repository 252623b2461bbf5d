// SPDX-License-Identifier: Apache-2.0
/*
 * A document as a surface of another model, which the bytes choose. What comes out is a document
 * that loads, and to translate it again changes nothing.
 */
#include "files.h"

#include <string.h>

static const char *const models[] = {"gltf_pbr", "open_pbr_surface", "UsdPreviewSurface",
                                     "standard_surface", "disney_principled"};
enum { NUM_MODELS = sizeof models / sizeof *models };

static bool is_expected(mxg_status status)
{
    return status == MXG_OK || status == MXG_ERROR_DOCUMENT || status == MXG_ERROR_MEMORY;
}

/* Translates a text once more. */
static void repeat(mxg_context *context, mxg_library *library, const char *text, size_t size,
                   const char *model)
{
    mxg_document *document = NULL;
    mxg_result *result = NULL;
    size_t again = 0;
    mxg_status status =
        mxg_document_parse(context, library, "translated.mtlx", text, size, &document);
    FUZZ_REQUIRE(status == MXG_OK || status == MXG_ERROR_MEMORY);
    if (document)
        status = mxg_translate(context, document, model, &result);
    FUZZ_REQUIRE(status == MXG_OK || status == MXG_ERROR_MEMORY);
    const char *same = mxg_result_text(result, &again);
    FUZZ_REQUIRE(!same || (again == size && memcmp(same, text, size) == 0));
    mxg_result_destroy(result);
    mxg_document_destroy(document);
}

static void translate(mxg_context *context, mxg_library *library, const mxg_document *document,
                      const char *model)
{
    mxg_result *result = NULL;
    size_t size = 0;
    mxg_status status = mxg_translate(context, document, model, &result);
    const char *text = mxg_result_text(result, &size);
    FUZZ_REQUIRE(is_expected(status));
    FUZZ_REQUIRE((status == MXG_OK) == (text != NULL));
    if (text)
        repeat(context, library, text, size, model);
    mxg_result_destroy(result);
}

void fuzz_run(const char *data, size_t size, struct fuzz_heap *heap)
{
    struct fuzz_files files;
    fuzz_files_split(&files, data, size);
    mxg_context_desc limits = {.max_memory = (size_t)256 << 20,
                               .max_elements = 20000,
                               .max_nodes = 50000,
                               .max_output_mib = 4};
    mxg_context *context = fuzz_files_context(&files, heap, limits);
    mxg_document *document = NULL;
    if (!context)
        return;
    mxg_library *library = mxg_library_builtin(context);
    FUZZ_REQUIRE(is_expected(mxg_document_load(context, library, "main.mtlx", &document)));
    if (document && !mxg_diagnostics_num_errors(mxg_document_diagnostics(document)))
        translate(context, library, document, models[fuzz_choice(data, size, NUM_MODELS)]);
    mxg_document_destroy(document);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    FUZZ_REQUIRE(files.num_open == 0);
}
