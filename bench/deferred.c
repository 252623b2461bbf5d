// SPDX-License-Identifier: Apache-2.0
/*
 * bench-deferred [--size PIXELS] FILE: the cost of drawing in the deferred pipeline
 * (docs/benchmarks.md, "The deferred pipeline"): what the device takes for a frame; of lavapipe,
 * the processor time on one thread. The frames that are compared are drawn in turn, and numbers are
 * medians of the rounds. FILE: examples/deferred.mtlx.
 *
 * --size: of the square picture, 384 without it; a GPU needs a larger one for times that can be
 *   compared.
 */
#define _POSIX_C_SOURCE 200809L
#include "bench/frame_time.h"
#include "render/matrix.h"
#include "render/deferred_passes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NUM_FRAMES = 3, NUM_ROUNDS = 11, NUM_LIGHTS = 8 };

/* How a material is drawn. */
enum way {
    WAY_FORWARD,
    WAY_DEFERRED,
    WAY_HOSTED, /* deferred, with shadows by a function of the host that hides nothing */
    WAY_STORED, /* the material pass alone, with its depth pass */
    WAY_PLAIN   /* a G-buffer of Disney's diffuse, specular and roughness, and a normal */
};

struct bench {
    struct gpu gpu;
    uint32_t size; /* of the picture in both directions */
    struct scene scene;
    struct scene_object copies[BENCH_COPIES]; /* one around the other, the innermost first */
    mxg_context *context;
    mxg_options *options;
    mxg_document *examples, *mixes;
    struct draw_canvas *blank; /* the picture alone */
    float *pixels;
};

/* ---- Materials ---- */

/* M1 to M8: so many slabs beside each other; Half: M1 on the right of the picture, M8 on the left.
 */
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
             "<position name='p' type='vector3'><input name='space' type='string' value='world'/>"
             "</position><dotproduct name='x' type='float'><input name='in1' type='vector3' "
             "nodename='p'/><input name='in2' type='vector3' value='%.9g, %.9g, %.9g'/>"
             "</dotproduct><ifgreater name='side' "
             "type='float'><input name='value1' type='float' nodename='x'/><input name='in1' "
             "type='float' value='1'/></ifgreater><slab_mix name='half' type='BSDF'>"
             "<input name='fg' type='BSDF' nodename='s1'/><input name='bg' type='BSDF' "
             "nodename='m8'/><input name='mix' type='float' nodename='side'/></slab_mix>"
             "<slab_surface name='Half' type='surfaceshader'><input name='bsdf' type='BSDF' "
             "nodename='half'/></slab_surface></materialx>",
             b->scene.view.m[0][0], b->scene.view.m[1][0], b->scene.view.m[2][0]);
    if (mxg_document_parse(b->context, mxg_library_builtin(b->context), "mixes.mtlx", text,
                           strlen(text), &b->mixes)
        != MXG_OK)
        bench_fail("the document of mixes does not load");
}

