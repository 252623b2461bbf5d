// SPDX-License-Identifier: Apache-2.0
/*
 * Threads that edit documents over one library: each has a context of its own, begins from the
 * document that all share, and follows its own line of edits. The code of a node in C is one for
 * all of them. Argument: how many edits each thread makes.
 */
#define _POSIX_C_SOURCE 200809L
#include "tests/api/fixture.h"

#include <pthread.h>

enum { NUM_THREADS = 4 };

static const char text[] =
    "<materialx version='1.39'>"
    "<nodedef name='ND_twice' node='twice'><input name='in' type='float' value='1'/>"
    "<output name='out' type='float'/></nodedef>"
    "<twice name='t' type='float'><input name='in' type='float' value='1'/></twice>"
    "<standard_surface name='S' type='surfaceshader'>"
    "<input name='metalness' type='float' nodename='t'/>"
    "<input name='base' type='float' value='0.5'/></standard_surface>"
    "<surfacematerial name='M' type='material'><input name='surfaceshader' type='surfaceshader' "
    "nodename='S'/></surfacematerial></materialx>";

static bool build_twice(void *user_data, mxg_build *build, mxg_ref *results)
{
    const char *name = user_data; /* all threads read it */
    const mxg_ref in = mxg_build_input(build, "in");
    results[0] = mxg_build_expression(build, "float", "{{x}} + {{x}}", &name, &in, 1);
    return true;
}

static const mxg_node_code twice = {sizeof twice, "twice", NULL, 1, build_twice, (void *)"x", NULL};

static mxg_context *make_context(void)
{
    static const mxg_node_code *const codes[] = {&twice};
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    mxg_context *context = NULL;
    desc.node_codes = codes;
    desc.num_node_codes = 1;
    REQUIRE_EQ(mxg_context_create(&desc, &context), MXG_OK);
    return context;
}

struct worker {
    pthread_t thread;
    mxg_library *library;
    const mxg_document *base;
    unsigned number, num_edits, num_wrong;
};

/* The default of S_base in the shader of a document; -1: there is none. */
static float base_of(mxg_context *context, const mxg_document *document)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    mxg_variable variable = MXG_INIT(mxg_variable);
    mxg_result *result = NULL;
    uint32_t index;
    float found = -1;
    desc.target = "vulkan";
    desc.element = "M";
    if (mxg_generate(context, document, &desc, &result) == MXG_OK
        && (index = mxg_result_find_variable(result, "S/base")) != MXG_NONE
        && mxg_result_variable(result, index, &variable) == MXG_OK)
        found = variable.values[0];
    mxg_result_destroy(result);
    return found;
}

static void *work(void *arg)
{
    struct worker *worker = arg;
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    static const mxg_node_code *const codes[] = {&twice};
    mxg_context *context = NULL;
    desc.node_codes = codes;
    desc.num_node_codes = 1;
    mxg_context_create(&desc, &context);
    mxg_document *last = NULL;
    for (unsigned i = 0; i < worker->num_edits; i++) {
        mxg_edit *edit = NULL;
        mxg_document *next = NULL;
        const mxg_document *from = last ? last : worker->base;
        float value = (float)(worker->number * worker->num_edits + i);
        bool is_good = mxg_edit_create(context, worker->library, from, NULL, &edit) == MXG_OK;
        is_good &=
            mxg_edit_set_numbers(edit, edited_at(edit, "S"), "base", NULL, &value, 1) == MXG_OK;
        is_good &= commit(edit, &next) == MXG_OK;
        is_good &= base_of(context, next) == value;
        worker->num_wrong += !is_good;
        mxg_document_destroy(last);
        last = next;
    }
    worker->num_wrong += base_of(context, worker->base) != 0.5f;
    mxg_document_destroy(last);
    mxg_context_destroy(context);
    return NULL;
}

int main(int argc, char **argv)
{
    mxg_context *context = make_context();
    mxg_library *library = mxg_library_builtin(context);
    mxg_document *base = NULL;
    struct worker workers[NUM_THREADS] = {{0}};
    REQUIRE_EQ(mxg_document_parse(context, library, "base.mtlx", text, strlen(text), &base),
               MXG_OK);
    for (unsigned i = 0; i < NUM_THREADS; i++) {
        workers[i] =
            (struct worker){.library = library,
                            .base = base,
                            .number = i,
                            .num_edits = argc > 1 ? (unsigned)strtoul(argv[1], NULL, 10) : 1};
        REQUIRE(pthread_create(&workers[i].thread, NULL, work, &workers[i]) == 0);
    }
    for (unsigned i = 0; i < NUM_THREADS; i++) {
        pthread_join(workers[i].thread, NULL);
        REQUIRE_EQ(workers[i].num_wrong, 0);
    }
    mxg_document_destroy(base);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    return test_report("api-edit_threads");
}
