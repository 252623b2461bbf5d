// SPDX-License-Identifier: Apache-2.0
/*
 * The cost of drawing in the deferred pipeline (docs/benchmarks.md, "The deferred pipeline"): the
 * processor time that lavapipe takes for a frame on one thread, as ratios of one run. Each number
 * is the least of a few frames. Argument: examples/deferred.mtlx.
 */
#define _POSIX_C_SOURCE 200809L
#include "bench/drawn.h"
#include "render/matrix.h"
#include "render/passes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { SIZE = 384, NUM_FRAMES = 9, NUM_ROUNDS = 3, NUM_LIGHTS = 8 };

/* How a material is drawn. */
enum way {
    WAY_FORWARD,
    WAY_DEFERRED,
    WAY_STORED, /* the material pass alone, with its depth pass */
    WAY_PLAIN   /* a G-buffer of Disney's diffuse, specular and roughness, and a normal */
};

struct bench {
    struct gpu gpu;
    struct scene scene;
    struct scene_object copies[BENCH_COPIES]; /* one around the other, the innermost first */
    mxg_context *context;
    mxg_options *options;
    mxg_document *examples, *mixes;
    float *pixels;
};

/* ---- Materials ---- */

/* M1 to M8: so many slabs beside each other; Half: M1 on one side of the ball, M8 on the other. */
static void parse_mixes(struct bench *b)
{
    static char text[8192];
    size_t len = (size_t)snprintf(text, sizeof text, "<materialx version='1.39'>");
    for (int i = 1; i <= 8; ++i) {
        len += (size_t)snprintf(text + len, sizeof text - len,
                                "<slab name='s%d' type='BSDF'><input name='roughness' type='float' "
                                "value='0.%d'/></slab>",
                                i, i);
        if (i > 1)
            len += (size_t)snprintf(
                text + len, sizeof text - len,
                "<slab_mix name='m%d' type='BSDF'><input name='fg' type='BSDF' nodename='s%d'/>"
                "<input name='bg' type='BSDF' nodename='%s%d'/>"
                "<input name='mix' type='float' value='0.5'/></slab_mix>",
                i, i, i > 2 ? "m" : "s", i - 1);
        len += (size_t)snprintf(text + len, sizeof text - len,
                                "<slab_surface name='M%d' type='surfaceshader'><input name='bsdf' "
                                "type='BSDF' nodename='%s%d'/></slab_surface>",
                                i, i > 1 ? "m" : "s", i);
    }
    snprintf(text + len, sizeof text - len,
             "<position name='p' type='vector3' space='world'/><extract name='x' type='float'>"
             "<input name='in' type='vector3' nodename='p'/></extract><ifgreater name='side' "
             "type='float'><input name='value1' type='float' nodename='x'/><input name='in1' "
             "type='float' value='1'/></ifgreater><slab_mix name='half' type='BSDF'>"
             "<input name='fg' type='BSDF' nodename='s1'/><input name='bg' type='BSDF' "
             "nodename='m8'/><input name='mix' type='float' nodename='side'/></slab_mix>"
             "<slab_surface name='Half' type='surfaceshader'><input name='bsdf' type='BSDF' "
             "nodename='half'/></slab_surface></materialx>");
    if (mxg_document_parse(b->context, mxg_library_builtin(b->context), "mixes.mtlx", text,
                           strlen(text), &b->mixes)
        != MXG_OK)
        bench_fail("the document of mixes does not load");
}

static mxg_result *generate(struct bench *b, const char *element, const char *pipeline)
{
    mxg_result *result = NULL;
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = "vulkan";
    desc.element = element;
    desc.options = b->options;
    mxg_options_set(b->options, "pipeline", pipeline);
    bool is_mix = element[0] == 'M' || strcmp(element, "Half") == 0;
    if (mxg_generate(b->context, is_mix ? b->mixes : b->examples, &desc, &result) != MXG_OK)
        bench_fail("%s does not generate", element);
    return result;
}

/* ---- The plain G-buffer ---- */

static const char plain_body[] =
    "layout(location = 0) out vec4 emission;\n"
    "layout(location = 1) out int diffuse;\n"
    "layout(location = 2) out int specular;\n"
    "layout(location = 3) out int normal;\n"
    "void main()\n"
    "{\n"
    "    emission = vec4(0.0, 0.0, 0.0, 1.0);\n"
    "    diffuse = int(packUnorm4x8(vec4(0.6, 0.2, 0.1, 0.0)));\n"
    "    specular = int(packUnorm4x8(vec4(0.04, 0.04, 0.04, 0.3)));\n"
    "    vec3 n = normalize(vd.normalWorld);\n"
    "    n.xy /= abs(n.x) + abs(n.y) + abs(n.z);\n"
    "    vec2 side = vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);\n"
    "    normal = int(packSnorm2x16(n.z < 0.0 ? (1.0 - abs(n.yx)) * side : n.xy));\n"
    "}\n";

