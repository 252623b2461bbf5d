// SPDX-License-Identifier: Apache-2.0
/*
 * A file of glTF as `mxgen import` reads it: what it writes is a document without errors, and
 * nothing stays where it fails.
 */
#include "fuzz.h"

#include "cli/commands.h"
#include "program/files.h"
#include "program/scratch.h"

#include <unistd.h>

void fuzz_run(const char *data, size_t size, struct fuzz_heap *heap)
{
    static const struct command command = {"import", "FILE", "", command_import, NULL};
    struct scratch scratch;
    (void)heap; /* programs end where memory is exhausted */
    FUZZ_REQUIRE(scratch_make(&scratch));
    char *input = cli_format("%s/in.gltf", scratch.path),
         *output = cli_format("%s/out.mtlx", scratch.path);
    FUZZ_REQUIRE(!files_write(input, data, size));
    char *arguments[] = {"import", input, "-o", output, "-q", "--sandbox", NULL};
    int code = command_import(&command, 6, arguments);
    FUZZ_REQUIRE(code == EXIT_DONE || code == EXIT_FAULT);
    if (code == EXIT_DONE)
        fuzz_require_document(output);
    else
        FUZZ_REQUIRE(access(output, F_OK) != 0);
    free(input);
    free(output);
    scratch_remove(&scratch);
}
