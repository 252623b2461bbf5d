// SPDX-License-Identifier: Apache-2.0
/*
 * Materials drawn by the shaders of a target and by those of "vulkan": the first one of each
 * document of folders and files, opaque, on the sphere scene. The mean difference of their pixels
 * is within 1 % of their mean. A command draws the target's (draws.h), with
 * SwiftShader where it is installed, which then draws those of "vulkan", too, because devices
 * choose the levels of textures differently. Without a command, the target compiles to SPIR-V, and
 * the same device draws both.
 *
 *     test_pictures TARGET COMMAND PATH...      COMMAND "": none
 */
#define _POSIX_C_SOURCE 200112L
#include "draws.h"
#include "program/folder.h"
#include "render/render.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { EXIT_SKIPPED = 77, SIZE = 96, ENVIRONMENT_SAMPLES = 16 };
static const double max_difference = 0.01;

typedef float picture[SIZE * SIZE][4];

struct material {
    const char *document;
    picture *expected; /* malloc; NULL: it is not drawn */
};

struct run {
    const char *target;
    mxg_context *context;
    mxg_library *library;
    struct gpu gpu;
    struct scene scene;
    const char *command; /* NULL: Vulkan draws the target's shaders */
    struct draws draws;
    struct arg_list documents;
    struct material *materials; /* of the documents */
    double worst;
    unsigned passed, failed, skipped;
};

/* ---- Judgement ---- */

/* Relative to the mean. Textured highlights differ most, by 1 % of their light. */
static double difference(picture *expected, picture *got)
{
    double sum = 0.0, of_differences = 0.0;
    for (size_t i = 0; i < (size_t)SIZE * SIZE; ++i)
        for (size_t c = 0; c < 3; ++c) {
            sum += (double)(*expected)[i][c];
            of_differences += fabs((double)(*expected)[i][c] - (double)(*got)[i][c]);
        }
    return of_differences / sum;
}

static void judge(struct run *run, const struct material *material, picture *got,
                  const char *reason)
{
    double d = got ? difference(material->expected, got) : INFINITY;
    run->worst = fmax(run->worst, d);
    bool good = d <= max_difference;
    ++*(good ? &run->passed : &run->failed);
    if (!good)
        printf("%s: %.2f %%%s%s\n", material->document, 100.0 * d, got ? "" : ": ",
               got ? "" : reason);
}

/* ---- Draws ---- */

static bool generate(struct run *run, const mxg_document *document, const char *target,
                     mxg_result **out)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = target;
    return mxg_generate(run->context, document, &desc, out) == MXG_OK;
}

static struct bind bind_of(struct run *run, const struct material *material, mxg_result *result)
{
    return (struct bind){.result = result,
                         .scene = &run->scene,
                         .document = material->document,
                         .is_opaque = true,
                         .checker = true};
}

static bool draw_now(struct run *run, const struct material *material, struct bind *bind)
{
    static picture got;
    bool good = render_result(&run->gpu, bind, SIZE, SIZE, got[0]);
    if (good)
        judge(run, material, &got, NULL);
    return good;
}

/* False if the material has no shader, which is a failure, or files are missing. */
static bool add_material(struct run *run, const mxg_document *document, struct material *material)
{
    mxg_result *result = NULL, *other = NULL;
    material->expected = malloc(sizeof *material->expected);
    bool good = material->expected && generate(run, document, "vulkan", &result)
                && generate(run, document, run->target, &other);
    struct bind bind = bind_of(run, material, result), to_draw = bind_of(run, material, other);
    good =
        good && render_result(&run->gpu, &bind, SIZE, SIZE, (*material->expected)[0])
        && (run->command ? bind_shader(&to_draw)
                               && draws_add(&run->draws, &to_draw, material->document, SIZE, SIZE)
                         : draw_now(run, material, &to_draw));
    if (!good)
        printf("%s: not drawn: %s%s\n", material->document, bind.reason, to_draw.reason);
    bind_finish(&bind);
    bind_finish(&to_draw);
    mxg_result_destroy(result);
    mxg_result_destroy(other);
    return good;
}

