// SPDX-License-Identifier: Apache-2.0
/*
 * A file of glTF as `mxgen import` reads it: what it writes is a document without errors, and
 * nothing stays where it fails.
 */
#define _DEFAULT_SOURCE /* mkstemps, mkdtemp */
#include "fuzz.h"

#include "cli/commands.h"

#include <string.h>
#include <unistd.h>

static void require_document(const char *path)
{
    mxg_context *context = NULL;
    mxg_document *document = NULL;
    FUZZ_REQUIRE(mxg_context_create(NULL, &context) == MXG_OK);
    mxg_library *library = mxg_library_builtin(context);
    mxg_document_load(context, library, path, &document);
    FUZZ_REQUIRE(document && mxg_diagnostics_num_errors(mxg_document_diagnostics(document)) == 0);
    mxg_document_destroy(document);
    mxg_library_unref(library);
    mxg_context_destroy(context);
}

void fuzz_run(const char *data, size_t size, struct fuzz_heap *heap)
{
    static const struct command command = {"import", "FILE", "", command_import, NULL};
    char folder[] = P_tmpdir "/mxgen-fuzz-XXXXXX", input[64], output[64];
    (void)heap; /* programs end where memory is exhausted */
    FUZZ_REQUIRE(mkdtemp(folder));
    snprintf(input, sizeof input, "%s/in.gltf", folder);
    snprintf(output, sizeof output, "%s/out.mtlx", folder);
    FILE *file = fopen(input, "wb");
    FUZZ_REQUIRE(file && fwrite(data, 1, size, file) == size && fclose(file) == 0);
    char *arguments[] = {"import", input, "-o", output, "-q", "--sandbox", NULL};
    int code = command_import(&command, 6, arguments);
    FUZZ_REQUIRE(code == EXIT_DONE || code == EXIT_FAULT);
    if (code == EXIT_DONE)
        require_document(output);
    else
        FUZZ_REQUIRE(access(output, F_OK) != 0);
    char remove[96];
    snprintf(remove, sizeof remove, "rm -rf %s", folder);
    FUZZ_REQUIRE(system(remove) == 0);
}
