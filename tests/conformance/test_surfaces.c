// SPDX-License-Identifier: Apache-2.0
/*
 * Materials drawn and compared with what MaterialX's own GLSL draws of them (README.md,
 * "Surfaces").
 *
 *     test_surfaces TARGET [KEY=VALUE...] DEVIATIONS FOLDER [DOCUMENTS [NAME...]]
 *
 * TARGET is "vulkan" or "hlsl". KEY=VALUE is an option of generation, to see what a variant of the
 * shaders would be. Images are those of FOLDER/expected/surfaces/index.tsv (of materials NAME…
 * only), documents are relative to FOLDER. MaterialX's own ("example") are relative to DOCUMENTS,
 * and left out where there is no such folder. Reference images may hold the middle pixels of larger
 * cells only; the shader is drawn whole in any case.
 */
#define _POSIX_C_SOURCE 200809L
#include "deviations.h"
#include "lines.h"
#include "render/render.h"
#include "compile/compile.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { EXIT_SKIPPED = 77, SIZE = 96, ENVIRONMENT_SAMPLES = 64 };

static const double max_mean_error = 0.02, max_rms_error = 0.03, trimmed = 0.01;
static const double dark = 1e-3; /* an image with a mean below is judged as if it had this one */

/* The lights of the sphere. */
enum image_kind { IMAGE_FULL, IMAGE_DIRECT, IMAGE_FURNACE, NUM_IMAGE_KINDS };
static const char *const image_names[NUM_IMAGE_KINDS] = {"full", "direct", "furnace"};

struct reference {
    uint32_t size, channels; /* of the square image */
    float *values;           /* rows from the bottom */
};

struct errors {
    double mean, rms; /* relative */
};

struct run {
    const char *target, *folder, *documents; /* documents "": none */
    char **names;
    size_t num_names;
    mxg_context *context;
    mxg_options *options;
    mxg_library *library;
    struct gpu gpu;
    struct scene scenes[NUM_IMAGE_KINDS];
    /* of materials and images; mean and rms in percent that are allowed instead */
    struct deviations deviations;
    struct errors worst; /* of all that agree */
    size_t agree, deviate, failed;
};

/* ---- Reference ---- */

/* Portable float map, little endian: "PF\n96 96\n-1.0\n" for three channels, "Pf" for one. */
static bool read_reference(const char *folder, const char *name, struct reference *out)
{
    char *path = lines_path(folder, "expected/surfaces", name, ""), kind = 0;
    FILE *file = lines_open(path);
    unsigned width = 0, height = 0;
    float scale = 0.0f;
    bool good = file && fscanf(file, "P%c %u %u %f", &kind, &width, &height, &scale) == 4
                && fgetc(file) == '\n' && scale < 0.0f && width == height && width
                && SIZE % width == 0;
    *out = (struct reference){.size = width, .channels = kind == 'F' ? 3 : 1};
    size_t count = (size_t)width * height * out->channels;
    out->values = good ? malloc(count * sizeof(float)) : NULL;
    good = out->values && fread(out->values, sizeof(float), count, file) == count;
    if (file)
        fclose(file);
    if (!good)
        printf("%s: no reference image\n", path);
    free(path);
    return good;
}

/* Pixel x, y of the reference, where a smaller one holds the middle of each cell. */
static const float *pixel_of(float (*pixels)[4], const struct reference *reference, uint32_t x,
                             uint32_t y)
{
    uint32_t step = SIZE / reference->size;
    uint32_t row = SIZE - 1 - (y * step + step / 2); /* ours begin on top */
    return pixels[(size_t)row * SIZE + x * step + step / 2];
}

/* ---- Judgement ---- */

