// SPDX-License-Identifier: Apache-2.0
/*
 * Rows drawn by a command that is not Vulkan (draws.h): the grid scene is bound to the shader of a
 * target, and the pixels that come back are compared. Rows that the command skips are listed.
 *
 *     test_values TARGET FOLDER INTERFACE PART PARTS COMMAND      the documents of one part of
 * several, counted from 1
 */
#define _POSIX_C_SOURCE 200809L
#include "draws.h"
#include "rows.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { EXIT_SKIPPED = 77, WIDTH = 4, HEIGHT = 4, MIN_DRAWN_PERCENT = 75 };

/* The rows of a document, and for each row why it is not drawn; NULL: it is. */
struct drawn {
    struct row_list list;
    char **problems;
};

struct run {
    struct suite suite;
    const char *target;
    mxg_context *context;
    mxg_library *library;
    mxg_options *options;
    struct scene scene;
    struct draws draws;
    struct drawn *documents;
    size_t num_documents;
    size_t num_loose; /* rows whose tolerance is the accuracy of the device */
};

/* ---- Draws ---- */

static char *first_error(const mxg_diagnostics *list)
{
    char text[1024] = "no shader";
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(list); ++i) {
        mxg_diagnostic d = {sizeof d};
        mxg_diagnostics_item(list, i, &d);
        if (d.severity == MXG_SEVERITY_ERROR) {
            mxg_diagnostics_format(list, i, NULL, 0, false, text, sizeof text);
            break;
        }
    }
    return strdup(text);
}

/* Why the row is not drawn; NULL: it is. */
static char *add_row(struct run *run, const mxg_document *document, const char *path,
                     const struct row *row)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = run->target;
    desc.element = row->name;
    desc.options = run->options;
    mxg_result *result = NULL;
    char *problem = NULL;
    if (mxg_generate(run->context, document, &desc, &result) == MXG_OK) {
        struct bind bind = {.result = result, .scene = &run->scene, .document = path};
        if (!bind_shader(&bind))
            problem = strdup(bind.reason);
        else if (!draws_add(&run->draws, &bind, path, WIDTH, HEIGHT))
            problem = strdup("the draw cannot be written");
        bind_finish(&bind);
    } else {
        problem = first_error(mxg_result_diagnostics(result));
    }
    mxg_result_destroy(result);
    return problem;
}

static void add_document(struct run *run, size_t index)
{
    struct drawn *drawn = &run->documents[run->num_documents++];
    char *path = suite_case_file(&run->suite, index);
    mxg_document *document = NULL;
    bool good = path && mxg_document_load(run->context, run->library, path, &document) == MXG_OK;
    if (!suite_read(&run->suite, index, &drawn->list))
        ++run->suite.failed;
    drawn->problems = calloc(drawn->list.len + 1, sizeof *drawn->problems);
    for (size_t i = 0; drawn->problems && i < drawn->list.len; ++i)
        drawn->problems[i] = good ? add_row(run, document, path, &drawn->list.items[i])
                                  : strdup("the document cannot be read");
    mxg_document_destroy(document);
    free(path);
}

/* ---- Values ---- */

/* From RGBA with the first row on top to the components of a row. */
static void arrange(float (*pixels)[4], unsigned components, float *out)
{
    for (size_t y = HEIGHT; y-- > 0;)
        for (size_t x = 0; x < WIDTH; ++x)
            for (unsigned c = 0; c < components; ++c)
                *out++ = pixels[y * WIDTH + x][c];
}

/* The row as strict as the device is accurate; `out` shares its parts. */
static void loosen(const struct row *row, double accuracy, struct row *out)
{
    double largest = 1.0;
    *out = *row;
    for (size_t i = 0; i < ROW_PIXELS * row->components; ++i)
        largest = fmax(largest, fabs(row->values[i]));
    if (isfinite(largest))
        out->tolerance = fmax(row->tolerance, accuracy * largest);
}

