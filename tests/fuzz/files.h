// SPDX-License-Identifier: Apache-2.0
/*
 * An input that is several files: parts that begin with a line "== NAME". What stands before the
 * first such line is "main.mtlx"; names that no part has are not found.
 */
#ifndef MXG_TESTS_FUZZ_FILES_H
#define MXG_TESTS_FUZZ_FILES_H

#include "fuzz.h"

#include <mxgen/mxgen.h>

#include <stdbool.h>

enum { FUZZ_MAX_FILES = 8 };

struct fuzz_files {
    struct {
        char name[32];
        const char *data;
        size_t size;
    } items[FUZZ_MAX_FILES];
    unsigned num, num_open;
};

void fuzz_files_split(struct fuzz_files *files, const char *data, size_t size);

/*
 * A context that reads these files with memory of the heap, and the rest as `desc` says. NULL: it
 * cannot be made.
 */
mxg_context *fuzz_files_context(struct fuzz_files *files, struct fuzz_heap *heap,
                                mxg_context_desc desc);

/* A document of an input, which may have errors. */
struct fuzz_document {
    mxg_context *context;
    mxg_library *library;
    const mxg_document *document;
    const struct fuzz_files *files;
};

/* Loads "main.mtlx" of an input within limits, works on it, and frees it. */
void fuzz_files_open(const char *data, size_t size, struct fuzz_heap *heap, bool trust,
                     void (*work)(const struct fuzz_document *opened, unsigned choice));

/* Any other status is a fault of the program, whatever the input. */
bool fuzz_is_expected(mxg_status status);

#endif
