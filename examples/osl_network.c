// SPDX-License-Identifier: Apache-2.0
/*
 * A material as an OSL shader group: writes the shaders of its nodes into a folder, and prints the list of layers that makes a group of them,
 * as ShadingSystem::ShaderGroupBegin takes it. Compiled with oslc, and with the list in a file, testshade takes them, too:
 *
 *     osl_network marble.mtlx folder >folder/marble.oslgroup
 *     cd folder && for f in *.osl; do oslc $f; done && testshade --group marble.oslgroup
 */
#include <mxgen/mxgen.h>

#include <stdio.h>

static bool write_part(const mxg_part *part, const char *folder)
{
    char path[1024];
    int len = snprintf(path, sizeof path, "%s/%s.osl", folder, part->name);
    FILE *file = len > 0 && (size_t)len < sizeof path ? fopen(path, "w") : NULL;
    if (!file)
        return false;
    bool whole = fwrite(part->source, 1, part->source_size, file) == part->source_size;
    return fclose(file) == 0 && whole;
}

static bool write_network(const mxg_result *result, const char *folder)
{
    for (uint32_t i = 0; i < mxg_result_num_parts(result); ++i) {
        mxg_part part = {sizeof part};
        if (mxg_result_part(result, i, &part) != MXG_OK || !write_part(&part, folder))
            return false;
    }
    puts(mxg_result_source(result, MXG_STAGE_PIXEL, NULL)); /* that of the vertex stage moves the surface, if anything does */
    return true;
}

int main(int argc, char **argv)
{
    mxg_context *context = NULL;
    mxg_document *document = NULL;
    mxg_options *options = NULL;
    mxg_result *result = NULL;
    bool good = false;
    if (argc != 3 || mxg_context_create(NULL, &context) != MXG_OK)
        return 2;
    mxg_library *library = mxg_library_builtin(context);
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = "osl";
    if (mxg_options_create(context, &options) == MXG_OK && mxg_options_set(options, "osl-network", "true") == MXG_OK
        && mxg_document_load(context, library, argv[1], &document) == MXG_OK) {
        desc.options = options;
        good = mxg_generate(context, document, &desc, &result) == MXG_OK && write_network(result, argv[2]);
    }
    mxg_result_destroy(result);
    mxg_options_destroy(options);
    mxg_document_destroy(document);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    return good ? 0 : 1;
}
