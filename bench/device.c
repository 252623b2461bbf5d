// SPDX-License-Identifier: Apache-2.0
/*
 * bench-device [--any] [--small] INTERFACE FILE...: the time that the device takes for a ball that
 * fills a picture of 1920x1080, for the first material of each document. It is the time of four
 * balls, one around the other, less that of one, so clearing and reading the picture drop out.
 * Prints a line per document: milliseconds of one ball, and its ratio to the first document's.
 * Without --any a processor is no device. --small: 192x108, for tests.
 */
#define _POSIX_C_SOURCE 200809L
#include "bench/drawn.h"
#include "render/render.h"

#include <mxgen/mxgen.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { NUM_FRAMES = 7 };

struct bench {
    struct gpu gpu;
    struct scene scene;
    struct scene_object copies[BENCH_COPIES]; /* the innermost first */
    mxg_context *context;
    mxg_options *options;
    uint32_t width, height;
    float *pixels;
    bool is_processor;
};

/* Of a processor its own time, because other programs run on it, too. */
static double now(const struct bench *b)
{
    struct timespec t;
    if (b->is_processor)
        return bench_seconds();
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static mxg_result *generate(struct bench *b, const char *path, mxg_document **out_document)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = "vulkan";
    desc.options = b->options;
    mxg_result *result = NULL;
    if (mxg_document_load(b->context, mxg_library_builtin(b->context), path, out_document) != MXG_OK
        || mxg_generate(b->context, *out_document, &desc, &result) != MXG_OK)
        bench_fail("%s does not generate", path);
    return result;
}

/* The least time of a few frames of so many balls. */
static double seconds(struct bench *b, const char *path, const mxg_result *result, uint32_t copies)
{
    struct draw_canvas *canvas = draw_open_canvas(&b->gpu, b->width, b->height);
    struct render render;
    struct bind bind = {.result = result,
                        .scene = &b->scene,
                        .document = path,
                        .checker = true,
                        .is_opaque = true,
                        .objects = b->copies + BENCH_COPIES - copies,
                        .num_objects = copies};
    if (!canvas || !render_open(&render, canvas, &b->gpu, &bind))
        bench_fail("%s: %s", path, canvas ? bind.reason : b->gpu.reason);
    double best = 1e9;
    for (int i = 0; i < NUM_FRAMES; ++i) {
        double begin = now(b);
        if (!render_frame(&render, 1, canvas, b->pixels))
            bench_fail("%s: %s", path, bind.reason);
        double time = now(b) - begin;
        best = time < best ? time : best;
    }
    if (!(b->pixels[3] > 0.0f)) /* opacity of a corner */
        bench_fail("%s: the ball does not fill the picture", path);
    render_close(&render);
    bind_finish(&bind);
    draw_close_canvas(canvas);
    return best;
}

static void measure(struct bench *b, const char *const *paths, int count)
{
    double first = 0;
    for (int i = 0; i < count; ++i) {
        mxg_document *document;
        mxg_result *result = generate(b, paths[i], &document);
        double time = seconds(b, paths[i], result, BENCH_COPIES) - seconds(b, paths[i], result, 1);
        time /= BENCH_COPIES - 1;
        first = i ? first : time;
        const char *name = strrchr(paths[i], '/');
        printf("| %s | %.3f | %.2f |\n", name ? name + 1 : paths[i], 1e3 * time, time / first);
        fflush(stdout);
        mxg_result_destroy(result);
        mxg_document_destroy(document);
    }
}

/* The camera stands where the ball fills the picture from edge to edge. */
static void open_scene(struct bench *b)
{
    static const double eye[3] = {0, 0, 1.15}, target[3] = {0, 0, 0};
    if (!scene_init_sphere(&b->scene, (double)b->width / b->height))
        bench_fail("out of memory");
    scene_set_camera(&b->scene, eye, target);
    bench_place_copies(&b->scene, b->copies);
}

int main(int argc, char **argv)
{
    struct bench b = {.width = 1920, .height = 1080};
    bool any = false;
    int at = 1;
    for (; at < argc && strncmp(argv[at], "--", 2) == 0; ++at) {
        any |= strcmp(argv[at], "--any") == 0;
        if (strcmp(argv[at], "--small") == 0)
            b.width = 192, b.height = 108;
    }
    if (argc - at < 2)
        bench_fail("bench-device [--any] [--small] INTERFACE FILE...");
    if (!gpu_open(&b.gpu)) {
        printf("skip: %s\n", b.gpu.reason);
        return 0;
    }
    VkPhysicalDeviceProperties device;
    vkGetPhysicalDeviceProperties(b.gpu.physical, &device);
    b.is_processor = device.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    if (b.is_processor && !any) {
        printf("skip: the only Vulkan device is a processor, %s; --any measures it\n",
               device.deviceName);
        return 0;
    }
    compile_begin();
    open_scene(&b);
    b.pixels = malloc((size_t)b.width * b.height * 4 * sizeof(float));
    if (!b.pixels || mxg_context_create(NULL, &b.context) != MXG_OK
        || mxg_options_create(b.context, &b.options) != MXG_OK
        || mxg_options_set(b.options, "interface", argv[at]) != MXG_OK)
        bench_fail("no context, or no such interface: %s", argv[at]);
    printf("| %s, %ux%u, %s | milliseconds | of the first |\n| --- | --- | --- |\n",
           device.deviceName, b.width, b.height, argv[at]);
    measure(&b, (const char *const *)argv + at + 1, argc - at - 1);
    mxg_options_destroy(b.options);
    mxg_context_destroy(b.context);
    scene_finish(&b.scene);
    gpu_close(&b.gpu);
    compile_end();
    free(b.pixels);
    return 0;
}
