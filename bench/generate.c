// SPDX-License-Identifier: Apache-2.0
/*
 * bench-generate FILE TARGET N [library=PATH] [KEY=VALUE...]: loads library and document, then
 * generates N times. PATH is a library in place of the built-in one; KEY an option.
 */
#include <mxgen/mxgen.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool set_option(mxg_options *options, char *text)
{
    char *equals = strchr(text, '=');
    if (!equals)
        return false;
    *equals = '\0';
    return mxg_options_set(options, text, equals + 1) == MXG_OK;
}

int main(int argc, char **argv)
{
    if (argc < 4) {
        fputs("usage: bench-generate FILE TARGET N [library=PATH] [KEY=VALUE...]\n", stderr);
        return 2;
    }
    mxg_context *context;
    mxg_document *document;
    mxg_options *options;
    mxg_context_create(NULL, &context);
    int first = 4;
    mxg_library *library = NULL;
    if (argc > first && strncmp(argv[first], "library=", strlen("library=")) == 0) {
        const char *path = argv[first++] + strlen("library=");
        mxg_library_load(context, NULL, &path, 1, &library);
    } else {
        library = mxg_library_builtin(context);
    }
    bool good = library && mxg_document_load(context, library, argv[1], &document) == MXG_OK
                && mxg_options_create(context, &options) == MXG_OK;
    for (int i = first; good && i < argc; ++i)
        good = set_option(options, argv[i]);
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = argv[2];
    desc.options = options;
    for (long i = strtol(argv[3], NULL, 10); good && i > 0; --i) {
        mxg_result *result;
        good = mxg_generate(context, document, &desc, &result) == MXG_OK;
        mxg_result_destroy(result);
    }
    mxg_options_destroy(options);
    mxg_document_destroy(document);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    return good ? 0 : 1;
}
