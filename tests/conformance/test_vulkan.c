// SPDX-License-Identifier: Apache-2.0
/*
 * Every row drawn: the generated shader of a target that compiles to SPIR-V for Vulkan runs on the
 * grid scene, on whatever device there is, and its pixels are compared.
 *
 *     test_vulkan TARGET FOLDER INTERFACE [PART PARTS]      the documents of one part of several,
 * counted from 1
 *     test_vulkan TARGET FOLDER INTERFACE TEXTURE-MODES     with a value of this option
 */
#include "render/render.h"
#include "rows.h"
#include "compile/compile.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { EXIT_SKIPPED = 77, WIDTH = 4, HEIGHT = 4 };

struct run {
    struct suite suite;
    const char *target;
    mxg_context *context;
    mxg_library *library;
    mxg_options *options;
    struct gpu gpu;
    struct scene scene;
    char problem[1024]; /* why the last row has no values */
};

static void note_error(struct run *run, const mxg_diagnostics *list)
{
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(list); ++i) {
        mxg_diagnostic d = {sizeof d};
        mxg_diagnostics_item(list, i, &d);
        if (d.severity == MXG_SEVERITY_ERROR) {
            mxg_diagnostics_format(list, i, NULL, 0, false, run->problem, sizeof run->problem);
            return;
        }
    }
}

/* From RGBA with the first row on top to the components of a row. */
static void arrange(float (*pixels)[4], unsigned components, float *out)
{
    for (size_t y = HEIGHT; y-- > 0;)
        for (size_t x = 0; x < WIDTH; ++x)
            for (unsigned c = 0; c < components; ++c)
                *out++ = pixels[y * WIDTH + x][c];
}

/* The values of an element; false with run->problem. */
static bool draw(struct run *run, const mxg_document *document, const char *path,
                 const struct row *row, float *out_values)
{
    float pixels[WIDTH * HEIGHT][4];
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = run->target;
    desc.element = row->name;
    desc.options = run->options;
    mxg_result *result = NULL;
    snprintf(run->problem, sizeof run->problem, "no shader");
    bool good = mxg_generate(run->context, document, &desc, &result) == MXG_OK;
    if (good) {
        struct bind bind = {.result = result, .scene = &run->scene, .document = path};
        good = render_result(&run->gpu, &bind, WIDTH, HEIGHT, pixels[0]);
        snprintf(run->problem, sizeof run->problem, "%s", bind.reason);
        bind_finish(&bind);
    } else {
        note_error(run, mxg_result_diagnostics(result));
    }
    mxg_result_destroy(result);
    if (good)
        arrange(pixels, row->components, out_values);
    return good;
}

static void check_document(struct run *run, size_t index)
{
    struct row_list list;
    char *path = suite_case_file(&run->suite, index);
    mxg_document *document = NULL;
    snprintf(run->problem, sizeof run->problem, "the document cannot be read");
    bool good = path && mxg_document_load(run->context, run->library, path, &document) == MXG_OK;
    if (!suite_read(&run->suite, index, &list))
        ++run->suite.failed;
    for (size_t i = 0; i < list.len; ++i) {
        float values[ROW_PIXELS * ROW_MAX_COMPONENTS];
        bool has_values = good && draw(run, document, path, &list.items[i], values);
        suite_judge(&run->suite, &list, &list.items[i], has_values ? values : NULL, run->problem);
    }
    row_list_free(&list);
    mxg_document_destroy(document);
    free(path);
}

/* A folder takes the place of the built-in library. */
static bool load_library(struct run *run, const char *folder)
{
    if (folder)
        return mxg_library_load(run->context, NULL, &folder, 1, &run->library) == MXG_OK;
    run->library = mxg_library_builtin(run->context);
    return run->library != NULL;
}

/* `where`: the folder and the interface. `modes`: of textures; NULL: as the option has them. */
static bool start(struct run *run, char **where, const char *modes, const char *library,
                  const char *deviations)
{
    compile_begin();
    return mxg_context_create(NULL, &run->context) == MXG_OK && load_library(run, library)
           && mxg_options_create(run->context, &run->options) == MXG_OK
           && mxg_options_set(run->options, "interface", where[1]) == MXG_OK
           && (!modes || mxg_options_set(run->options, "texture-modes", modes) == MXG_OK)
           && scene_init_grid(&run->scene) && suite_open(&run->suite, where[0], deviations);
}

static void stop(struct run *run)
{
    suite_close(&run->suite);
    scene_finish(&run->scene);
    gpu_close(&run->gpu);
    mxg_options_destroy(run->options);
    mxg_library_unref(run->library);
    mxg_context_destroy(run->context);
    compile_end();
}

int main(int argc, char **argv)
{
    if (argc < 4 || argc == 7 || argc > 8) {
        fprintf(stderr,
                "usage: %s TARGET FOLDER INTERFACE [PART PARTS [LIBRARIES DEVIATIONS.tsv] | "
                "TEXTURE-MODES]\n",
                argv[0]);
        return 2;
    }
    size_t part = argc >= 6 ? strtoul(argv[4], NULL, 10) : 1,
           parts = argc >= 6 ? strtoul(argv[5], NULL, 10) : 1;
    const char *library = argc == 8 ? argv[6] : NULL, *modes = argc == 5 ? argv[4] : NULL;
    struct run run = {.suite = {.folder = argv[2]}, .target = argv[1]};
    int code = 1;
    if (!compile_knows_target(run.target)) {
        printf("skip: there is no compiler of %s\n", run.target);
        code = EXIT_SKIPPED;
    } else if (!gpu_open(&run.gpu)) {
        printf("skip: there is no Vulkan device: %s\n", run.gpu.reason);
        code = EXIT_SKIPPED;
    } else if (start(&run, argv + 2, modes, library, argc == 8 ? argv[7] : NULL)) {
        for (size_t i = part - 1; i < run.suite.num_documents; i += parts)
            check_document(&run, i);
        char name[64];
        snprintf(name, sizeof name, "conformance-%s-%s-%zu/%zu", run.target, argv[3], part, parts);
        code = suite_report(&run.suite, name, parts == 1);
    }
    stop(&run);
    return code;
}
