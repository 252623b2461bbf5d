// SPDX-License-Identifier: Apache-2.0
/*
 * bench-slots pixels|operations FILE LOOK...: the cost of layers (docs/benchmarks.md, "Slots"). A
 * quad that fills the picture has the stack of each look, whose layers are blended and picked, by
 * one number for the whole draw and by a hash in each pixel. Prints ratios to the first look.
 *
 * pixels: processor time of one thread, without LLVM's passes. All programs are compiled before;
 * each round draws each of them and an empty picture, so a round has one load of the machine. A
 * figure is the median of the rounds' ratios, behind it the quartiles.
 *
 * operations: what the shaders do, counted by themselves (operations.h), means over the pixels.
 */
#define _POSIX_C_SOURCE 200809L
#include "bench/counted.h"
#include "bench/frame_time.h"
#include "render/render.h"

#include <mxgen/mxgen.h>
#include <mxgen/scene.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 192, NUM_ROUNDS = 21, MAX_LOOKS = 8 };
#define NUM_FLOATS ((size_t)SIZE * SIZE * 4)

enum mode { MODE_BLEND, MODE_ONE_NUMBER, MODE_HASH, NUM_MODES };

/* A stack on the device. */
struct drawn {
    mxg_document *document;
    mxg_bindings *bindings;
    struct bind bind;
    struct render render;
};

struct bench {
    struct gpu gpu;
    struct scene scene;
    struct draw_canvas *canvas;
    mxg_context *context;
    mxg_options *options;
    mxg_scene *primitives;
    const char *file;
    const char *const *looks;
    uint32_t num_looks;
    struct drawn blended[MAX_LOOKS], picked[MAX_LOOKS];
    float *pixels;
};

static mxg_result *generate(struct bench *b, const char *look, bool picks, struct drawn *drawn)
{
    mxg_bindings_desc bind = MXG_BINDINGS_DESC_INIT;
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    mxg_result *result = NULL;
    bind.look = look;
    desc.target = "vulkan";
    desc.options = b->options;
    if (mxg_options_set(b->options, "slots", picks ? "stochastic" : "blend") != MXG_OK
        || mxg_document_load(b->context, mxg_library_builtin(b->context), b->file, &drawn->document)
               != MXG_OK
        || mxg_bindings_create(b->context, drawn->document, b->primitives, &bind, &drawn->bindings)
               != MXG_OK)
        bench_fail("%s, look '%s': no bindings", b->file, look);
    desc.bindings = drawn->bindings;
    desc.stack = mxg_bindings_stack(drawn->bindings, 0);
    if (mxg_generate(b->context, drawn->document, &desc, &result) != MXG_OK)
        bench_fail("%s, look '%s': does not generate", b->file, look);
    return result;
}

static void open_drawn(struct bench *b, const char *look, bool picks, struct drawn *drawn)
{
    drawn->bind = (struct bind){.result = generate(b, look, picks, drawn),
                                .scene = &b->scene,
                                .document = b->file,
                                .is_opaque = true};
    if (!render_open(&drawn->render, b->canvas, &b->gpu, &drawn->bind))
        bench_fail("%s, look '%s': %s", b->file, look, drawn->bind.reason);
}

static void close_drawn(struct drawn *drawn)
{
    render_close(&drawn->render);
    mxg_result_destroy((mxg_result *)(uintptr_t)drawn->bind.result);
    bind_finish(&drawn->bind);
    mxg_bindings_destroy(drawn->bindings);
    mxg_document_destroy(drawn->document);
}

/* One frame; `number` picks the layers. drawn is NULL: an empty one. */
static void draw(struct bench *b, struct drawn *drawn, double number)
{
    b->scene.layer_sample = number;
    if (drawn ? !render_frame(&drawn->render, 1, b->canvas, b->pixels)
              : !draw_frame(b->canvas, NULL, 0, b->pixels))
        bench_fail("a frame fails: %s", drawn ? drawn->bind.reason : b->gpu.reason);
    for (size_t i = 3; drawn && i < NUM_FLOATS; i += 4)
        if (!(b->pixels[i] > 0.999f))
            bench_fail("the quad does not fill the picture");
}

/* Draws a look in a mode; each round has another number. */
static void draw_mode(struct bench *b, uint32_t look, enum mode mode, int round)
{
    double number = mode == MODE_ONE_NUMBER ? (round + 0.5) / NUM_ROUNDS : -1;
    draw(b, mode == MODE_BLEND ? &b->blended[look] : &b->picked[look], number);
}

static void print_head(const char *unit)
{
    printf("| look, %s | blend | stochastic, one number for all pixels | stochastic, a hash in "
           "each pixel |\n| --- | --- | --- | --- |\n",
           unit);
}

/* ---- Time ---- */

static double seconds_empty(struct bench *b)
{
    double begin = bench_seconds();
    draw(b, NULL, 0);
    return bench_seconds() - begin;
}

static double seconds_of(struct bench *b, uint32_t look, enum mode mode, int round)
{
    double begin = bench_seconds();
    draw_mode(b, look, mode, round);
    return bench_seconds() - begin;
}

