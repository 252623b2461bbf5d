// SPDX-License-Identifier: Apache-2.0
/* mxgen-render: draws a material on a sphere in daylight, without a display. `mxgen render` starts it. */
#define _POSIX_C_SOURCE 200809L
#include "cli/cli.h"
#include "cli/files.h"
#include "render/render.h"
#include "validate/compile.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define OVERSAMPLING 2 /* samples for each pixel and axis */
#define MAX_SIZE 4096

enum scene_kind { SCENE_SPHERE, SCENE_PLANE, SCENE_GRID, NUM_SCENES };

static const struct {
    const char *name;
    double exposure; /* what a white surface in the scene's daylight needs; values as they are: 1 */
} scene_kinds[NUM_SCENES] = {[SCENE_SPHERE] = {"sphere", 0.6}, [SCENE_PLANE] = {"plane", 1.0}, [SCENE_GRID] = {"grid", 1.0}};

struct picture {
    struct cli cli;
    const char *output, *element, *size, *scene_name;
    struct arg_list settings; /* "path=value" */
    size_t samples;           /* of the environment */
    uint32_t width, height;
    enum scene_kind scene_kind;
    struct bind_value *values;
    struct scene scene;
    struct gpu gpu;
};

/* ---- Arguments ---- */

/* "512" or "640x480" */
static bool parse_size(struct picture *picture)
{
    char *end;
    unsigned long width = strtoul(picture->size, &end, 10), height = width;
    if (*end == 'x')
        height = strtoul(end + 1, &end, 10);
    if (*end || width < 1 || height < 1 || width > MAX_SIZE || height > MAX_SIZE) {
        fprintf(stderr, "mxgen: '%s' is not a size; write W or WxH, up to %d\n", picture->size, MAX_SIZE);
        return false;
    }
    picture->width = (uint32_t)width;
    picture->height = (uint32_t)height;
    return true;
}

/* Splits "path=value" in place; NULL after telling what is wrong. To be freed. */
static struct bind_value *split_settings(const struct arg_list *settings)
{
    struct bind_value *values = calloc(settings->len + 1, sizeof *values);
    for (size_t i = 0; values && i < settings->len; ++i) {
        const char *equals = strchr(settings->items[i], '=');
        if (!equals) {
            fprintf(stderr, "mxgen: '--set %s' has no '='; write --set path=value\n", settings->items[i]);
            free(values);
            return NULL;
        }
        values[i].path = cli_format("%.*s", (int)(equals - settings->items[i]), settings->items[i]);
        values[i].text = equals + 1;
    }
    return values;
}

static void free_values(struct bind_value *values, size_t count)
{
    for (size_t i = 0; values && i < count; ++i)
        free((void *)(uintptr_t)values[i].path);
    free(values);
}

/* ---- Pictures ---- */

/* IEC 61966-2-1 */
static uint8_t encode_srgb(double linear)
{
    double x = linear <= 0.0 ? 0.0 : linear >= 1.0 ? 1.0 : linear;
    double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055;
    return (uint8_t)(encoded * 255.0 + 0.5);
}

/* Averages the samples of each pixel, over a grey backdrop that is lighter on top. */
static void resolve(const struct picture *picture, const float *samples, uint8_t *out)
{
    size_t row = (size_t)picture->width * OVERSAMPLING;
    for (uint32_t y = 0; y < picture->height; ++y) {
        double backdrop = 0.18 - 0.12 * y / picture->height;
        for (uint32_t x = 0; x < picture->width; ++x, out += 4) {
            double sum[4] = {0};
            for (size_t i = 0; i < OVERSAMPLING * OVERSAMPLING; ++i) {
                const float *sample = samples + 4 * ((y * OVERSAMPLING + i / OVERSAMPLING) * row + x * OVERSAMPLING +
                                                     i % OVERSAMPLING);
                for (size_t c = 0; c < 4; ++c)
                    sum[c] += (double)sample[c] / (OVERSAMPLING * OVERSAMPLING);
            }
            for (size_t c = 0; c < 3; ++c)
                out[c] = encode_srgb(scene_kinds[picture->scene_kind].exposure * sum[c] + backdrop * (1.0 - fmin(sum[3], 1.0)));
            out[3] = 255;
        }
    }
}

