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

static void translate(const struct fuzz_document *opened, unsigned choice)
{
    const char *model = models[choice % NUM_MODELS];
    mxg_result *result = NULL;
    size_t size = 0;
    if (mxg_diagnostics_num_errors(mxg_document_diagnostics(opened->document)))
        return;
    mxg_status status = mxg_translate(opened->context, opened->document, model, &result);
    const char *text = mxg_result_text(result, &size);
    FUZZ_REQUIRE(fuzz_is_expected(status));
    FUZZ_REQUIRE((status == MXG_OK) == (text != NULL));
    if (text)
        repeat(opened->context, opened->library, text, size, model);
    mxg_result_destroy(result);
}

void fuzz_run(const char *data, size_t size, struct fuzz_heap *heap)
{
    fuzz_files_open(data, size, heap, false, translate);
}
