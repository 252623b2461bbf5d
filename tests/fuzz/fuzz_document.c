// SPDX-License-Identifier: Apache-2.0
/*
 * A document with its includes and sources: loaded, validated, looked at, and what it renders
 * generated, for a target, a role and an interface that the bytes choose. A status that a document
 * cannot be the reason of is a fault.
 */
#include "files.h"
#include "mutate.h"

enum { MAX_RENDERABLES = 3 };

static const char *const targets[] = {"glsl",    "vulkan", "essl", "hlsl", "osl",
                                      "essl310", "slang",  "msl",  "wgsl", "mdl"};
static const char *const interfaces[] = {"complete", "authored", "reduced"};
/* Each with the options that it takes most code with. */
static const struct {
    const char *role, *option, *value;
} roles[] = {{"raster", NULL, NULL},       {"raster", "slabs", "true"},
             {"raster", "max-slabs", "1"}, {"deferred", "slabs", "true"},
             {"scatter", NULL, NULL},      {"payload", NULL, NULL},
             {"pack", "slabs", "true"},    {"function", NULL, NULL}};
enum { NUM_TARGETS = sizeof targets / sizeof *targets, NUM_ROLES = sizeof roles / sizeof *roles };

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
    FUZZ_REQUIRE(fuzz_is_expected(status));
    FUZZ_REQUIRE((status == MXG_OK) == (mxg_result_source(result, MXG_STAGE_PIXEL, NULL) != NULL));
    format_all(mxg_result_diagnostics(result), files);
    mxg_result_reflection_json(result, NULL);
    mxg_result_destroy(result);
}

static void set_role(mxg_options *options, unsigned which)
{
    mxg_options_set(options, "role", roles[which].role);
    if (roles[which].option)
        mxg_options_set(options, roles[which].option, roles[which].value);
}

static void use(const struct fuzz_document *opened, unsigned choice)
{
    mxg_context *context = opened->context;
    const mxg_document *document = opened->document;
    const struct fuzz_files *files = opened->files;
    format_all(mxg_document_diagnostics(document), files);
    mxg_options *options = NULL;
    mxg_result *result = NULL;
    if (mxg_options_create(context, &options) == MXG_OK)
        mxg_options_set(options, "interface", interfaces[choice / 8 % 3]);
    const char *target = targets[choice / 64 % NUM_TARGETS];
    bool has_closures = strcmp(target, "osl") == 0 || strcmp(target, "mdl") == 0;
    if (options && strcmp(target, "osl") == 0 && choice % 4 == 0)
        mxg_options_set(options, "osl-network", "true");
    if (options && !has_closures && choice % 2)
        set_role(options, choice / 2 % NUM_ROLES);
    FUZZ_REQUIRE(fuzz_is_expected(mxg_validate(context, document, &result)));
    format_all(mxg_result_diagnostics(result), files);
    mxg_result_destroy(result);
    mxg_generate_desc desc = {sizeof desc, target, NULL, options};
    for (uint32_t i = 0; i < mxg_document_num_renderables(document) && i < MAX_RENDERABLES; i++) {
        mxg_renderable renderable = {sizeof renderable};
        FUZZ_REQUIRE(mxg_document_renderable(document, i, &renderable) == MXG_OK);
        desc.element = renderable.path;
        generate(context, document, &desc, files);
    }
    FUZZ_REQUIRE(fuzz_is_expected(
        mxg_inspect(context, document, (mxg_view)(choice / 512 % 6), &desc, &result)));
    mxg_result_destroy(result);
    mxg_options_destroy(options);
}

void fuzz_run(const char *data, size_t size, struct fuzz_heap *heap)
{
    fuzz_files_open(data, size, heap, fuzz_choice(data, size, 2) != 0, use);
}
