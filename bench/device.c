// SPDX-License-Identifier: Apache-2.0
/*
 * bench-device [--any] [--size WIDTHxHEIGHT] [--materialx FOLDER] [--pictures FOLDER] INTERFACE
 * FILE...: the time that the device takes for a ball that fills a picture, for the first material
 * of each document. Four balls, one around the other, less the innermost, which also draws what is
 * behind it, are three; and less the same frames with the camera turned away, so that only pixels
 * count: not vertices, nor what a driver does for each draw call. A figure is the median of the
 * rounds.
 *
 * --any: a processor is a device, too; its time is that of the program, in one thread. Times of
 * other devices are those of their own clocks, without the copy of the picture.
 * --size: 1920x1080 without it.
 * --materialx: draws the shaders FOLDER/INTERFACE/NAME of these documents in turn with mxgen's
 *   (foreign.h, bench/gpu/materialx.py), and prints ratios. Their pictures may differ by no more
 *   than MAX_DIFFERENCE.
 * --pictures: writes what was drawn to NAME.mxgen.exr and NAME.materialx.exr.
 */
#define _POSIX_C_SOURCE 200809L
#include "bench/foreign.h"

#include "bench/frame_time.h"
#include "render/render.h"

#include <math.h>
#include <mxgen/mxgen.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NUM_ROUNDS = 7, NUM_SAMPLES = 16, MAX_DOCUMENTS = 256 };
#define MAX_DIFFERENCE 0.005 /* mean of the channels, which are 0 to 1 */

/* A shader on the device. */
struct shader {
    struct bind bind;
    struct render render;
    float *pixels;
    double times[NUM_ROUNDS];
};

/* The figures of a document. */
struct row {
    char name[64], family[64]; /* its file and its folder */
    double time, ratio;        /* of mxgen's shader in seconds; to MaterialX's, 0: not drawn */
};

struct bench {
    struct gpu gpu;
    struct scene scene;
    struct scene_object copies[BENCH_COPIES]; /* the innermost first */
    struct draw_canvas *canvas;
    mxg_context *context;
    mxg_options *options;
    const char *interface, *materialx, *pictures;
    uint32_t width, height;
    bool any;
    struct row rows[MAX_DOCUMENTS];
    int num_faults;
};

/*
 * At the centre of the balls from 1.4 of their radius, where even the innermost fills the picture,
 * and the outermost is not cut off by the near plane; or away from them.
 */