/* False if the command cannot draw. */
static bool judge_row(struct run *run, const struct row_list *list, const struct row *row,
                      const char *problem)
{
    float pixels[WIDTH * HEIGHT][4], values[ROW_PIXELS * ROW_MAX_COMPONENTS];
    const char *reason = problem;
    enum draws_answer answer =
        problem ? DRAWS_FAILED
                : draws_next(&run->draws, pixels[0], (size_t)WIDTH * HEIGHT, &reason);
    if (answer == DRAWS_ABSENT) {
        printf("skip: %s\n", reason);
        return false;
    }
    if (answer == DRAWS_SKIPPED) {
        printf("not computed: %s: %s: %s\n", list->document, row->name, reason);
        suite_skip(&run->suite, list, row);
        return true;
    }
    if (answer == DRAWS_DRAWN)
        arrange(pixels, row->components, values);
    struct row judged;
    loosen(row, answer == DRAWS_DRAWN ? run->draws.accuracy : 0.0, &judged);
    run->num_loose += judged.tolerance > row->tolerance;
    suite_judge(&run->suite, list, &judged, answer == DRAWS_DRAWN ? values : NULL, reason);
    return true;
}

/* The exit code of main. */
static int judge_all(struct run *run, const char *name, bool is_whole)
{
    bool can_draw = true;
    for (size_t i = 0; i < run->num_documents; ++i) {
        const struct drawn *drawn = &run->documents[i];
        for (size_t k = 0; can_draw && drawn->problems && k < drawn->list.len; ++k)
            can_draw = judge_row(run, &drawn->list, &drawn->list.items[k], drawn->problems[k]);
    }
    if (!can_draw)
        return EXIT_SKIPPED;
    size_t drawn = run->suite.agree + run->suite.deviate + run->suite.undefined;
    if (drawn * 100 < MIN_DRAWN_PERCENT * (drawn + run->suite.skipped)) {
        puts("too few rows are drawn");
        ++run->suite.failed;
    }
    printf("%zu rows may be as wrong as the device\n", run->num_loose);
    return suite_report(&run->suite, name, is_whole);
}

/* ---- The program ---- */

static bool start(struct run *run, const char *folder, const char *interface)
{
    bool good = mxg_context_create(NULL, &run->context) == MXG_OK
                && (run->library = mxg_library_builtin(run->context)) != NULL
                && mxg_options_create(run->context, &run->options) == MXG_OK
                && mxg_options_set(run->options, "interface", interface) == MXG_OK
                && scene_init_grid(&run->scene) && suite_open(&run->suite, folder, NULL)
                && draws_open(&run->draws);
    run->documents = calloc(run->suite.num_documents + 1, sizeof *run->documents);
    return good && run->documents;
}

static void stop(struct run *run)
{
    for (size_t i = 0; i < run->num_documents; ++i) {
        for (size_t k = 0; run->documents[i].problems && k < run->documents[i].list.len; ++k)
            free(run->documents[i].problems[k]);
        free(run->documents[i].problems);
        row_list_free(&run->documents[i].list);
    }
    free(run->documents);
    draws_close(&run->draws);
    suite_close(&run->suite);
    scene_finish(&run->scene);
    mxg_options_destroy(run->options);
    mxg_library_unref(run->library);
    mxg_context_destroy(run->context);
}

int main(int argc, char **argv)
{
    if (argc != 7) {
        fprintf(stderr, "usage: %s TARGET FOLDER INTERFACE PART PARTS COMMAND\n", argv[0]);
        return 2;
    }
    size_t part = strtoul(argv[4], NULL, 10), parts = strtoul(argv[5], NULL, 10);
    struct run run = {.target = argv[1]};
    int code = 1;
    if (start(&run, argv[2], argv[3])) {
        for (size_t i = part - 1; i < run.suite.num_documents; i += parts)
            add_document(&run, i);
        char name[64];
        snprintf(name, sizeof name, "values-%s-%zu/%zu", run.target, part, parts);
        if (draws_run(&run.draws, argv[6]))
            code = judge_all(&run, name, parts == 1);
    }
    stop(&run);
    return code;
}