static void print_values(const struct picture *picture, const char *element, unsigned components, const float *pixels)
{
    fputs(element, stdout);
    for (uint32_t y = picture->height; y-- > 0;)
        for (uint32_t x = 0; x < picture->width; ++x)
            for (unsigned c = 0; c < components; ++c)
                printf(",%.9g", (double)pixels[4 * ((size_t)y * picture->width + x) + c]);
    putchar('\n');
}

static void write_picture(struct picture *picture, const float *samples)
{
    char reason[256];
    uint8_t *pixels = malloc((size_t)picture->width * picture->height * 4);
    if (!pixels) {
        report_status(&picture->cli.report, MXG_ERROR_MEMORY);
        return;
    }
    resolve(picture, samples, pixels);
    if (!image_write(picture->output, picture->width, picture->height, pixels, reason, sizeof reason))
        report_error(&picture->cli.report, "output-failed", "cannot write '%s': %s", picture->output, reason);
    free(pixels);
}

/* ---- Drawing ---- */

/* Generates, compiles, binds and draws one element (NULL: the first). NULL where that failed. */
static float *draw_element(struct picture *picture, const mxg_document *document, const char *path, const char *element,
                           uint32_t scale)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = "vulkan";
    desc.element = element;
    desc.options = picture->cli.options;
    mxg_result *result = NULL;
    mxg_status status = mxg_generate(picture->cli.context, document, &desc, &result);
    if (result)
        report_list(&picture->cli.report, mxg_result_diagnostics(result));
    float *pixels = NULL;
    if (report_status(&picture->cli.report, status)) {
        struct bind bind = {.result = result,
                            .scene = &picture->scene,
                            .document = path,
                            .values = picture->values,
                            .num_values = picture->settings.len};
        uint32_t width = picture->width * scale, height = picture->height * scale;
        pixels = malloc((size_t)width * height * 4 * sizeof(float));
        if (!pixels || !render_result(&picture->gpu, &bind, width, height, pixels)) {
            report_error(&picture->cli.report, "render-failed", "%s: %s", element ? element : path,
                         pixels ? bind.reason : "out of memory");
            free(pixels);
            pixels = NULL;
        }
        bind_finish(&bind);
    }
    mxg_result_destroy(result);
    return pixels;
}

static void draw_picture(struct picture *picture, const mxg_document *document, const char *path)
{
    float *samples = draw_element(picture, document, path, picture->element, OVERSAMPLING);
    if (samples)
        write_picture(picture, samples);
    free(samples);
}

/* Components of a document type that a pixel shows; what is no vector is shown as a colour. */
static unsigned num_components(const char *type)
{
    if (strcmp(type, "float") == 0)
        return 1;
    if (strcmp(type, "vector2") == 0)
        return 2;
    return strcmp(type, "color4") == 0 || strcmp(type, "vector4") == 0 ? 4 : 3;
}

/* A line for each element: its path, then the values of the 16 pixels row by row from the bottom. */
static void draw_grid(struct picture *picture, const mxg_document *document, const char *path)
{
    for (uint32_t i = 0; i < mxg_document_num_renderables(document); ++i) {
        mxg_renderable renderable = {sizeof renderable};
        mxg_document_renderable(document, i, &renderable);
        if (picture->element && strcmp(picture->element, renderable.path) != 0)
            continue;
        float *pixels = draw_element(picture, document, path, renderable.path, 1);
        if (pixels)
            print_values(picture, renderable.path, num_components(renderable.type), pixels);
        free(pixels);
    }
}