/* The pixel stage, with the vertex data of another one. */
static void write_plain(const char *pixel, char *out, size_t capacity)
{
    const char *begin = strstr(pixel, "layout(location = 0) in VertexData"),
               *end = begin ? strstr(begin, ";\n") : NULL;
    while (end && strncmp(end, ";\n}", 3) != 0)
        end = strstr(end + 1, ";\n");
    end = end ? strchr(end + 3, '\n') : NULL;
    if (!end)
        bench_fail("the vertex data is not as expected");
    snprintf(out, capacity, "#version 450\n%.*s\n%s", (int)(end - begin), begin, plain_body);
}

static struct draw_program *open_plain(struct draw_canvas *canvas, struct bind *bind,
                                       struct compiled *compiled)
{
    static char pixel[16384];
    write_plain(mxg_result_source(bind->result, MXG_STAGE_PIXEL, NULL), pixel, sizeof pixel);
    const char *sources[MXG_NUM_STAGES] = {
        [MXG_STAGE_VERTEX] = mxg_result_source(bind->result, MXG_STAGE_VERTEX, NULL),
        [MXG_STAGE_PIXEL] = pixel};
    if (!bind_shader(bind) || !compile_program("vulkan", sources, compiled) || compiled->errors)
        bench_fail("the plain G-buffer does not compile: %s",
                   compiled->num_messages ? compiled->messages[0].text : bind->reason);
    for (int stage = 0; stage < 2; ++stage) {
        bind->draw.code[stage] = compiled->stages[stage].words;
        bind->draw.code_words[stage] = compiled->stages[stage].num_words;
    }
    if (!bind_scene(bind))
        bench_fail("%s", bind->reason);
    return draw_open(canvas, &bind->draw);
}

/* ---- Time ---- */

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double frame_seconds(struct bench *b, struct draw_canvas *canvas,
                            struct draw_program *const *programs, size_t count)
{
    double best = 1e9;
    for (int i = 0; i < NUM_FRAMES; ++i) {
        double begin = now();
        if (!draw_frame(canvas, programs, count, b->pixels))
            bench_fail("a frame fails: %s", b->gpu.reason);
        double time = now() - begin;
        best = time < best ? time : best;
    }
    return best;
}

struct frame {
    struct draw_canvas *canvas;
    struct passes passes;
    struct bind bind;
    struct render render;
    struct compiled compiled;
    struct draw_program *program;
};

static void open_stores(struct bench *b, struct frame *f, enum way way)
{
    mxg_shader_info info = {sizeof info};
    mxg_result_info(f->bind.result, &info);
    struct passes_setup setup = {.context = b->context,
                                 .options = b->options,
                                 .scene = &b->scene,
                                 .gpu = &b->gpu,
                                 .canvas = f->canvas,
                                 .width = SIZE,
                                 .height = SIZE,
                                 .words = info.stored_words,
                                 .shown = UINT32_MAX};
    bool good = way == WAY_STORED ? draw_store(f->canvas, info.stored_words) != NULL
                                  : passes_open(&setup, &f->passes);
    if (!good)
        bench_fail("no passes: %s", way == WAY_STORED ? b->gpu.reason : f->passes.reason);
    f->bind.draw.role = DRAW_STORES;
}

/*
 * The time for a frame of so many copies. Less that of a frame without a program: of the same
 * images for a part of a frame, of the picture alone for a whole one.
 */
static double seconds(struct bench *b, const char *element, enum way way, uint32_t copies)
{
    bool stores = way == WAY_DEFERRED || way == WAY_STORED;
    struct frame f = {.canvas = draw_open_canvas(&b->gpu, SIZE, SIZE)};
    f.bind = (struct bind){.result = generate(b, element, stores ? "deferred" : "forward"),
                           .scene = &b->scene,
                           .objects = b->copies + BENCH_COPIES - copies,
                           .num_objects = copies};
    double empty = way == WAY_DEFERRED ? frame_seconds(b, f.canvas, NULL, 0) : 0;
    if (stores)
        open_stores(b, &f, way);
    for (int i = 0; way == WAY_PLAIN && i < 3; ++i)
        draw_add_output(f.canvas, DRAW_WHOLE);
    if (way != WAY_DEFERRED)
        empty = frame_seconds(b, f.canvas, NULL, 0);
    if (way == WAY_PLAIN)
        f.program = open_plain(f.canvas, &f.bind, &f.compiled);
    else if (!render_open(&f.render, f.canvas, &b->gpu, &f.bind) || !bind_scene(&f.bind))
        bench_fail("%s: %s", element, f.bind.reason);
    struct draw_program *program = f.program ? f.program : f.render.program;
    if (way == WAY_DEFERRED && !passes_aim(&f.passes))
        bench_fail("%s", f.passes.reason);
    double time = frame_seconds(b, f.canvas, &program, 1) - empty;
    if (f.program)
        draw_close(f.program);
    else
        render_close(&f.render);
    draw_close_canvas(f.canvas);
    passes_close(&f.passes);
    compiled_finish(&f.compiled);
    mxg_result *result = (mxg_result *)(uintptr_t)f.bind.result;
    bind_finish(&f.bind);
    mxg_result_destroy(result);
    return time;
}

