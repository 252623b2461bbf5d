// SPDX-License-Identifier: Apache-2.0
/*
 * A material as an OSL shader group: writes the shaders of its nodes into a folder, and prints the
 * list of layers for ShadingSystem::ShaderGroupBegin. testshade also accepts the list, after oslc
 * compiled the shaders:
 *
 *     osl_network marble.mtlx folder >folder/marble.oslgroup
 *     cd folder && for f in *.osl; do oslc $f; done && testshade --group marble.oslgroup
 */
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

static bool write_part(const mxg_part *part, const char *folder)
{
    char path[1024];
    int len = snprintf(path, sizeof path, "%s/%s.osl", folder, part->name);
    FILE *file = len > 0 && (size_t)len < sizeof path ? fopen(path, "w") : NULL;
    if (!file) {
        perror(path);
        return false;
    }
    bool whole = fwrite(part->source, 1, part->source_size, file) == part->source_size;
    return fclose(file) == 0 && whole;
}

static bool write_network(const mxg_result *result, const char *folder)
{
    for (uint32_t i = 0; i < mxg_result_num_parts(result); ++i) {
        mxg_part part = MXG_INIT(mxg_part);
        if (mxg_result_part(result, i, &part) != MXG_OK || !write_part(&part, folder))
            return false;
    }
    /* the vertex stage is the group of the displacement, if there is one */
    puts(mxg_result_source(result, MXG_STAGE_PIXEL, NULL));
    return true;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fputs("usage: osl_network MATERIAL.mtlx FOLDER\n", stderr);
        return 2;
    }
    mxg_context *context = NULL;
    mxg_document *document = NULL;
    mxg_options *options = NULL;
    mxg_result *result = NULL;
    if (mxg_context_create(NULL, &context) != MXG_OK
        || mxg_options_create(context, &options) != MXG_OK)
        return 1;
    mxg_library *library = mxg_library_builtin(context);
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = "osl";
    desc.options = options;
    mxg_options_set(options, "osl-network", "true");
    bool good = mxg_document_load(context, library, argv[1], &document) == MXG_OK;
    print_diagnostics(mxg_document_diagnostics(document));
    good = good && mxg_generate(context, document, &desc, &result) == MXG_OK
           && write_network(result, argv[2]);
    print_diagnostics(mxg_result_diagnostics(result));
    mxg_result_destroy(result);
    mxg_options_destroy(options);
    mxg_document_destroy(document);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    return good ? 0 : 1;
}