static mxg_result *generate(struct bench *b, const char *element, const char *role)
{
    mxg_result *result = NULL;
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = "vulkan";
    desc.element = element;
    desc.options = b->options;
    mxg_options_set(b->options, "role", role);
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

/* ---- Frames ---- */

struct frame {
    struct draw_canvas *canvas;
    struct passes passes;
    struct bind bind;
    struct render render;
    struct compiled compiled;
    struct draw_program *program;
    struct draw_canvas *empty; /* what a frame without a program is drawn to */
};

static void open_stores(struct bench *b, struct frame *f, enum way way)
{
    mxg_storage storage = {sizeof storage};
    mxg_result_storage(f->bind.result, &storage);
    struct passes_setup setup = {.context = b->context,
                                 .options = b->options,
                                 .scene = &b->scene,
                                 .canvas = f->canvas,
                                 .words = storage.words,
                                 .classes = storage.classes,
                                 .host = "float mxg_shadow(int i, vec3 P, vec3 N, vec3 L)\n"
                                         "{\n    return 1.0;\n}\n",
                                 .shown = UINT32_MAX};
    mxg_options_set(b->options, "host-shadows", way == WAY_HOSTED ? "true" : "false");
    bool good = way == WAY_STORED ? draw_store(f->canvas, storage.words) != NULL
                                  : passes_open(&setup, &f->passes);
    if (!good)
        bench_fail("no passes: %s", way == WAY_STORED ? b->gpu.reason : f->passes.reason);
    f->bind.draw.role = DRAW_STORES;
}

/* A frame of so many copies. */
static void open_frame(struct bench *b, const char *element, enum way way, uint32_t copies,
                       struct frame *f)
{
    bool is_lit = way == WAY_DEFERRED || way == WAY_HOSTED, stores = is_lit || way == WAY_STORED;
    *f = (struct frame){.canvas = draw_open_canvas(&b->gpu, b->size, b->size)};
    f->bind = (struct bind){.result = generate(b, element, stores ? "deferred" : "raster"),
                            .scene = &b->scene,
                            .objects = b->copies + BENCH_COPIES - copies,
                            .num_objects = copies};
    if (stores)
        open_stores(b, f, way);
    for (int i = 0; way == WAY_PLAIN && i < 3; ++i)
        draw_add_output(f->canvas, DRAW_WHOLE);
    if (way == WAY_PLAIN)
        f->program = open_plain(f->canvas, &f->bind, &f->compiled);
    else if (!render_open(&f->render, f->canvas, &b->gpu, &f->bind) || !bind_scene(&f->bind))
        bench_fail("%s: %s", element, f->bind.reason);
    else
        f->program = f->render.program;
    if (is_lit && !passes_aim(&f->passes))
        bench_fail("%s", f->passes.reason);
    f->empty = is_lit ? b->blank : f->canvas;
}

static void close_frame(struct frame *f)
{
    if (f->render.program)
        render_close(&f->render);
    else
        draw_close(f->program);
    draw_close_canvas(f->canvas);
    passes_close(&f->passes);
    compiled_finish(&f->compiled);
    mxg_result *result = (mxg_result *)(uintptr_t)f->bind.result;
    bind_finish(&f->bind);
    mxg_result_destroy(result);
}

/* ---- Time ---- */

/* The least time of a few frames. program: may be NULL. */
static double least_seconds(struct bench *b, struct draw_canvas *canvas,
                            struct draw_program *program)
{
    double best = 1e9;
    for (int i = 0; i < NUM_FRAMES; ++i)
        best = fmin(best, bench_frame(canvas, &program, program ? 1 : 0, b->pixels));
    return best;
}

/*
 * Less the time of a frame without a program: of the same images for a part of a frame, of the
 * picture alone for a whole one.
 */
static double seconds(struct bench *b, const struct frame *f)
{
    return least_seconds(b, f->canvas, f->program) - least_seconds(b, f->empty, NULL);
}

static double median(double *numbers)
{
    return bench_quartiles(numbers, NUM_ROUNDS).median;
}

/* ---- Rows ---- */

/* Times of each round, and their ratio: other work on the machine slows both of a round. */
struct pair {
    double time[NUM_ROUNDS], other[NUM_ROUNDS], ratio[NUM_ROUNDS];
};

static void record(struct pair *pair, int round, double time, double other)
{
    pair->time[round] = time;
    pair->other[round] = other;
    pair->ratio[round] = time / other;
}

static void print_head(void)
{
    printf("| frame | milliseconds | of what | ratio | half of the rounds |\n"
           "| --- | --- | --- | --- | --- |\n");
}

static void print_row(const char *what, struct pair *pair)
{
    struct bench_quartiles ratio = bench_quartiles(pair->ratio, NUM_ROUNDS);
    printf("| %s | %.3f | %.3f | %.2f | %.2f to %.2f |\n", what, 1e3 * median(pair->time),
           1e3 * median(pair->other), ratio.median, ratio.lower, ratio.upper);
    fflush(stdout);
}

static void compare(struct bench *b, const char *what, const char *element, enum way way,
                    enum way other, uint32_t copies)
{
    struct frame frames[2];
    struct pair pair;
    open_frame(b, element, way, copies, &frames[0]);
    open_frame(b, element, other, copies, &frames[1]);
    for (int round = 0; round < NUM_ROUNDS; ++round)
        record(&pair, round, seconds(b, &frames[0]), seconds(b, &frames[1]));
    print_row(what, &pair);
    close_frame(&frames[0]);
    close_frame(&frames[1]);
}

static void measure(struct bench *b)
{
    print_head();
    compare(b, "material pass of one slab (SIMPLE), of a plain G-buffer of four targets", "Plain",
            WAY_STORED, WAY_PLAIN, 1);
    compare(b, "one surface, 8 lights: one slab, of forward", "Plain", WAY_DEFERRED, WAY_FORWARD,
            1);
    compare(b, "one surface, 8 lights: one slab, asking the host for shadows, of not asking",
            "Plain", WAY_HOSTED, WAY_DEFERRED, 1);
    compare(b, "overdraw 4, 8 lights: one slab, of forward", "Plain", WAY_DEFERRED, WAY_FORWARD, 4);
    compare(b, "overdraw 4, 8 lights: two slabs with all features, of forward", "Lacquered",
            WAY_DEFERRED, WAY_FORWARD, 4);
}

enum { HALF, NUM_MIXES = 9 }; /* M1 to M8 by their numbers */

static void measure_closures(struct bench *b)
{
    struct frame frames[NUM_MIXES];
    static double times[NUM_MIXES][NUM_ROUNDS];
    static struct pair of_eight, of_mean;
    for (int i = 0; i < NUM_MIXES; ++i) {
        const char name[] = {'M', (char)('0' + i), 0};
        open_frame(b, i == HALF ? "Half" : name, WAY_DEFERRED, 1, &frames[i]);
    }
    for (int round = 0; round < NUM_ROUNDS; ++round) {
        for (int i = 0; i < NUM_MIXES; ++i)
            times[i][round] = seconds(b, &frames[i]);
        record(&of_eight, round, times[HALF][round], times[8][round]);
        record(&of_mean, round, times[HALF][round], (times[1][round] + times[8][round]) / 2);
    }
    printf("\n| slabs beside each other | milliseconds, 8 lights | for a slab |\n| --- | --- | --- "
           "|\n");
    for (int i = 1; i < NUM_MIXES; ++i) {
        double time = 1e3 * median(times[i]);
        printf("| %d | %.3f | %.3f |\n", i, time, time / i);
    }
    printf("\n");
    print_head();
    print_row("half 1 slab and half 8, of 8 slabs everywhere", &of_eight);
    print_row("the same, of the mean of 1 and 8 slabs", &of_mean);
    for (int i = 0; i < NUM_MIXES; ++i)
        close_frame(&frames[i]);
}

static const char *read_options(struct bench *b, int argc, char **argv)
{
    char end;
    b->size = 384;
    if (argc == 2)
        return argv[1];
    if (argc != 4 || strcmp(argv[1], "--size") != 0 || sscanf(argv[2], "%u%c", &b->size, &end) != 1
        || !b->size || b->size > 8192)
        bench_fail("bench-deferred [--size PIXELS] FILE");
    return argv[3];
}

static void print_device(const struct bench *b)
{
    VkPhysicalDeviceProperties device;
    vkGetPhysicalDeviceProperties(b->gpu.physical, &device);
    printf("%s, %ux%u pixels\n\n", device.deviceName, b->size, b->size);
}

int main(int argc, char **argv)
{
    struct bench b = {0};
    const char *file = read_options(&b, argc, argv);
    b.pixels = malloc((size_t)b.size * b.size * 4 * sizeof(float));
    setenv("LP_NUM_THREADS", "0", 1);
    if (!b.pixels || !gpu_open(&b.gpu) || !b.gpu.can_store)
        bench_fail("no device that can store: %s", b.gpu.reason);
    print_device(&b);
    compile_begin();
    if (!scene_init_sphere(&b.scene, 1) || mxg_context_create(NULL, &b.context) != MXG_OK
        || mxg_options_create(b.context, &b.options) != MXG_OK
        || mxg_document_load(b.context, mxg_library_builtin(b.context), file, &b.examples)
               != MXG_OK)
        bench_fail("no scene, or %s does not load", file);
    bench_place_copies(&b.scene, b.copies);
    parse_mixes(&b);
    mxg_options_set(b.options, "interface", "reduced");
    mxg_options_set(b.options, "environment", "none");
    mxg_options_set(b.options, "max-lights", "8");
    b.scene.num_lights = NUM_LIGHTS;
    b.blank = draw_open_canvas(&b.gpu, b.size, b.size);
    measure(&b);
    measure_closures(&b);
    draw_close_canvas(b.blank);
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