static void measure_pixels(struct bench *b)
{
    static double ratios[MAX_LOOKS][NUM_MODES][NUM_ROUNDS], ones[NUM_ROUNDS];
    for (int round = -1; round < NUM_ROUNDS; ++round) { /* the one before warms up */
        int row = round < 0 ? 0 : round;
        double empty = seconds_empty(b), one = seconds_of(b, 0, MODE_BLEND, row) - empty;
        ones[row] = one;
        for (uint32_t look = 0; look < b->num_looks; ++look)
            for (int mode = 0; mode < NUM_MODES; ++mode)
                ratios[look][mode][row] = (seconds_of(b, look, (enum mode)mode, row) - empty) / one;
    }
    print_head("time");
    for (uint32_t look = 0; look < b->num_looks; ++look) {
        printf("| %s |", b->looks[look]);
        for (int mode = 0; mode < NUM_MODES; ++mode) {
            struct bench_quartiles of = bench_quartiles(ratios[look][mode], NUM_ROUNDS);
            printf(" %.2f (%.2f to %.2f) |", of.median, of.lower, of.upper);
        }
        putchar('\n');
    }
    printf("The first, blended: %.0f nanoseconds for a pixel.\n",
           1e9 * bench_quartiles(ones, NUM_ROUNDS).median / (SIZE * SIZE));
}

/* ---- Operations ---- */

/* The mean over the pixels; with one number for all of them, over the rounds, too. */
static double mean_count(struct bench *b, uint32_t look, enum mode mode)
{
    int rounds = mode == MODE_ONE_NUMBER ? NUM_ROUNDS : 1;
    double sum = 0;
    for (int round = 0; round < rounds; ++round) {
        draw_mode(b, look, mode, round);
        for (size_t i = 0; i < NUM_FLOATS; i += 4)
            sum += (double)b->pixels[i];
    }
    return sum / rounds / (SIZE * SIZE);
}

static void measure_operations(struct bench *b, enum count_of what, const char *unit)
{
    for (uint32_t look = 0; look < b->num_looks; ++look) {
        counted_instead(&b->blended[look].render, b->canvas, what);
        counted_instead(&b->picked[look].render, b->canvas, what);
    }
    double one = mean_count(b, 0, MODE_BLEND);
    print_head(unit);
    for (uint32_t look = 0; look < b->num_looks; ++look) {
        printf("| %s |", b->looks[look]);
        for (int mode = 0; mode < NUM_MODES; ++mode)
            printf(" %.2f |", mean_count(b, look, (enum mode)mode) / one);
        putchar('\n');
    }
    printf("The first, blended: %.0f for a pixel.\n\n", one);
}

/* ---- Program ---- */

static void open_scene(struct bench *b)
{
    const char *const path = "/quad";
    if (!scene_init_grid(&b->scene) || mxg_context_create(NULL, &b->context) != MXG_OK
        || mxg_options_create(b->context, &b->options) != MXG_OK
        || mxg_options_set(b->options, "interface", "complete") != MXG_OK
        || mxg_scene_create(b->context, &b->primitives) != MXG_OK
        || mxg_scene_add_paths(b->primitives, &path, 1) != MXG_OK)
        bench_fail("no scene");
    image_finish(&b->scene.texture); /* the documents have their own */
    b->scene.num_lights = SCENE_NUM_LIGHTS;
    b->scene.environment_samples = 16;
    b->canvas = draw_open_canvas(&b->gpu, SIZE, SIZE);
    b->pixels = malloc(NUM_FLOATS * sizeof(float));
    if (!b->canvas || !b->pixels)
        bench_fail("no canvas");
}

static void close_scene(struct bench *b)
{
    free(b->pixels);
    draw_close_canvas(b->canvas);
    mxg_scene_destroy(b->primitives);
    mxg_options_destroy(b->options);
    mxg_context_destroy(b->context);
    scene_finish(&b->scene);
}

int main(int argc, char **argv)
{
    struct bench b = {0};
    bool counts = argc > 1 && strcmp(argv[1], "operations") == 0;
    if (argc < 4 || argc > 3 + MAX_LOOKS || (!counts && strcmp(argv[1], "pixels") != 0))
        bench_fail("bench-slots pixels|operations FILE LOOK...");
    setenv("LP_NUM_THREADS", "0", 1);
    setenv("GALLIVM_PERF", "nopt", 0); /* LLVM's passes over eight blended layers take minutes */
    b.file = argv[2];
    b.looks = (const char *const *)argv + 3;
    b.num_looks = (uint32_t)argc - 3;
    if (!gpu_open(&b.gpu)) {
        printf("skip: %s\n", b.gpu.reason);
        return 0;
    }
    compile_begin();
    open_scene(&b);
    for (uint32_t look = 0; look < b.num_looks; ++look) {
        open_drawn(&b, b.looks[look], false, &b.blended[look]);
        open_drawn(&b, b.looks[look], true, &b.picked[look]);
    }
    if (counts) {
        measure_operations(&b, COUNT_OPERATIONS, "operations");
        measure_operations(&b, COUNT_INSTRUCTIONS, "instructions of SPIR-V");
    } else {
        measure_pixels(&b);
    }
    for (uint32_t look = 0; look < b.num_looks; ++look) {
        close_drawn(&b.blended[look]);
        close_drawn(&b.picked[look]);
    }
    close_scene(&b);
    gpu_close(&b.gpu);
    compile_end();
    return 0;
}
