// SPDX-License-Identifier: Apache-2.0
/*
 * A document as `mxgen bake` and `mxgen export` see it, with numbers of the input's bytes in place
 * of what a device draws. A bake is a document without errors, and where a command fails, it leaves
 * nothing.
 */
#include "fuzz.h"

#include "export/export.h"
#include "program/scratch.h"
#include "render/bake.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

/* ---- In place of the device ---- */

static unsigned seed;

bool gpu_open(struct gpu *gpu)
{
    (void)gpu;
    return true;
}

void gpu_close(struct gpu *gpu)
{
    (void)gpu;
}

/* A few numbers that images and formats treat in their own ways. */
static float next_number(void)
{
    static const float numbers[] = {0, 1, 0.5f, -1, 2, 1e-7f, 65505.0f, 3e38f};
    seed = seed * 1664525u + 1013904223u;
    return seed >> 31 ? (float)(seed >> 8 & 0xffff) / 65535.0f : numbers[seed >> 16 & 7];
}

static void fill(struct spool *spool, bool is_flat)
{
    float texel[4];
    for (uint32_t i = 0; i < spool->width * spool->height; ++i) {
        for (uint32_t c = 0; c < spool->channels && (!i || !is_flat); ++c)
            texel[c] = next_number();
        FUZZ_REQUIRE(!spool_put(spool, i % spool->width, i / spool->width, 1, texel));
    }
}

static bool draw(struct baking *baking, struct bake_drawing *drawing)
{
    enum { MAX_TILES = 4 };
    struct spool spools[MAX_TILES] = {{0}};
    uint32_t size = drawing->needs ? 4 : 1, num = bake_tiles_of(baking, drawing)->num;
    seed = seed * 1664525u + 1013904223u;
    bool is_flat = seed >> 30 == 0;
    if (num > MAX_TILES)
        return false;
    for (uint32_t i = 0; i < num; ++i) {
        FUZZ_REQUIRE(!spool_open(&spools[i], baking->options.output, size, size,
                                 bake_channels(drawing->type)));
        fill(&spools[i], is_flat);
    }
    bool good = bake_finish_drawing(baking, drawing, spools, num);
    for (uint32_t i = 0; i < num; ++i)
        spool_close(&spools[i]);
    return good;
}

bool bake_draw(struct baking *baking)
{
    bool good = true;
    for (size_t i = 0; good && i < baking->plan.num_drawings; ++i)
        good = draw(baking, &baking->plan.drawings[i]);
    return good || baking->cli.report.errors;
}

/* ---- Commands ---- */

static const struct {
    int (*run)(int argc, char **argv);
    const char *output, *file;
    void (*require)(const char *path);
} commands[] = {{bake_main, "flat", "flat/in.mtlx", fuzz_require_document},
                {export_main, "out.gltf", "out.gltf", NULL},
                {export_main, "out.glb", "out.glb", NULL},
                {export_main, "out.usda", "out.usda", NULL},
                {export_main, "out.usdz", "out.usdz", NULL}};
enum { NUM_COMMANDS = sizeof commands / sizeof *commands };

void fuzz_run(const char *data, size_t size, struct fuzz_heap *heap)
{
    static const char *const meshes[] = {NULL, "plane", "cube"};
    struct scratch scratch;
    struct arg_list args = {0};
    unsigned chosen = fuzz_choice(data, size, NUM_COMMANDS);
    const char *mesh = meshes[fuzz_choice(data, size, NUM_COMMANDS * 3) / NUM_COMMANDS];
    (void)heap; /* programs end where memory is exhausted */
    seed = fuzz_choice(data, size, 1u << 16);
    FUZZ_REQUIRE(scratch_make(&scratch));
    char *file = cli_format("%s/%s", scratch.path, commands[chosen].file);
    args_append(&args, cli_format("mxgen"));
    args_append(&args, cli_format("%s/in.mtlx", scratch.path));
    FUZZ_REQUIRE(!files_write(args.items[1], data, size));
    args_append(&args, cli_format("--output=%s/%s", scratch.path, commands[chosen].output));
    args_append(&args, cli_format("-q"));
    args_append(&args, cli_format("--sandbox"));
    args_append(&args, cli_format("--missing-texture=checker"));
    if (mesh)
        args_append(&args, cli_format("--mesh=%s", mesh));
    size_t num = args.len;
    args_append(&args, NULL);
    int code = commands[chosen].run((int)num, (char **)(uintptr_t)args.items);
    FUZZ_REQUIRE(code == EXIT_DONE || code == EXIT_FAULT);
    FUZZ_REQUIRE((code == EXIT_DONE) == (access(file, F_OK) == 0));
    if (code == EXIT_DONE && commands[chosen].require)
        commands[chosen].require(file);
    free(file);
    args_free(&args);
    scratch_remove(&scratch);
}
