// SPDX-License-Identifier: Apache-2.0
/*
 * The parts that fuzz targets share. A target is one function; every input is run through it twice:
 * with memory as it comes, and with the one allocation failing that the input's bytes choose.
 * Either way nothing may stay behind.
 */
#ifndef MXG_TESTS_FUZZ_H
#define MXG_TESTS_FUZZ_H

#include "base/mem.h"

#include <stdio.h>
#include <stdlib.h>

struct fuzz_heap {
    size_t held;
    unsigned calls, fail_at; /* fail_at 0: none fails */
};

void *fuzz_realloc(void *heap, void *block, size_t old_size, size_t new_size);

/* The target. The bytes are not followed by a NUL. */
void fuzz_run(const char *data, size_t size, struct fuzz_heap *heap);

/* An input for internal functions; everything they make must be in its arena. */
struct fuzz_job {
    const char *data;
    size_t size;
    struct arena arena;
};

/*
 * Runs work on a job for the input, up to where memory runs out: at `limit` bytes (0: none), or
 * because it is to fail.
 */
void fuzz_run_job(const char *data, size_t size, struct fuzz_heap *heap, size_t limit,
                  void (*work)(struct fuzz_job *job));

/* The file holds a document without errors. */
void fuzz_require_document(const char *path);

/* A number made of all bytes of the input: for choices. */
unsigned fuzz_choice(const char *data, size_t size, unsigned below);

/* A claim that holds for every input; a failure ends the program, as the sanitizers do. */
#define FUZZ_REQUIRE(condition) \
    ((condition) ? (void)0 \
                 : (fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition), abort()))

#endif
