// SPDX-License-Identifier: Apache-2.0
/*
 * bench-error MAP PREFILTERED TRUTH MATERIALX INTERFACE FILE...: how far pictures of the first
 * material of each document are from the truth, and what they cost, under the light of a map alone.
 * Prints a line for each way to draw it and each number of samples: the material, the way, the
 * samples, the mean over the ball of scalar operations and of texture reads of a pixel
 * (operations.h), and of CIEDE2000 the mean and the value that 99 of 100 pixels stay below, divided
 * by tabs.
 *
 * PREFILTERED: the map as `mxgen render --bake-environment` writes it
 * TRUTH: a folder with the picture NAME.exr of each document, as `mxgen render -m sphere
 * --path-trace` draws it MATERIALX: a folder with its shaders fis/NAME and prefilter/NAME
 * (foreign.h)
 * INTERFACE: that of mxgen's shaders
 */
#define _POSIX_C_SOURCE 200809L
#include "bench/counted.h"
#include "bench/frame_time.h"
#include "bench/foreign.h"
#include "render/studio.h"

#include <mxgen/mxgen.h>
#include <mxgen/slabs.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { OVERSAMPLING = 2 };
static const uint32_t sample_numbers[] = {1, 2, 4, 8, 16, 32, 64};

/* A way to draw a material: options of mxgen, or a folder of MaterialX's shaders. */
static const struct way {
    const char *name, *environment, *quality, *folder;
} ways[] = {
    {.name = "draft", .environment = "importance", .quality = "draft"},
    {.name = "good", .environment = "importance", .quality = "good"},
    {.name = "reference", .environment = "importance", .quality = "reference"},
    {.name = "prefiltered", .environment = "prefiltered"},
    {.name = "MaterialX", .folder = "fis"},
    {.name = "MaterialX, prefiltered", .folder = "prefilter"},
};
enum { NUM_WAYS = sizeof ways / sizeof *ways };

struct bench {
    struct gpu gpu;
    struct scene scenes[2]; /* with the map, and with the prefiltered one */
    struct draw_canvas *canvas;
    mxg_context *context;
    const char *truths, *materialx, *interface;
    struct image truth;     /* of the current material */
    uint32_t width, height; /* of the canvas */
    float *pixels;
};

/* A shader on the device. */
struct drawn {
    mxg_document *document;
    mxg_result *result;
    struct foreign *foreign;
    struct bind bind;
    struct render render;
};

/* ---- Drawing ---- */

static bool is_prefiltered(const struct way *way)
{
    return strncmp(way->folder ? way->folder : way->environment, "prefilter", 9) == 0;
}

static void generate(struct bench *b, const struct way *way, const char *path, struct drawn *out)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    mxg_options *options = NULL;
    if (mxg_options_create(b->context, &options) != MXG_OK
        || mxg_options_set(options, "environment", way->environment) != MXG_OK
        || (way->quality && mxg_options_set(options, "quality", way->quality) != MXG_OK)
        || mxg_options_set(options, "interface", b->interface) != MXG_OK
        || mxg_options_set(options, "lights", "none") != MXG_OK)
        bench_fail("no such options");
    desc.target = "vulkan";
    desc.options = options;
    if (mxg_document_load(b->context, mxg_library_builtin(b->context), path, &out->document)
            != MXG_OK
        || mxg_generate(b->context, out->document, &desc, &out->result) != MXG_OK)
        bench_fail("%s does not generate", path);
    mxg_options_destroy(options);
}

/* False: MaterialX has no shader for it. */
static bool open_drawn(struct bench *b, const struct way *way, const char *path, const char *name,
                       struct drawn *out)
{
    char stem[4096];
    *out = (struct drawn){0};
    snprintf(stem, sizeof stem, "%s/%s/%s", b->materialx, way->folder ? way->folder : "", name);
    if (way->folder && !(out->foreign = foreign_open(stem)))
        return false;
    if (!way->folder)
        generate(b, way, path, out);
    out->bind = (struct bind){.result = out->result,
                              .program = out->foreign ? &out->foreign->program : NULL,
                              .scene = &b->scenes[is_prefiltered(way)],
                              .document = path,
                              .is_opaque = true};
    if (!render_open(&out->render, b->canvas, &b->gpu, &out->bind))
        bench_fail("%s, %s: %s", name, way->name, out->bind.reason);
    return true;
}

static void close_drawn(struct drawn *drawn)
{
    render_close(&drawn->render);
    bind_finish(&drawn->bind);
    foreign_close(drawn->foreign);
    mxg_result_destroy(drawn->result);
    mxg_document_destroy(drawn->document);
}

static void draw(struct bench *b, struct drawn *drawn, uint32_t samples)
{
    for (int i = 0; i < 2; ++i)
        b->scenes[i].environment_samples = samples;
    if (!render_frame(&drawn->render, 1, b->canvas, b->pixels))
        bench_fail("a frame fails: %s", drawn->bind.reason);
}

/* ---- Measuring ---- */