static void look(struct bench *b, bool at_balls)
{
    static const double eye[3] = {0.235, 0.27, 1.455}, balls[3] = {0.05, -0.03, 0.1},
                        away[3] = {0.42, 0.57, 2.81};
    scene_set_camera(&b->scene, eye, at_balls ? balls : away);
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

/* Draws so many balls as the camera sees them; returns the time. */
static double draw(struct bench *b, struct shader *shader, uint32_t copies)
{
    if (!bind_scene(&shader->bind))
        bench_fail("%s: %s", shader->bind.document, shader->bind.reason);
    shader->bind.draw.num_objects = copies;
    double seconds = bench_frame(b->canvas, &shader->render.program, 1, shader->pixels);
    shader->bind.draw.num_objects = BENCH_COPIES;
    return seconds;
}

/*
 * Opens a result, or a program that mxgen did not write, and draws the first frame, which compiles
 * on some devices.
 */
static void open_shader(struct bench *b, const char *path, const mxg_result *result,
                        const struct bind_program *program, struct shader *out)
{
    *out = (struct shader){.bind = {.result = result,
                                    .program = program,
                                    .scene = &b->scene,
                                    .document = path,
                                    .checker = true,
                                    .is_opaque = true,
                                    .objects = b->copies,
                                    .num_objects = BENCH_COPIES}};
    out->pixels = malloc((size_t)b->width * b->height * 4 * sizeof(float));
    if (!out->pixels || !render_open(&out->render, b->canvas, &b->gpu, &out->bind))
        bench_fail("%s: %s", path, out->pixels ? out->bind.reason : "out of memory");
    draw(b, out, BENCH_COPIES);
}

static void close_shader(struct shader *shader)
{
    render_close(&shader->render);
    bind_finish(&shader->bind);
    free(shader->pixels);
}

/* Measures the pixels of so many balls. */
static double seconds_of_pixels(struct bench *b, struct shader *shader, uint32_t copies)
{
    double seen = draw(b, shader, copies);
    look(b, false);
    double unseen = draw(b, shader, copies);
    look(b, true);
    return seen - unseen;
}

static double seconds_of_ball(struct bench *b, struct shader *shader)
{
    double all = seconds_of_pixels(b, shader, BENCH_COPIES);
    return (all - seconds_of_pixels(b, shader, 1)) / (BENCH_COPIES - 1);
}

/* ---- Both pictures ---- */

static double difference(const struct bench *b, const float *left, const float *right)
{
    size_t count = (size_t)b->width * b->height * 4;
    double sum = 0;
    for (size_t i = 0; i < count; ++i)
        if (i % 4 < 3)
            sum += fabs(fmin(left[i], 1) - fmin(right[i], 1));
    return sum / (0.75 * (double)count);
}

static void write_picture(const struct bench *b, const struct row *row, const char *whose,
                          float *pixels)
{
    char path[4096], reason[256];
    const struct image image = {
        .width = b->width, .height = b->height, .is_float = true, .pixels = pixels};
    if (!b->pictures)
        return;
    snprintf(path, sizeof path, "%s/%s.%s.exr", b->pictures, row->name, whose);
    if (!image_write(path, &image, reason, sizeof reason))
        bench_fail("%s: %s", path, reason);
}

/* ---- Measuring ---- */

/* Adds MaterialX's figures to the row; in each round both draw, so that other work on the machine
 * slows both. */
static void measure_both(struct bench *b, const char *path, struct shader *ours,
                         const struct foreign *foreign, struct row *row)
{
    struct shader theirs;
    double ratios[NUM_ROUNDS];
    open_shader(b, path, NULL, &foreign->program, &theirs);
    double differs = difference(b, ours->pixels, theirs.pixels);
    write_picture(b, row, "materialx", theirs.pixels);
    for (int i = 0; i < NUM_ROUNDS; ++i) {
        ours->times[i] = seconds_of_ball(b, ours);
        theirs.times[i] = seconds_of_ball(b, &theirs);
        ratios[i] = ours->times[i] / theirs.times[i];
    }
    printf(" %.3f |", 1e3 * bench_quartiles(theirs.times, NUM_ROUNDS).median);
    if (differs <= MAX_DIFFERENCE) {
        row->ratio = bench_quartiles(ratios, NUM_ROUNDS).median;
        printf(" %.3f | %.4f |", row->ratio, differs);
    } else {
        ++b->num_faults;
        printf(" not counted | %.4f: the pictures differ |", differs);
    }
    close_shader(&theirs);
}

static void name_row(const char *path, struct row *row)
{
    const char *file = strrchr(path, '/'), *folder = file;
    while (folder && folder > path && folder[-1] != '/')
        --folder;
    snprintf(row->name, sizeof row->name, "%s", file ? file + 1 : path);
    row->name[strcspn(row->name, ".")] = '\0';
    snprintf(row->family, sizeof row->family, "%.*s", file ? (int)(file - folder) : 1,
             file ? folder : ".");
}

static void measure(struct bench *b, const char *path, struct row *row)
{
    mxg_document *document;
    mxg_result *result = generate(b, path, &document);
    struct foreign *foreign = NULL;
    struct shader ours;
    char stem[4096];
    name_row(path, row);
    snprintf(stem, sizeof stem, "%s/%s/%s", b->materialx ? b->materialx : "", b->interface,
             row->name);
    if (b->materialx)
        foreign = foreign_open(stem);
    open_shader(b, path, result, NULL, &ours);
    if (!(ours.pixels[3] > 0.0f)) /* opacity of a corner */
        bench_fail("%s: the ball does not fill the picture", path);
    write_picture(b, row, "mxgen", ours.pixels);
    printf("| %s |", row->name);
    if (foreign) {
        measure_both(b, path, &ours, foreign, row);
    } else {
        for (int i = 0; i < NUM_ROUNDS; ++i)
            ours.times[i] = seconds_of_ball(b, &ours);
        printf(" %s | - | - |", b->materialx ? "not in the folder" : "-");
        b->num_faults += b->materialx != NULL;
    }
    row->time = bench_quartiles(ours.times, NUM_ROUNDS).median;
    printf(" %.3f | %.2f |\n", 1e3 * row->time, row->time / b->rows[0].time);
    fflush(stdout);
    close_shader(&ours);
    foreign_close(foreign);
    mxg_result_destroy(result);
    mxg_document_destroy(document);
}

/* ---- All documents ---- */

/* A line for the rows of a family; NULL: all. */
static void print_family(const struct row *rows, int count, const char *family)
{
    double ratios[MAX_DOCUMENTS];
    size_t found = 0;
    for (int i = 0; i < count; ++i)
        if (rows[i].ratio > 0 && (!family || strcmp(rows[i].family, family) == 0))
            ratios[found++] = rows[i].ratio;
    if (!found)
        return;
    double middle = bench_quartiles(ratios, found).median;
    printf("| %s | %zu | %.2f (%.2f, %.2f) |\n", family ? family : "all", found, middle, ratios[0],
           ratios[found - 1]);
}

static void print_families(const struct bench *b, int count)
{
    printf("\n| folder, %s | documents | mxgen to MaterialX: median (least, most) |\n"
           "| --- | --- | --- |\n",
           b->interface);
    for (int i = 0; i < count; ++i) {
        int first = 0;
        while (strcmp(b->rows[first].family, b->rows[i].family) != 0)
            ++first;
        if (first == i)
            print_family(b->rows, count, b->rows[i].family);
    }
    print_family(b->rows, count, NULL);
}

static void measure_all(struct bench *b, const char *device, const char *const *paths, int count)
{
    if (!b->materialx)
        printf("MaterialX's shaders: not given (--materialx FOLDER)\n");
    printf("| %s, %ux%u, %s | MaterialX, milliseconds | mxgen to MaterialX | difference of the "
           "pictures | mxgen, milliseconds | of the first |\n"
           "| --- | --- | --- | --- | --- | --- |\n",
           device, b->width, b->height, b->interface);
    for (int i = 0; i < count; ++i)
        measure(b, paths[i], &b->rows[i]);
    if (b->materialx)
        print_families(b, count);
}

static void open_scene(struct bench *b)
{
    if (!scene_init_sphere(&b->scene, (double)b->width / b->height))
        bench_fail("out of memory");
    b->scene.environment_samples = NUM_SAMPLES;
    look(b, true);
    bench_place_copies(&b->scene, b->copies);
}

/* Returns the number of arguments that are options, with the name of the program. */
static int read_options(struct bench *b, int argc, char **argv)
{
    int at = 1;
    for (; at < argc && strncmp(argv[at], "--", 2) == 0; ++at) {
        const char *value = at + 1 < argc ? argv[at + 1] : "";
        char end;
        if (strcmp(argv[at], "--any") == 0) {
            b->any = true;
            continue;
        }
        if (strcmp(argv[at], "--materialx") == 0)
            b->materialx = value;
        else if (strcmp(argv[at], "--pictures") == 0)
            b->pictures = value;
        else if (strcmp(argv[at], "--size") != 0
                 || sscanf(value, "%ux%u%c", &b->width, &b->height, &end) != 2)
            bench_fail("no such option or value: %s %s", argv[at], value);
        ++at;
    }
    if (argc - at < 2 || argc - at > 1 + MAX_DOCUMENTS)
        bench_fail("bench-device [--any] [--size WIDTHxHEIGHT] [--materialx FOLDER] [--pictures "
                   "FOLDER] INTERFACE FILE...");
    return at;
}

int main(int argc, char **argv)
{
    static struct bench b = {.width = 1920, .height = 1080};
    int at = read_options(&b, argc, argv);
    setenv("LP_NUM_THREADS", "0", 1);
    if (!gpu_open(&b.gpu)) {
        printf("skip: %s\n", b.gpu.reason);
        return 0;
    }
    VkPhysicalDeviceProperties device;
    vkGetPhysicalDeviceProperties(b.gpu.physical, &device);
    if (gpu_is_processor(&b.gpu) && !b.any) {
        printf("skip: the only Vulkan device is a processor, %s; --any measures it\n",
               device.deviceName);
        return 0;
    }
    compile_begin();
    open_scene(&b);
    b.interface = argv[at];
    b.canvas = draw_open_canvas(&b.gpu, b.width, b.height);
    if (!b.canvas || mxg_context_create(NULL, &b.context) != MXG_OK
        || mxg_options_create(b.context, &b.options) != MXG_OK
        || mxg_options_set(b.options, "interface", b.interface) != MXG_OK)
        bench_fail("no picture, no context, or no such interface: %s", b.interface);
    measure_all(&b, device.deviceName, (const char *const *)argv + at + 1, argc - at - 1);
    mxg_options_destroy(b.options);
    mxg_context_destroy(b.context);
    draw_close_canvas(b.canvas);
    scene_finish(&b.scene);
    gpu_close(&b.gpu);
    compile_end();
    return b.num_faults > 0;
}