static int compare_numbers(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/*
 * Errors of the mean, and of the root mean square without the worst pixels, relative to the mean.
 */
static struct errors measure(const struct reference *reference, float (*pixels)[4])
{
    static double squares[SIZE * SIZE];
    double sum = 0.0, expected_sum = 0.0, square_sum = 0.0;
    size_t covered = 0;
    for (uint32_t i = 0; i < reference->size * reference->size; ++i) {
        const float *expected = reference->values + (size_t)i * reference->channels;
        const float *got = pixel_of(pixels, reference, i % reference->size, i / reference->size);
        double square = 0.0, either = 0.0;
        for (uint32_t c = 0; c < reference->channels; ++c) {
            double value = (double)got[reference->channels == 1 ? 3 : c],
                   difference = value - (double)expected[c];
            sum += value;
            expected_sum += (double)expected[c];
            square += difference * difference / reference->channels;
            either += fabs(value) + fabs((double)expected[c]);
        }
        if (either > 0.0)
            squares[covered++] = square;
    }
    qsort(squares, covered, sizeof *squares, compare_numbers);
    size_t kept = (size_t)((1.0 - trimmed) * (double)covered);
    for (size_t i = 0; i < kept; ++i)
        square_sum += squares[i];
    double values = fmax((double)covered, 1.0) * reference->channels,
           mean = fmax(expected_sum / values, dark);
    return (struct errors){fabs(sum / values - expected_sum / values) / mean,
                           sqrt(square_sum / fmax((double)kept, 1.0)) / mean};
}

static void judge(struct run *run, const char *material, const char *image, const char *file,
                  float (*pixels)[4])
{
    struct reference reference;
    struct errors limit = {max_mean_error, max_rms_error}, got = {INFINITY, INFINITY};
    const struct deviation *deviation = deviations_find(&run->deviations, material, image);
    if (read_reference(run->folder, file, &reference))
        got = measure(&reference, pixels);
    free(reference.values);
    bool agrees = got.mean <= limit.mean && got.rms <= limit.rms;
    if (deviation)
        limit = (struct errors){deviation->numbers[0] / 100.0, deviation->numbers[1] / 100.0};
    bool is_allowed = got.mean <= limit.mean && got.rms <= limit.rms;
    if (deviation && agrees)
        printf("%s, %s: agrees, though deviations.tsv has it (", material, image);
    else if (!is_allowed)
        printf("%s, %s: differs (", material, image);
    if (!is_allowed || (deviation && agrees))
        printf("mean %.2f %%, rms %.2f %%)\n", 100.0 * got.mean, 100.0 * got.rms);
    if (agrees && !deviation) {
        ++run->agree;
        run->worst =
            (struct errors){fmax(run->worst.mean, got.mean), fmax(run->worst.rms, got.rms)};
    }
    run->deviate += deviation && is_allowed && !agrees;
    run->failed += !is_allowed || (deviation && agrees);
}

/* ---- Drawing ---- */

static bool draw(struct run *run, const char *path, const char *element, enum image_kind kind,
                 float (*pixels)[4])
{
    mxg_document *document = NULL;
    mxg_result *result = NULL;
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = run->target;
    desc.element = element;
    desc.options = run->options;
    bool good = mxg_document_load(run->context, run->library, path, &document) == MXG_OK
                && mxg_generate(run->context, document, &desc, &result) == MXG_OK;
    if (good) {
        struct bind bind = {
            .result = result, .scene = &run->scenes[kind], .document = path, .is_opaque = true};
        good = render_result(&run->gpu, &bind, SIZE, SIZE, pixels[0]);
        if (!good)
            printf("%s: %s\n", path, bind.reason);
        bind_finish(&bind);
    } else {
        printf("%s: no shader\n", path);
    }
    mxg_result_destroy(result);
    mxg_document_destroy(document);
    return good;
}

static bool is_wanted(const struct run *run, const char *material)
{
    for (size_t i = 0; i < run->num_names; ++i)
        if (strcmp(run->names[i], material) == 0)
            return true;
    return run->num_names == 0;
}

/* case, image, pfm, alpha_pfm, source, element, tier, transparent, … */
static void check_line(struct run *run, char *line)
{
    static float pixels[SIZE * SIZE][4];
    const char *fields[7];
    for (size_t i = 0; i < 7; ++i)
        fields[i] = lines_field(&line, '\t');
    bool is_example = strcmp(fields[6], "example") == 0;
    if (!is_wanted(run, fields[0]) || (is_example && !*run->documents))
        return;
    size_t kind = 0;
    while (kind < NUM_IMAGE_KINDS && strcmp(image_names[kind], fields[1]) != 0)
        ++kind;
    char *path = is_example ? lines_path(run->documents, ".", fields[4], "")
                            : lines_path(run->folder, ".", fields[4], "");
    if (kind == NUM_IMAGE_KINDS || !draw(run, path, fields[5], (enum image_kind)kind, pixels)) {
        ++run->failed;
    } else {
        judge(run, fields[0], fields[1], fields[2], pixels);
        if (strcmp(fields[3], "-") != 0)
            judge(run, fields[0], "alpha", fields[3], pixels);
    }
    free(path);
}

/* ---- Scenes and tables ---- */

static void fill(struct image *image, float value)
{
    float *values = image->pixels;
    for (size_t i = 0; i < (size_t)image->width * image->height; ++i)
        for (size_t c = 0; c < 3; ++c)
            values[4 * i + c] = value;
}

static bool make_scene(struct scene *scene, enum image_kind kind)
{
    if (!scene_init_sphere(scene, 1.0) || !environment_make_test_texture(&scene->texture))
        return false;
    scene->environment_samples = ENVIRONMENT_SAMPLES;
    if (kind == IMAGE_FURNACE)
        scene->num_lights = 0;
    if (kind != IMAGE_FULL) {
        fill(&scene->radiance, kind == IMAGE_FURNACE ? 1.0f : 0.0f);
        fill(&scene->irradiance, kind == IMAGE_FURNACE ? 1.0f : 0.0f);
    }
    return true;
}

/* Deviations: "material, image, mean error in percent, rms error in percent, reason" */
static bool start(struct run *run, const char *deviations, char **settings, size_t num_settings)
{
    compile_begin();
    bool good = mxg_context_create(NULL, &run->context) == MXG_OK
                && (run->library = mxg_library_builtin(run->context)) != NULL
                && mxg_options_create(run->context, &run->options) == MXG_OK
                && deviations_read(&run->deviations, deviations, 2);
    for (size_t i = 0; good && i < num_settings; ++i) {
        char *value = strchr(settings[i], '=');
        *value = '\0';
        good = mxg_options_set(run->options, settings[i], value + 1) == MXG_OK;
    }
    for (int kind = 0; kind < NUM_IMAGE_KINDS; ++kind)
        good = good && make_scene(&run->scenes[kind], (enum image_kind)kind);
    return good;
}

static void stop(struct run *run)
{
    deviations_finish(&run->deviations);
    for (int kind = 0; kind < NUM_IMAGE_KINDS; ++kind)
        scene_finish(&run->scenes[kind]);
    gpu_close(&run->gpu);
    mxg_options_destroy(run->options);
    mxg_library_unref(run->library);
    mxg_context_destroy(run->context);
    compile_end();
}

static void check_all(struct run *run)
{
    char *path = lines_path(run->folder, "expected/surfaces", "index", ".tsv"), *line = NULL;
    size_t room = 0;
    FILE *file = lines_open(path);
    bool good = file && lines_next(file, &line, &room); /* the header */
    run->failed += !good;
    while (good && lines_next(file, &line, &room))
        check_line(run, line);
    if (run->num_names == 0 && *run->documents)
        run->failed += deviations_list_lost(&run->deviations);
    if (file)
        fclose(file);
    free(line);
    free(path);
}

int main(int argc, char **argv)
{
    const char *target = argc > 1 ? *++argv : "";
    char **settings = argv + 1;
    --argc;
    while (argc > 1 && strchr(argv[1], '=')) {
        ++argv;
        --argc;
    }
    if (argc < 3) {
        fprintf(stderr, "usage: test_surfaces TARGET [KEY=VALUE...] DEVIATIONS FOLDER"
                        " [DOCUMENTS [NAME...]]\n");
        return 2;
    }
    struct run run = {.target = target, .folder = argv[2], .documents = argc > 3 ? argv[3] : ""};
    int code = 1;
    if (argc > 4) {
        run.names = argv + 4;
        run.num_names = (size_t)argc - 4;
    }
    if (!compile_knows_target(run.target)) {
        printf("skip: there is no compiler of %s\n", run.target);
        code = EXIT_SKIPPED;
    } else if (!gpu_open(&run.gpu)) {
        printf("skip: there is no Vulkan device: %s\n", run.gpu.reason);
        code = EXIT_SKIPPED;
    } else if (start(&run, argv[1], settings, (size_t)(argv + 1 - settings))) {
        check_all(&run);
        printf(
            "%zu images agree (mean within %.2f %%, rms within %.2f %%), %zu deviate as listed\n",
            run.agree, 100.0 * run.worst.mean, 100.0 * run.worst.rms, run.deviate);
        printf("conformance-surfaces: %zu passed, %zu failed\n", run.agree + run.deviate,
               run.failed);
        code = run.failed ? 1 : 0;
    }
    stop(&run);
    return code;
}
