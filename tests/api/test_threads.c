// SPDX-License-Identifier: Apache-2.0
/* Threads over one library and one document, each with a context of its own, give the bytes of a single one. */
#define _POSIX_C_SOURCE 200809L
#include "tests/api/fixture.h"

#include <pthread.h>

enum { NUM_THREADS = 8, NUM_ROUNDS = 20 }; /* rounds: unless said; two generations each */

/* What a generation gives, as one text; to be freed. */
static char *all_of(const mxg_result *result)
{
    const char *parts[] = {mxg_result_source(result, MXG_STAGE_VERTEX, NULL), mxg_result_source(result, MXG_STAGE_PIXEL, NULL),
                           mxg_result_reflection_json(result, NULL)};
    size_t len = 1;
    for (int i = 0; i < 3; i++)
        len += parts[i] ? strlen(parts[i]) : 0;
    char *text = malloc(len);
    text[0] = '\0';
    for (int i = 0; i < 3; i++)
        strcat(text, parts[i] ? parts[i] : "");
    return text;
}

static char *generate(mxg_context *context, const mxg_document *document, const char *target)
{
    mxg_generate_desc desc = {sizeof desc, target, NULL, NULL};
    mxg_result *result = NULL;
    char *text = mxg_generate(context, document, &desc, &result) == MXG_OK ? all_of(result) : NULL;
    mxg_result_destroy(result);
    return text;
}

static mxg_document *load(mxg_context *context, mxg_library *library)
{
    mxg_document *document = NULL;
    return mxg_document_load(context, library, "main.mtlx", &document) == MXG_OK ? document : NULL;
}

static mxg_context *open_context(struct memory_files *files)
{
    *files = (struct memory_files){.files = fixture_files};
    mxg_resolver resolver = memory_resolver(files);
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    desc.resolver = &resolver;
    mxg_context *context = NULL;
    mxg_context_create(&desc, &context);
    return context;
}

static const char *const targets[] = {"glsl", "vulkan", "essl"};

struct shared {
    unsigned num_rounds;
    mxg_library *library;
    mxg_document *document;
    const mxg_result *result; /* whose reflection every thread asks for first */
    char *expected[3];
};

struct worker {
    const struct shared *shared;
    pthread_t thread;
    unsigned num_wrong;
};

static void check(struct worker *worker, mxg_context *context, const mxg_document *document, unsigned round)
{
    char *text = generate(context, document, targets[round % 3]);
    worker->num_wrong += !text || strcmp(text, worker->shared->expected[round % 3]) != 0;
    free(text);
}

static void *work(void *arg)
{
    struct worker *worker = arg;
    const struct shared *shared = worker->shared;
    struct memory_files files;
    mxg_context *context = open_context(&files);
    mxg_library *library = mxg_library_ref(shared->library), *own_library = mxg_library_builtin(context);
    char *text = all_of(shared->result);
    worker->num_wrong += strcmp(text, shared->expected[0]) != 0;
    free(text);
    for (unsigned round = 0; round < shared->num_rounds; round++) {
        check(worker, context, shared->document, round);
        mxg_document *document = load(context, round % 2 ? library : own_library);
        worker->num_wrong += !document;
        check(worker, context, document, round);
        mxg_document_destroy(document);
    }
    mxg_library_unref(own_library);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    worker->num_wrong += files.num_open != 0;
    return NULL;
}

/* Argument: how many rounds: 500 are 1,000 generations by each thread. */
int main(int argc, char **argv)
{
    struct memory_files files;
    mxg_context *context = open_context(&files);
    struct shared shared = {.num_rounds = argc > 1 ? (unsigned)strtoul(argv[1], NULL, 10) : NUM_ROUNDS, .library = mxg_library_builtin(context)};
    shared.document = load(context, shared.library);
    REQUIRE(shared.document);
    for (int i = 0; i < 3; i++)
        REQUIRE(shared.expected[i] = generate(context, shared.document, targets[i]));
    mxg_generate_desc desc = {sizeof desc, targets[0], NULL, NULL};
    mxg_result *result = NULL;
    REQUIRE_EQ(mxg_generate(context, shared.document, &desc, &result), MXG_OK);
    shared.result = result;

    struct worker workers[NUM_THREADS] = {{0}};
    for (int i = 0; i < NUM_THREADS; i++) {
        workers[i].shared = &shared;
        REQUIRE(pthread_create(&workers[i].thread, NULL, work, &workers[i]) == 0);
    }
    for (int i = 0; i < NUM_THREADS; i++) {
        pthread_join(workers[i].thread, NULL);
        REQUIRE_EQ(workers[i].num_wrong, 0);
    }
    for (int i = 0; i < 3; i++)
        free(shared.expected[i]);
    mxg_result_destroy(result);
    mxg_document_destroy(shared.document);
    mxg_library_unref(shared.library);
    mxg_context_destroy(context);
    return test_report("api-threads");
}