static bool init_scene(struct picture *picture)
{
    switch (picture->scene_kind) {
    case SCENE_GRID:
        return scene_init_grid(&picture->scene);
    case SCENE_PLANE:
        return scene_init_plane(&picture->scene);
    case SCENE_SPHERE:
    default:
        return scene_init_sphere(&picture->scene, (double)picture->width / picture->height);
    }
}

static bool open_scene(struct picture *picture)
{
    if (!init_scene(picture))
        return report_status(&picture->cli.report, MXG_ERROR_MEMORY);
    picture->scene.environment_samples = (uint32_t)picture->samples;
    if (!gpu_open(&picture->gpu))
        report_error(&picture->cli.report, "no-device", "cannot draw: %s", picture->gpu.reason);
    return !picture->gpu.reason[0];
}

static void render_document(struct picture *picture, const char *path)
{
    mxg_document *document = cli_load(&picture->cli, path);
    if (document && open_scene(picture)) {
        compile_begin();
        if (picture->scene_kind == SCENE_GRID)
            draw_grid(picture, document, path);
        else
            draw_picture(picture, document, path);
        compile_end();
    }
    gpu_close(&picture->gpu);
    scene_finish(&picture->scene);
    mxg_document_destroy(document);
}

static bool find_scene(struct picture *picture)
{
    for (unsigned i = 0; i < NUM_SCENES; ++i) {
        picture->scene_kind = (enum scene_kind)i;
        if (strcmp(picture->scene_name, scene_kinds[i].name) == 0)
            return true;
    }
    fprintf(stderr, "mxgen: '%s' is no scene; there are sphere, plane and grid\n", picture->scene_name);
    return false;
}

static int run(struct picture *picture)
{
    if (!find_scene(picture))
        return EXIT_USAGE;
    bool is_grid = picture->scene_kind == SCENE_GRID;
    if (picture->cli.parser.inputs.len != 1 || (!picture->output && !is_grid)) {
        fputs("usage: mxgen render FILE -o PICTURE.png\n", stderr);
        return EXIT_USAGE;
    }
    if (is_grid)
        picture->size = "4";
    picture->values = parse_size(picture) ? split_settings(&picture->settings) : NULL;
    if (!picture->values)
        return EXIT_USAGE;
    render_document(picture, picture->cli.parser.inputs.items[0]);
    free_values(picture->values, picture->settings.len);
    return picture->cli.report.errors ? EXIT_FAULT : EXIT_DONE;
}

int main(int argc, char **argv)
{
    static const struct command command = {"render",
                                           "render FILE -o PICTURE.png [--size WxH] [--set PATH=VALUE] [options]",
                                           "Draws a material on a sphere in daylight, without a display.", NULL};
    struct picture picture = {.size = "512", .scene_name = "sphere", .samples = 16};
    const struct arg args[] = {
        {"output", 'o', ARG_TEXT, "FILE", "the picture to write; the ending chooses the format", &picture.output},
        {"size", 's', ARG_TEXT, "W[xH]", "its size in pixels (default: 512)", &picture.size},
        {"element", 'e', ARG_TEXT, "PATH", "what to draw (default: the first that can be rendered)", &picture.element},
        {"set", 0, ARG_LIST, "PATH=VALUE", "another value for an input, or file for a texture", &picture.settings},
        {"samples", 0, ARG_SIZE, "N", "samples of the environment for each lobe (default: 16)", &picture.samples},
        {"scene", 0, ARG_TEXT, "NAME",
         "sphere; plane, to see a pattern; grid: prints the values of 4x4 pixels for each element (default: sphere)",
         &picture.scene_name},
    };
    /* llvmpipe's optimiser takes minutes for large shaders; without it pictures are the same, and seconds are enough.
     */
    setenv("GALLIVM_PERF", "nopt", 0);
    int code;
    if (cli_start(&picture.cli, &command, args, sizeof args / sizeof *args, CLI_GENERATES | CLI_NEEDS_INPUT, argc, argv,
                  &code))
        code = run(&picture);
    cli_finish(&picture.cli);
    free(picture.settings.items);
    return code;
}