/* The mean of the pixels of the canvas in a pixel of the picture. */
static void pixel_of(const struct bench *b, uint32_t x, uint32_t y, float out[4])
{
    memset(out, 0, 4 * sizeof *out);
    for (uint32_t i = 0; i < OVERSAMPLING * OVERSAMPLING; ++i) {
        size_t row = (size_t)y * OVERSAMPLING + i / OVERSAMPLING,
               column = (size_t)x * OVERSAMPLING + i % OVERSAMPLING;
        for (int c = 0; c < 4; ++c)
            out[c] += b->pixels[(row * b->width + column) * 4 + (size_t)c]
                      / (OVERSAMPLING * OVERSAMPLING);
    }
}

struct error {
    double mean, most;
};

static struct error error_of(struct bench *b)
{
    uint32_t width = b->truth.width, height = b->truth.height;
    double *errors = malloc((size_t)width * height * sizeof *errors), sum = 0;
    size_t count = 0;
    if (!errors)
        bench_fail("out of memory");
    for (uint32_t i = 0; i < width * height; ++i) {
        const float *truth = (const float *)b->truth.pixels + (size_t)i * 4;
        float pixel[4];
        pixel_of(b, i % width, i / width, pixel);
        if (truth[3] < 0.999f || pixel[3] < 0.999f) /* not inside of the ball */
            continue;
        errors[count] = mxg_color_difference(truth, pixel);
        sum += errors[count++];
    }
    if (!count)
        bench_fail("the pictures have no pixel in common");
    (void)bench_quartiles(errors, count);
    struct error error = {sum / (double)count, errors[count - 1 - count / 100]};
    free(errors);
    return error;
}

/* The count of the shader, mean over the pixels of the ball. */
static double mean_count(const struct bench *b)
{
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < (size_t)b->width * b->height; ++i) {
        sum += (double)b->pixels[i * 4];
        count += b->pixels[i * 4 + 3] > 0;
    }
    return count ? sum / (double)count : 0;
}

static void measure(struct bench *b, const struct way *way, const char *path, const char *name)
{
    enum { NUM = sizeof sample_numbers / sizeof *sample_numbers };
    struct error errors[NUM];
    double counts[2][NUM];
    struct drawn drawn;
    int num = is_prefiltered(way) ? 1 : NUM;
    if (!open_drawn(b, way, path, name, &drawn))
        return;
    for (int i = 0; i < num; ++i) {
        draw(b, &drawn, sample_numbers[i]);
        errors[i] = error_of(b);
    }
    for (int what = 0; what < 2; ++what) {
        counted_instead(&drawn.render, b->canvas, what ? COUNT_READS : COUNT_OPERATIONS);
        for (int i = 0; i < num; ++i) {
            draw(b, &drawn, sample_numbers[i]);
            counts[what][i] = mean_count(b);
        }
    }
    for (int i = 0; i < num; ++i)
        printf("%s\t%s\t%u\t%.0f\t%.2f\t%.4f\t%.4f\n", name, way->name, sample_numbers[i],
               counts[0][i], counts[1][i], errors[i].mean, errors[i].most);
    fflush(stdout);
    close_drawn(&drawn);
}

static void measure_material(struct bench *b, const char *path)
{
    char name[256], file[4096], reason[256];
    const char *base = strrchr(path, '/');
    snprintf(name, sizeof name, "%s", base ? base + 1 : path);
    name[strcspn(name, ".")] = '\0';
    snprintf(file, sizeof file, "%s/%s.exr", b->truths, name);
    if (!image_read(file, "", &b->truth, reason, sizeof reason))
        bench_fail("%s: %s", file, reason);
    b->width = b->truth.width * OVERSAMPLING;
    b->height = b->truth.height * OVERSAMPLING;
    b->canvas = draw_open_canvas(&b->gpu, b->width, b->height);
    b->pixels = malloc((size_t)b->width * b->height * 4 * sizeof *b->pixels);
    if (!b->canvas || !b->pixels || !b->truth.is_float)
        bench_fail("%s: no canvas, or not a picture of floats", file);
    for (int i = 0; i < NUM_WAYS; ++i)
        measure(b, &ways[i], path, name);
    free(b->pixels);
    draw_close_canvas(b->canvas);
    image_finish(&b->truth);
}

int main(int argc, char **argv)
{
    struct bench b = {0};
    if (argc < 7)
        bench_fail("bench-error MAP PREFILTERED TRUTH MATERIALX INTERFACE FILE...");
    setenv("GALLIVM_PERF", "nopt", 0); /* nobody waits for these pixels */
    b.truths = argv[3];
    b.materialx = argv[4];
    b.interface = argv[5];
    if (!gpu_open(&b.gpu)) {
        printf("skip: %s\n", b.gpu.reason);
        return 0;
    }
    compile_begin();
    for (int i = 0; i < 2; ++i) {
        struct studio studio = STUDIO_DEFAULTS;
        struct studio_fault fault;
        struct mesh_parts made;
        studio.mesh = "sphere";
        studio.environment = argv[1 + i];
        studio.prefiltered = i == 1;
        if (!studio_open(&studio, 1, &b.scenes[i], &made, &fault))
            bench_fail("%s", fault.text);
    }
    if (mxg_context_create(NULL, &b.context) != MXG_OK)
        bench_fail("no context");
    for (int i = 6; i < argc; ++i)
        measure_material(&b, argv[i]);
    mxg_context_destroy(b.context);
    for (int i = 0; i < 2; ++i)
        scene_finish(&b.scenes[i]);
    gpu_close(&b.gpu);
    compile_end();
    return 0;
}
