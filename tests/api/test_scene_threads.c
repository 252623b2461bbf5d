// SPDX-License-Identifier: Apache-2.0
/*
 * Threads that bind one document, each with a context and a scene of its own, get the bindings and
 * the shaders of a single one. Argument: how many times each thread binds.
 */
#define _POSIX_C_SOURCE 200809L
#include "tests/api/fixture.h"

#include <mxgen/scene.h>
#include <pthread.h>

enum { NUM_THREADS = 8 };

static const char text[] =
    "<materialx version='1.39'><standard_surface name='s' type='surfaceshader'/>"
    "<surfacematerial name='A' type='material'><input name='surfaceshader' type='surfaceshader' "
    "nodename='s'/></surfacematerial><nodegraph name='NG'><constant name='c' type='float'/>"
    "<output name='opacity' type='float' nodename='c'/></nodegraph>"
    "<collection name='C' includegeom='//a, /r' excludegeom='/r/b'/><look name='L'>"
    "<materialassign name='a' material='A' geom='/'/>"
    "<materialassign name='b' slot='050' material='A' collection='C'/>"
    "<materialassign name='c' slot='000::x' nodegraph='NG' geom='//*'/></look></materialx>";

static const char *const paths[] = {"/r/a", "/r/b/c", "/r/b/c[3]", "/set/a", "/set/b"};

struct worker {
    const mxg_document *document;
    const char *expected;
    pthread_t thread;
    unsigned num_rounds, num_wrong;
};

/* The bindings as JSON and the shader of each stack, as one text; to be freed. */
static char *bind(mxg_context *context, const mxg_document *document)
{
    char *all = NULL;
    mxg_scene *scene = NULL;
    mxg_bindings *bindings = NULL;
    mxg_scene_create(context, &scene);
    mxg_scene_add_paths(scene, paths, sizeof paths / sizeof *paths);
    mxg_bindings_create(context, document, scene, NULL, &bindings);
    mxg_bindings_write(bindings, MXG_BINDINGS_JSON, append, &all);
    for (uint32_t i = 0; i < mxg_bindings_num_stacks(bindings); i++) {
        mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
        mxg_result *result = NULL;
        size_t len = 0;
        desc.target = "glsl";
        desc.bindings = bindings;
        desc.stack = i;
        mxg_generate(context, document, &desc, &result);
        const char *source = mxg_result_source(result, MXG_STAGE_PIXEL, &len);
        if (source)
            append(&all, source, len);
        mxg_result_destroy(result);
    }
    mxg_bindings_destroy(bindings);
    mxg_scene_destroy(scene);
    return all;
}

static void *work(void *arg)
{
    struct worker *worker = arg;
    mxg_context *context = NULL;
    mxg_context_create(NULL, &context);
    for (unsigned i = 0; i < worker->num_rounds; i++) {
        char *got = bind(context, worker->document);
        worker->num_wrong += strcmp(got, worker->expected) != 0;
        free(got);
    }
    mxg_context_destroy(context);
    return NULL;
}

int main(int argc, char **argv)
{
    unsigned num_rounds = argc > 1 ? (unsigned)strtoul(argv[1], NULL, 10) : 0;
    mxg_context *context = NULL;
    struct worker workers[NUM_THREADS] = {{0}};
    mxg_context_create(NULL, &context);
    mxg_document *document = parse_builtin(context, text);
    char *expected = bind(context, document);
    REQUIRE(num_rounds && strstr(expected, "000::x") && strstr(expected, "void main()"));
    for (unsigned i = 0; i < NUM_THREADS; i++) {
        workers[i] =
            (struct worker){.document = document, .expected = expected, .num_rounds = num_rounds};
        REQUIRE(pthread_create(&workers[i].thread, NULL, work, &workers[i]) == 0);
    }
    for (int i = 0; i < NUM_THREADS; i++) {
        pthread_join(workers[i].thread, NULL);
        REQUIRE_EQ(workers[i].num_wrong, 0);
    }
    free(expected);
    mxg_document_destroy(document);
    mxg_context_destroy(context);
    return test_report("api-scene_threads");
}
