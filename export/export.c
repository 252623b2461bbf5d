// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "export/export.h"

#include "export/write.h"
#include "program/export_options.h"
#include "program/files.h"
#include "program/json.h"
#include "program/scratch.h"
#include "program/translated.h"
#include "render/bake.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* A format, by the ending of its files. */
struct format {
    const char *ending, *model;
    bool (*write)(struct writing *writing, const struct flat *flat);
};

static const struct format formats[] = {
    {".gltf", "gltf_pbr", gltf_write},
    {".glb", "gltf_pbr", gltf_write_binary},
    {".usda", "UsdPreviewSurface", usd_write},
    {".usdz", "UsdPreviewSurface", usd_write_package},
};

static const struct format *find_format(const char *path)
{
    const char *ending = strrchr(files_base_name(path), '.');
    for (size_t i = 0; ending && i < sizeof formats / sizeof *formats; ++i)
        if (strcasecmp(ending, formats[i].ending) == 0)
            return &formats[i];
    return NULL;
}

/* ---- Files ---- */

char *write_folder(const char *path)
{
    size_t len = (size_t)(files_base_name(path) - path);
    return len ? cli_copy(path, len) : cli_format(".");
}

char *write_stem(const struct writing *writing)
{
    const char *base = files_base_name(writing->path), *dot = strrchr(base, '.');
    return cli_copy(base, dot ? (size_t)(dot - base) : strlen(base));
}

bool write_beside(struct writing *writing, const char *name, const void *data, size_t size)
{
    char *path = cli_beside(writing->path, name);
    bool is_free =
        strcmp(path, writing->path) == 0
        || outputs_write(writing->outputs, &writing->cli->report, path, "a file beside it");
    const char *reason = is_free ? batch_write(&writing->files, path, data, size) : NULL;
    if (reason)
        report_error(&writing->cli->report, "output-failed", "cannot write '%s': %s", path, reason);
    free(path);
    return is_free && !reason;
}

struct matrix write_world(const struct writing *writing, const struct scene_object *object)
{
    static const struct matrix upright = {
        {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}}};
    const struct site *site = &writing->surface->site;
    const double unit = site->meters_per_unit > 0 ? site->meters_per_unit : 1;
    struct matrix world = matrix_multiply(matrix_scale(unit, unit, unit), object->world);
    return site->is_z_up ? matrix_multiply(upright, world) : world;
}

/* ---- The run ---- */

struct exporting {
    struct baking baking;
    struct export_options options;
    const struct format *format;
    struct scratch scratch; /* of the flat document */
    const mxg_document *source;
};

/* Formats lack objects to look at without a mesh. */
static bool open_surface(struct exporting *exporting, struct bake_surface *surface)
{
    const char *mesh = exporting->options.bake.mesh;
    return bake_surface_open(surface, &exporting->baking.cli, mesh ? mesh : "sphere");
}

/* Writes the flat document to the files of the format. */
static void write_files(struct exporting *exporting, const mxg_document *document, const char *path)
{
    struct cli *cli = &exporting->baking.cli;
    struct bake_surface surface;
    struct writing writing = {.cli = cli,
                              .path = exporting->options.output,
                              .scratch = exporting->scratch.path,
                              .surface = &surface,
                              .source = exporting->source,
                              .source_path = cli->parser.inputs.items[0],
                              .outputs = &exporting->baking.files};
    struct flat flat = {.report = &cli->report,
                        .path = path,
                        .source = exporting->source,
                        .source_path = writing.source_path};
    bool good = open_surface(exporting, &surface);
    good = flat_read(&flat, document, exporting->format->model) && good
           && exporting->format->write(&writing, &flat);
    good = batch_end(&writing.files, &cli->report, good && !cli->report.errors);
    if (good && !cli->quiet)
        fprintf(stderr, "note: '%s' has %zu material%s\n", writing.path, flat.num_materials,
                flat.num_materials == 1 ? "" : "s");
    flat_finish(&flat);
    bake_surface_close(&surface);
}

/* Bakes the translated document into a folder of its own, and writes what is there. */
static void bake_and_write(struct exporting *exporting, const mxg_document *translated)
{
    struct baking *baking = &exporting->baking;
    if (!scratch_make(&exporting->scratch)) {
        report_error(&baking->cli.report, "output-failed", "there is no folder for images: %s",
                     strerror(errno));
        return;
    }
    baking->source = exporting->source;
    baking->spaces = flat_spaces;
    baking->keeps_places = true;
    baking->draws_missing = baking->painter.checker;
    baking->options = exporting->options.bake;
    baking->options.output = exporting->scratch.path;
    baking->options.format = "exr"; /* the writer rounds, and once is enough */
    baking->options.depth = 32;
    char *path = bake_document_name(baking);
    mxg_document *flat = bake_document(baking, translated) ? cli_load(&baking->cli, path) : NULL;
    if (flat)
        write_files(exporting, flat, path);
    mxg_document_destroy(flat);
    scratch_remove(&exporting->scratch);
    free(path);
}

static bool parse(struct exporting *exporting)
{
    static const char *const missing[] = {"error", "checker", NULL};
    struct cli *cli = &exporting->baking.cli;
    const char *output = exporting->options.output;
    if (cli->parser.inputs.len != 1 || !output) {
        fputs("usage: mxgen export FILE -o FILE.glb\n", stderr);
        return false;
    }
    exporting->format = find_format(output);
    if (!exporting->format)
        fprintf(stderr, "mxgen: '%s' ends in none of .gltf, .glb, .usda and .usdz\n", output);
    if (!args_is_one_of(exporting->options.bake.missing_texture, missing))
        fprintf(stderr, "mxgen: '%s' is not a value of --missing-texture\n",
                exporting->options.bake.missing_texture);
    return exporting->format && args_is_one_of(exporting->options.bake.missing_texture, missing)
           && cli_options_apply(cli, (const char *const[]){"vulkan"}, 1);
}

static void run(struct exporting *exporting)
{
    struct baking *baking = &exporting->baking;
    const char *path = baking->cli.parser.inputs.items[0];
    mxg_document *source = NULL, *translated = NULL;
    baking->options = exporting->options.bake;
    bake_begin(baking, path);
    if (outputs_write(&baking->files, &baking->cli.report, exporting->options.output, "--output"))
        source = cli_load(&baking->cli, path);
    if (source)
        translated = translated_make(&baking->cli, source, path, exporting->format->model);
    exporting->source = source;
    if (translated)
        bake_and_write(exporting, translated);
    mxg_document_destroy(translated);
    mxg_document_destroy(source);
    bake_finish(baking);
}

int export_main(int argc, char **argv)
{
    static const struct command command = {
        "export", "export FILE -o FILE.glb|.gltf|.usda|.usdz [--mesh FILE] [options]",
        "Writes materials in a format of other programs, with images of what varies.", NULL};
    struct exporting exporting = {.options = EXPORT_OPTIONS_DEFAULTS};
    struct arg args[MAX_EXPORT_ARGS];
    int code;
    json_use_memory();
    if (cli_start(&exporting.baking.cli, &command, args, export_args(&exporting.options, args),
                  CLI_GENERATES | CLI_KEEPS_INPUTS, argc, argv, &code)) {
        bool is_possible = parse(&exporting);
        if (is_possible)
            run(&exporting);
        code = !is_possible                         ? EXIT_USAGE
               : exporting.baking.cli.report.errors ? EXIT_FAULT
                                                    : EXIT_DONE;
    }
    cli_finish(&exporting.baking.cli);
    return code;
}
