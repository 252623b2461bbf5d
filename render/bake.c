// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "render/bake.h"

#include "compile/compile.h"
#include "program/cli_targets.h"
#include "program/file_name.h"
#include "program/files.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- Options ---- */

static bool check_word(const char *option, const char *word, const char *const *words)
{
    bool is_known = args_is_one_of(word, words);
    if (!is_known)
        fprintf(stderr, "mxgen: '%s' is not a value of --%s\n", word, option);
    return is_known;
}

static const char *setting(const struct cli *cli, const char *key, const char *otherwise)
{
    for (size_t i = 0; i < cli->parser.num_settings; ++i)
        if (strcmp(cli->parser.settings[i].key, key) == 0)
            otherwise = cli->parser.settings[i].value;
    return otherwise;
}

/* False after a message, if the format that is asked for does not have the depth. */
static bool check_depth(const struct bake_options *options)
{
    static const struct {
        const char *format, *text; /* format NULL: by content */
        size_t depths[3];
    } rows[] = {{"png", "png has 8 or 16 bits", {8, 16}},
                {"exr", "exr has 16 or 32 bits", {16, 32}},
                {"jpg", "jpg has 8 bits", {8}},
                {NULL, "an image has 8, 16 or 32 bits", {8, 16, 32}}};
    size_t row = 0;
    while (rows[row].format && (!options->format || strcmp(rows[row].format, options->format) != 0))
        ++row;
    bool is_known = !options->depth;
    for (size_t i = 0; i < 3; ++i)
        is_known = is_known || rows[row].depths[i] == options->depth;
    if (!is_known)
        fprintf(stderr, "mxgen: %s, and not %zu\n", rows[row].text, options->depth);
    return is_known;
}

/* false after a message. */
static bool parse(struct baking *baking)
{
    static const char *const formats[] = {"png", "exr", "jpg", NULL}, *const missing[] = {
                                                                          "error", "checker", NULL};
    struct bake_options *options = &baking->options;
    struct cli *cli = &baking->cli;
    bool is_one = cli->parser.inputs.len == 1 && options->output;
    if (!is_one || (options->element && files_is_folder(cli->parser.inputs.items[0]))) {
        fputs("usage: mxgen bake FILE|FOLDER -o DIR; --element is for a file\n", stderr);
        return false;
    }
    return (!options->format || check_word("format", options->format, formats))
           && check_word("missing-texture", options->missing_texture, missing)
           && check_depth(options) && cli_options_apply(cli, (const char *const[]){"vulkan"}, 1);
}

void bake_begin(struct baking *baking, const char *path)
{
    struct cli *cli = &baking->cli;
    baking->path = path;
    baking->errors_before = cli->report.errors;
    baking->space = setting(cli, "colorspace", "lin_rec709");
    baking->is_709 = strcmp(baking->space, "lin_rec709") == 0;
    baking->painter.checker = strcmp(baking->options.missing_texture, "checker") == 0;
    mxg_options_set(cli->options, "interface", "reduced");
    mxg_options_set(cli->options, "texture-modes", "shared");
    mxg_options_set(cli->options, "max-outputs", "64");
}

/* ---- The plan ---- */

/* True if the element can be generated; reports what its document does wrong. */
static bool check(struct baking *baking, const char *path)
{
    mxg_result *result = bake_generate(baking, path, true);
    mxg_result_destroy(result);
    return result != NULL;
}

static bool plan(struct baking *baking)
{
    const char *element = baking->options.element;
    uint32_t num = element ? 1 : mxg_document_num_renderables(baking->document);
    bool good = true;
    bake_plan_begin(&baking->plan, baking->document, &baking->cli.report);
    baking->plan.spaces = baking->spaces;
    baking->plan.keeps_places = baking->keeps_places;
    baking->plan.drawn_missing = baking->draws_missing ? baking->path : NULL;
    if (!num)
        report_error(&baking->cli.report, "nothing-to-bake", "'%s' has no material", baking->path);
    for (uint32_t i = 0; good && i < num; ++i) {
        mxg_renderable renderable = {sizeof renderable};
        if (!element)
            mxg_document_renderable(baking->document, i, &renderable);
        const char *path = element ? element : renderable.path;
        good = check(baking, path) && bake_plan_add(&baking->plan, path);
    }
    for (size_t i = 0; good && i < baking->plan.num_drawings; ++i)
        good = bake_find_needs(baking, &baking->plan.drawings[i]);
    return good && num;
}

/* ---- Files ---- */

char *bake_document_name(const struct baking *baking)
{
    const char *base = strcmp(baking->path, "-") == 0 ? "stdin" : files_base_name(baking->path);
    size_t len = strlen(base);
    if (len > 5 && strcmp(base + len - 5, ".mtlx") == 0)
        len -= 5;
    char *name = cli_format("%.*s.mtlx", (int)len, base), *clean = file_name_clean(name),
         *path = cli_format("%s/%s", baking->options.output, clean);
    free(name);
    free(clean);
    return path;
}