static void add_document(struct run *run, struct material *material)
{
    mxg_document *document = NULL;
    if (mxg_document_load(run->context, run->library, material->document, &document) != MXG_OK) {
        printf("skip: %s includes a file that is not here\n", material->document);
        ++run->skipped;
    } else if (!add_material(run, document, material)) {
        ++run->failed;
        free(material->expected);
        material->expected = NULL;
    }
    mxg_document_destroy(document);
}

/* ---- Answers ---- */

/* False if the command cannot draw. */
static bool judge_answer(struct run *run, const struct material *material)
{
    static picture got;
    const char *reason;
    enum draws_answer answer = draws_next(&run->draws, got[0], sizeof got / sizeof *got, &reason);
    if (answer == DRAWS_ABSENT)
        printf("skip: %s\n", reason);
    else
        judge(run, material, answer == DRAWS_DRAWN ? &got : NULL, reason);
    return answer != DRAWS_ABSENT;
}

/* The exit code of main. */
static int judge_all(struct run *run)
{
    for (size_t i = 0; i < run->documents.len; ++i)
        if (run->command && run->materials[i].expected && !judge_answer(run, &run->materials[i]))
            return EXIT_SKIPPED;
    printf("the pixels differ by %.2f %% at most\n", 100.0 * run->worst);
    printf("pictures-%s: %u passed, %u failed, %u skipped\n", run->target, run->passed, run->failed,
           run->skipped);
    return run->failed ? 1 : run->passed ? 0 : EXIT_SKIPPED;
}

/* ---- The program ---- */

static bool start(struct run *run, const struct arg_list *paths)
{
    compile_begin();
    const char *reason = NULL, *problem = folder_documents(paths, &run->documents, &reason);
    run->materials = calloc(run->documents.len + 1, sizeof *run->materials);
    for (size_t i = 0; run->materials && i < run->documents.len; ++i)
        run->materials[i].document = run->documents.items[i];
    if (problem)
        printf("skip: %s: %s\n", problem, reason);
    bool good = !problem && run->materials && mxg_context_create(NULL, &run->context) == MXG_OK
                && (run->library = mxg_library_builtin(run->context)) != NULL
                && scene_init_sphere(&run->scene, 1.0) && draws_open(&run->draws);
    run->scene.environment_samples = ENVIRONMENT_SAMPLES;
    return good && run->documents.len;
}

static void stop(struct run *run)
{
    for (size_t i = 0; i < run->documents.len; ++i) {
        free(run->materials[i].expected);
        free((void *)(uintptr_t)run->documents.items[i]);
    }
    free(run->documents.items);
    free(run->materials);
    draws_close(&run->draws);
    scene_finish(&run->scene);
    gpu_close(&run->gpu);
    mxg_library_unref(run->library);
    mxg_context_destroy(run->context);
    compile_end();
}

static void choose_device(void)
{
    const char *device = getenv("MXGEN_SWIFTSHADER");
    device = device ? device : "/usr/lib/chromium/vk_swiftshader_icd.json";
    if (access(device, R_OK) == 0)
        setenv("VK_ICD_FILENAMES", device, 1);
}

int main(int argc, char **argv)
{
    if (argc < 4) {
        fprintf(stderr, "usage: %s TARGET COMMAND PATH...\n", argv[0]);
        return 2;
    }
    struct arg_list paths = {(const char **)(uintptr_t)(argv + 3), (size_t)(argc - 3)};
    struct run run = {.target = argv[1], .command = *argv[2] ? argv[2] : NULL};
    if (run.command)
        choose_device();
    int code = EXIT_SKIPPED;
    if (!run.command && !compile_knows_target(run.target)) {
        printf("skip: there is no compiler of %s\n", run.target);
    } else if (!gpu_open(&run.gpu)) {
        printf("skip: there is no Vulkan device: %s\n", run.gpu.reason);
    } else if (start(&run, &paths)) {
        for (size_t i = 0; i < run.documents.len; ++i)
            add_document(&run, &run.materials[i]);
        code = !run.command || draws_run(&run.draws, run.command) ? judge_all(&run) : 1;
    }
    stop(&run);
    return code;
}