/* ---- Rows ---- */

static void row(const char *what, double time, double other)
{
    printf("| %s | %.1f | %.1f | %.2f |\n", what, 1e3 * time, 1e3 * other, time / other);
}

static void measure(struct bench *b)
{
    printf("| frame | milliseconds | of what | ratio |\n| --- | --- | --- | --- |\n");
    b->scene.num_lights = 3;
    row("material pass of one slab (SIMPLE), of a plain G-buffer of four targets",
        seconds(b, "Plain", WAY_STORED, 1), seconds(b, "Plain", WAY_PLAIN, 1));
    b->scene.num_lights = NUM_LIGHTS;
    row("one surface, 8 lights: one slab, of forward", seconds(b, "Plain", WAY_DEFERRED, 1),
        seconds(b, "Plain", WAY_FORWARD, 1));
    row("overdraw 4, 8 lights: one slab, of forward", seconds(b, "Plain", WAY_DEFERRED, 4),
        seconds(b, "Plain", WAY_FORWARD, 4));
    row("overdraw 4, 8 lights: two slabs with all features, of forward",
        seconds(b, "Lacquered", WAY_DEFERRED, 4), seconds(b, "Lacquered", WAY_FORWARD, 4));
}

/* The least of a few rounds, because the frames of many slabs wait for memory. */
static void measure_closures(struct bench *b)
{
    double of_half = 1e9, of[9] = {0};
    for (int round = 0; round < NUM_ROUNDS; ++round) {
        of_half = fmin(of_half, seconds(b, "Half", WAY_DEFERRED, 1));
        for (int i = 1; i <= 8; ++i) {
            const char name[] = {'M', (char)('0' + i), 0};
            double time = seconds(b, name, WAY_DEFERRED, 1);
            of[i] = round ? fmin(of[i], time) : time;
        }
    }
    printf("\n| slabs beside each other | milliseconds, 8 lights | for a slab |\n| --- | --- | --- "
           "|\n");
    for (int i = 1; i <= 8; ++i)
        printf("| %d | %.1f | %.1f |\n", i, 1e3 * of[i], 1e3 * of[i] / i);
    printf("\n| frame | milliseconds | of what | ratio |\n| --- | --- | --- | --- |\n");
    row("half 1 slab and half 8, of 8 slabs everywhere", of_half, of[8]);
    row("the same, of the mean of 1 and 8 slabs", of_half, (of[1] + of[8]) / 2);
}

int main(int argc, char **argv)
{
    struct bench b = {.pixels = malloc((size_t)SIZE * SIZE * 4 * sizeof(float))};
    setenv("LP_NUM_THREADS", "0", 1);
    if (argc != 2 || !gpu_open(&b.gpu) || !b.gpu.can_store)
        bench_fail("bench-deferred FILE: no file, or no device that can store: %s", b.gpu.reason);
    compile_begin();
    if (!scene_init_sphere(&b.scene, 1) || mxg_context_create(NULL, &b.context) != MXG_OK
        || mxg_options_create(b.context, &b.options) != MXG_OK
        || mxg_document_load(b.context, mxg_library_builtin(b.context), argv[1], &b.examples)
               != MXG_OK)
        bench_fail("no scene, or %s does not load", argv[1]);
    bench_place_copies(&b.scene, b.copies);
    parse_mixes(&b);
    mxg_options_set(b.options, "interface", "reduced");
    mxg_options_set(b.options, "environment", "none");
    mxg_options_set(b.options, "max-lights", "8");
    measure(&b);
    measure_closures(&b);
    mxg_document_destroy(b.examples);
    mxg_document_destroy(b.mixes);
    mxg_options_destroy(b.options);
    mxg_context_destroy(b.context);
    scene_finish(&b.scene);
    gpu_close(&b.gpu);
    compile_end();
    free(b.pixels);
    return 0;
}