static bool write_document(struct baking *baking, const char *path)
{
    size_t size = 0;
    char *text = bake_write_document(baking, &size);
    const char *reason = text ? batch_write(&baking->written, path, text, size) : NULL;
    if (reason)
        report_error(&baking->cli.report, "output-failed", "cannot write '%s': %s", path, reason);
    free(text);
    return text && !reason;
}

static bool claim(struct baking *baking, const char *output)
{
    struct report *report = &baking->cli.report;
    const mxg_document *from = baking->source ? baking->source : baking->document;
    bool good = true;
    for (uint32_t i = 0; i < mxg_document_num_files(from); ++i)
        good = outputs_read(&baking->files, report, mxg_document_file(from, i)) && good;
    for (uint32_t i = 0; i < mxg_library_num_files(baking->cli.library); ++i)
        good =
            outputs_read(&baking->files, report, mxg_library_file(baking->cli.library, i)) && good;
    if (baking->options.mesh && files_is_regular(baking->options.mesh))
        good = outputs_read(&baking->files, report, baking->options.mesh) && good;
    return outputs_write(&baking->files, report, output, "the baked document") && good;
}

/* ---- The run ---- */

static void tell(const struct baking *baking)
{
    size_t values = 0;
    for (size_t i = 0; i < baking->plan.num_drawings; ++i)
        values += baking->plan.drawings[i].is_value;
    if (!baking->cli.quiet)
        fprintf(stderr,
                "note: of %zu graphs of inputs of '%s', %zu are images (%zu file%s) and %zu "
                "values\n",
                baking->plan.num_drawings, baking->path, baking->plan.num_drawings - values,
                baking->num_images, baking->num_images == 1 ? "" : "s", values);
}

static bool open_device(struct baking *baking)
{
    struct painter *painter = &baking->painter;
    painter->cli = &baking->cli;
    painter->files = &baking->files;
    painter->scene = baking->surface.square;
    painter->scene.frame = (int32_t)baking->options.frame;
    painter->unwraps = true;
    painter->shown = UINT32_MAX;
    if (!baking->plan.num_drawings || gpu_open(&painter->gpu))
        return true;
    report_error(&baking->cli.report, painter->gpu.id, "cannot draw: %s", painter->gpu.reason);
    return false;
}

bool bake_document(struct baking *baking, const mxg_document *document)
{
    const char *reason = NULL;
    char *output = bake_document_name(baking);
    bool is_new = access(baking->options.output, F_OK) != 0, good;
    baking->document = document;
    good = claim(baking, output)
           && bake_surface_open(&baking->surface, &baking->cli, baking->options.mesh)
           && plan(baking);
    reason = good ? files_make_folder(baking->options.output) : NULL;
    if (reason)
        report_error(&baking->cli.report, "output-failed", "cannot write to '%s': %s",
                     baking->options.output, reason);
    compile_begin();
    good = good && !reason && bake_keep_files(baking) && open_device(baking) && bake_draw(baking)
           && write_document(baking, output);
    compile_end();
    good = batch_end(&baking->written, &baking->cli.report,
                     good && baking->cli.report.errors == baking->errors_before);
    if (good)
        tell(baking);
    else if (is_new)
        rmdir(baking->options.output);
    free(output);
    return good;
}

void bake_finish(struct baking *baking)
{
    bake_plan_finish(&baking->plan);
    bake_surface_close(&baking->surface);
    gpu_close(&baking->painter.gpu);
    names_finish(&baking->painter.told_textures);
    aovs_finish(&baking->painter.aovs);
    outputs_finish(&baking->files);
}

static void bake_one(struct baking *baking, const char *path)
{
    bake_begin(baking, path);
    mxg_document *document = cli_load(&baking->cli, path);
    if (document)
        bake_document(baking, document);
    bake_finish(baking);
    mxg_document_destroy(document);
}

int bake_main(int argc, char **argv)
{
    static const struct command command = {
        "bake", "bake FILE|FOLDER -o DIR [--mesh FILE] [options]",
        "Bakes what varies over the surface of a material into images, with a flat document.",
        NULL};
    struct baking baking = {.options = BAKE_OPTIONS_DEFAULTS};
    struct arg args[MAX_BAKE_ARGS];
    int code;
    if (cli_start(&baking.cli, &command, args, bake_args(&baking.options, args),
                  CLI_GENERATES | CLI_KEEPS_INPUTS, argc, argv, &code)) {
        code = EXIT_USAGE;
        if (parse(&baking)) {
            const char *path = baking.cli.parser.inputs.items[0];
            if (files_is_folder(path))
                bake_folder(&baking, path);
            else
                bake_one(&baking, path);
            code = baking.cli.report.errors ? EXIT_FAULT : EXIT_DONE;
        }
    }
    cli_finish(&baking.cli);
    return code;
}
