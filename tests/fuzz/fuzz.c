// SPDX-License-Identifier: Apache-2.0
#include "fuzz.h"

#include "base/hash.h"

#include <mxgen/mxgen.h>

void *fuzz_realloc(void *user_data, void *block, size_t old_size, size_t new_size)
{
    struct fuzz_heap *heap = user_data;
    if (new_size && ++heap->calls == heap->fail_at)
        return NULL;
    heap->held += new_size - old_size;
    if (new_size)
        return realloc(block, new_size);
    free(block);
    return NULL;
}

struct attempt {
    struct fuzz_job job;
    void (*work)(struct fuzz_job *job);
};

static void run_attempt(void *arg)
{
    struct attempt *attempt = arg;
    attempt->work(&attempt->job);
}

void fuzz_run_job(const char *data, size_t size, struct fuzz_heap *heap, size_t limit,
                  void (*work)(struct fuzz_job *job))
{
    struct mem mem;
    struct attempt attempt = {{data, size, {0}}, work};
    mem_init(&mem, fuzz_realloc, heap);
    mem.limit = limit ? limit : mem.limit;
    arena_init(&attempt.job.arena, &mem);
    mem_try(&mem, run_attempt, &attempt);
    arena_finish(&attempt.job.arena);
}

unsigned fuzz_choice(const char *data, size_t size, unsigned below)
{
    return (unsigned)(hash_stable(HASH_STABLE_SEED, data, size) >> 16) % below;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct fuzz_heap heap = {0};
    fuzz_run((const char *)data, size, &heap);
    FUZZ_REQUIRE(heap.held == 0);
    if (heap.calls == 0)
        return 0;
    struct fuzz_heap failing = {.fail_at = 1 + fuzz_choice((const char *)data, size, heap.calls)};
    fuzz_run((const char *)data, size, &failing);
    FUZZ_REQUIRE(failing.held == 0);
    return 0;
}

void fuzz_require_document(const char *path)
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
