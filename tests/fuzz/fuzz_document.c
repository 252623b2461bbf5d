// SPDX-License-Identifier: Apache-2.0
/*
 * A document with its includes and sources: loaded, validated, looked at, and what it renders
 * generated, for a target and an interface that the bytes choose. A status that a document cannot
 * be the reason of is a fault.
 */
#include "files.h"
#include "mutate.h"

enum { MAX_RENDERABLES = 3 };

static const char *const targets[] = {"glsl", "vulkan", "essl", "hlsl", "osl", "essl310"};
static const char *const interfaces[] = {"complete", "authored", "reduced"};

static bool is_expected(mxg_status status)
{
    return status == MXG_OK || status == MXG_ERROR_DOCUMENT || status == MXG_ERROR_MEMORY;
}

static void format_all(const mxg_diagnostics *list, const struct fuzz_files *files)
{
    char text[512];
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(list); i++)
        mxg_diagnostics_format(list, i, files->items[0].data, files->items[0].size, i % 2, text,
                               sizeof text);
}

static void generate(mxg_context *context, const mxg_document *document,
                     const mxg_generate_desc *desc, const struct fuzz_files *files)
{
    mxg_result *result = NULL;
    mxg_status status = mxg_generate(context, document, desc, &result);
    FUZZ_REQUIRE(is_expected(status));
    FUZZ_REQUIRE((status == MXG_OK) == (mxg_result_source(result, MXG_STAGE_PIXEL, NULL) != NULL));
    format_all(mxg_result_diagnostics(result), files);
    mxg_result_reflection_json(result, NULL);
    mxg_result_destroy(result);
}

static void use(mxg_context *context, const mxg_document *document, const struct fuzz_files *files,
                unsigned choice)
{
    mxg_options *options = NULL;
    mxg_result *result = NULL;
    if (mxg_options_create(context, &options) == MXG_OK)
        mxg_options_set(options, "interface", interfaces[choice / 8 % 3]);
    if (options && choice / 64 % 6 == 4 && choice % 4 == 0)
        mxg_options_set(options, "osl-network", "true");
    FUZZ_REQUIRE(is_expected(mxg_validate(context, document, &result)));
    format_all(mxg_result_diagnostics(result), files);
    mxg_result_destroy(result);
    mxg_generate_desc desc = {sizeof desc, targets[choice / 64 % 6], NULL, options};
    for (uint32_t i = 0; i < mxg_document_num_renderables(document) && i < MAX_RENDERABLES; i++) {
        mxg_renderable renderable = {sizeof renderable};
        FUZZ_REQUIRE(mxg_document_renderable(document, i, &renderable) == MXG_OK);
        desc.element = renderable.path;
        generate(context, document, &desc, files);
    }
    FUZZ_REQUIRE(
        is_expected(mxg_inspect(context, document, (mxg_view)(choice / 512 % 6), &desc, &result)));
    mxg_result_destroy(result);
    mxg_options_destroy(options);
}

void fuzz_run(const char *data, size_t size, struct fuzz_heap *heap)
{
    struct fuzz_files files;
    fuzz_files_split(&files, data, size);
    mxg_context_desc limits = {.max_memory = (size_t)256 << 20,
                               .max_elements = 20000,
                               .max_nodes = 50000,
                               .max_output_mib = 4,
                               .trust = fuzz_choice(data, size, 2) != 0};
    mxg_context *context = fuzz_files_context(&files, heap, limits);
    mxg_document *document = NULL;
    if (!context)
        return;
    mxg_library *library = mxg_library_builtin(context);
    FUZZ_REQUIRE(is_expected(mxg_document_load(context, library, "main.mtlx", &document)));
    if (document) {
        format_all(mxg_document_diagnostics(document), &files);
        use(context, document, &files, fuzz_choice(data, size, 4096));
    }
    mxg_document_destroy(document);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    FUZZ_REQUIRE(files.num_open == 0);
}

/* ---- Mutation, which libFuzzer calls ---- */

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t max_size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed);
size_t LLVMFuzzerCustomCrossOver(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size,
                                 uint8_t *out, size_t max_size, unsigned seed);

#ifdef MXG_FUZZ
enum { BYTES = 8 }; /* one mutation of so many is of bytes */

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed)
{
    return seed % BYTES == 0 ? LLVMFuzzerMutate(data, size, max_size)
                             : mutate_document((char *)data, size, max_size, seed);
}

size_t LLVMFuzzerCustomCrossOver(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size,
                                 uint8_t *out, size_t max_size, unsigned seed)
{
    return mutate_cross((const char *)a, a_size, (const char *)b, b_size, (char *)out, max_size,
                        seed);
}
#endif
