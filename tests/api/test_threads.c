// SPDX-License-Identifier: Apache-2.0
/*
 * Threads over one library, each with a context of its own, and documents that they share or load
 * for themselves give the bytes of a single one, for every target. Arguments: how many generations
 * each thread makes, and the documents.
 */
#define _POSIX_C_SOURCE 200809L
#include "tests/api/fixture.h"

#include <pthread.h>

enum { NUM_THREADS = 8, MAX_DOCUMENTS = 32, MAX_TARGETS = 16 };

struct shared {
    unsigned num_generations;
    mxg_library *library;
    const char *paths[MAX_DOCUMENTS];
    mxg_document *documents[MAX_DOCUMENTS];
    mxg_result *results[MAX_DOCUMENTS]; /* whose reflection is asked for by threads first */
    char *expected[MAX_DOCUMENTS][MAX_TARGETS];
    unsigned num_documents, num_targets;
    unsigned num_refused; /* pairs of a document and a target that lacks what it needs */
};

struct worker {
    const struct shared *shared;
    pthread_t thread;
    unsigned number, num_wrong;
};

static const char *target_name(uint32_t index)
{
    mxg_target target = {sizeof target};
    mxg_catalogue_target(index, &target);
    return target.name;
}

/* The result of a generation as one text; to be freed. */
static char *all_of(const mxg_result *result)
{
    const char *parts[] = {mxg_result_source(result, MXG_STAGE_VERTEX, NULL),
                           mxg_result_source(result, MXG_STAGE_PIXEL, NULL),
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

static mxg_result *generate(mxg_context *context, const mxg_document *document, const char *target)
{
    mxg_generate_desc desc = {sizeof desc, target, NULL, NULL};
    mxg_renderable first = {sizeof first};
    mxg_result *result = NULL;
    if (mxg_document_renderable(document, 0, &first) == MXG_OK)
        desc.element = first.path;
    mxg_generate(context, document, &desc, &result);
    return result;
}

static mxg_document *load(mxg_context *context, mxg_library *library, const char *path)
{
    mxg_document *document = NULL;
    return mxg_document_load(context, library, path, &document) == MXG_OK ? document : NULL;
}

static bool gives(mxg_context *context, const mxg_document *document, const char *target,
                  const char *expected)
{
    mxg_result *result = generate(context, document, target);
    char *text = all_of(result);
    bool good = strcmp(text, expected) == 0;
    free(text);
    mxg_result_destroy(result);
    return good;
}

/*
 * Documents come in another order for each thread; every other one is loaded anew, over the shared
 * library or the thread's own.
 */
static void *work(void *arg)
{
    struct worker *worker = arg;
    const struct shared *shared = worker->shared;
    mxg_context *context = NULL;
    mxg_context_create(NULL, &context);
    mxg_library *library = mxg_library_ref(shared->library),
                *own_library = mxg_library_builtin(context);
    for (unsigned i = 0; i < shared->num_generations; i++) {
        unsigned at = (i + worker->number) % shared->num_documents,
                 target = (i / shared->num_documents) % shared->num_targets;
        mxg_document *own =
            i % 2 ? load(context, i % 4 == 1 ? library : own_library, shared->paths[at]) : NULL;
        worker->num_wrong += i % 2 && !own;
        worker->num_wrong += !gives(context, own ? own : shared->documents[at], target_name(target),
                                    shared->expected[at][target]);
        mxg_document_destroy(own);
        char *text = i < shared->num_documents ? all_of(shared->results[at]) : NULL;
        worker->num_wrong += text && strcmp(text, shared->expected[at][0]) != 0;
        free(text);
    }
    mxg_library_unref(own_library);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    return NULL;
}

/* By one thread: what all must give. */
static void prepare(struct shared *shared, mxg_context *context, const char *path)
{
    unsigned at = shared->num_documents++;
    shared->paths[at] = path;
    shared->documents[at] = load(context, shared->library, path);
    REQUIRE(shared->documents[at]);
    for (unsigned target = 0; target < shared->num_targets; target++) {
        mxg_result *result = generate(context, shared->documents[at], target_name(target));
        shared->expected[at][target] = all_of(result);
        shared->num_refused += !*shared->expected[at][target];
        mxg_result_destroy(result);
    }
    shared->results[at] = generate(context, shared->documents[at], target_name(0));
}

static void finish(struct shared *shared)
{
    for (unsigned at = 0; at < shared->num_documents; at++) {
        for (unsigned target = 0; target < shared->num_targets; target++)
            free(shared->expected[at][target]);
        mxg_result_destroy(shared->results[at]);
        mxg_document_destroy(shared->documents[at]);
    }
    mxg_library_unref(shared->library);
}

int main(int argc, char **argv)
{
    mxg_context *context = NULL;
    mxg_context_create(NULL, &context);
    struct shared shared = {.num_generations = argc > 1 ? (unsigned)strtoul(argv[1], NULL, 10) : 0,
                            .library = mxg_library_builtin(context),
                            .num_targets = mxg_catalogue_num_targets()};
    REQUIRE(shared.num_targets <= MAX_TARGETS);
    for (int i = 2; i < argc && shared.num_documents < MAX_DOCUMENTS; i++)
        prepare(&shared, context, argv[i]);
    REQUIRE(shared.num_generations && shared.num_documents);
    REQUIRE(shared.num_refused <= 2); /* the direction of the view, by MDL */
    struct worker workers[NUM_THREADS] = {{0}};
    for (unsigned i = 0; i < NUM_THREADS && shared.num_documents; i++) {
        workers[i].shared = &shared;
        workers[i].number = i;
        REQUIRE(pthread_create(&workers[i].thread, NULL, work, &workers[i]) == 0);
    }
    for (int i = 0; i < NUM_THREADS && shared.num_documents; i++) {
        pthread_join(workers[i].thread, NULL);
        REQUIRE_EQ(workers[i].num_wrong, 0);
    }
    finish(&shared);
    mxg_context_destroy(context);
    return test_report("api-threads");
}
