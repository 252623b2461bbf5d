// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "export/export.h"

#include "export/write.h"
#include "program/cli_targets.h"
#include "program/export_options.h"
#include "program/files.h"
#include "program/json_values.h"
#include "program/scene_file.h"
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
    bool has_variants; /* of looks */
    bool (*write)(struct writing *writing, const struct flat *flat);
};

static const struct format formats[] = {
    {".gltf", "gltf_pbr", true, gltf_write},
    {".glb", "gltf_pbr", true, gltf_write_binary},
    {".usda", "UsdPreviewSurface", false, usd_write},
    {".usdz", "UsdPreviewSurface", false, usd_write_package},
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

uint32_t write_num_objects(const struct writing *writing)
{
    return writing->stage ? writing->stage->site.num_objects : writing->surface->num_objects;
}

const struct scene_object *write_object(const struct writing *writing, uint32_t index)
{
    return writing->stage ? &writing->stage->site.objects[index].object
                          : &writing->surface->objects[index];
}

struct matrix write_world(const struct writing *writing, const struct scene_object *object)
{
    static const struct matrix upright = {
        {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}}};
    const struct site *site = writing->stage ? &writing->stage->site : &writing->surface->site;
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
    const char *path; /* of the source */
    struct dressed_site stage;
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
    struct bake_surface surface = {0};
    bool has_stage = exporting->options.stage != NULL;
    struct writing writing = {.cli = cli,
                              .path = exporting->options.output,
                              .surface = has_stage ? NULL : &surface,
                              .stage = has_stage ? &exporting->stage : NULL,
                              .source = exporting->source,
                              .source_path = exporting->path,
                              .outputs = &exporting->baking.files};
    struct flat flat = {.report = &cli->report,
                        .path = path,
                        .source = exporting->source,
                        .source_path = writing.source_path};
    bool good = has_stage || open_surface(exporting, &surface);
    good = flat_read(&flat, document, exporting->format->model) && good
           && exporting->format->write(&writing, &flat);
    good = batch_end(&writing.files, &cli->report, good && !cli->report.errors);
    if (good && !cli->quiet)
        fprintf(stderr, "note: '%s' has %zu material%s\n", writing.path, flat.num_materials,
                flat.num_materials == 1 ? "" : "s");
    flat_finish(&flat);
    bake_surface_close(&surface);
}

/* ---- The run: what the formats lack ---- */

/* Tells an input of a material, "Wall/displacementshader", as a loss. */
static void tell_other_input(struct exporting *exporting, const char *input)
{
    struct report *report = &exporting->baking.cli.report;
    const struct flat of = {
        .report = report, .source = exporting->source, .source_path = exporting->path};
    char *place = flat_place(&of, input);
    report_warning(report, "export-loss",
                   "'%s' (%s) is not in the file as it is: a material of this format has one "
                   "surface",
                   input, place);
    free(place);
}

/* Tells a material without a surface, which is not in the file. */
static void tell_bare(struct exporting *exporting, const mxg_document *from, mxg_element node)
{
    bool is_material = strcmp(bake_element(from, node).type, "material") == 0;
    mxg_element port = is_material ? mxg_document_find_element(from, node, "surfaceshader") : 0;
    if (!is_material || (port && bake_follow(from, port).node))
        return;
    struct report *report = &exporting->baking.cli.report;
    const struct flat of = {
        .report = report, .source = exporting->source, .source_path = exporting->path};
    char *path = bake_path(from, node), *place = flat_place(&of, path);
    report_warning(report, "export-loss", "'%s' (%s) is not in the file: it has no surface", path,
                   place);
    free(path);
    free(place);
}

/* Removes what a material has beside its surface, which it returns; 0: it has none. */
static mxg_element keep_surface(struct exporting *exporting, const mxg_document *from,
                                mxg_element material, mxg_edit *edit)
{
    mxg_element surface = 0;
    for (mxg_element input = bake_element(from, material).first_child; input;) {
        mxg_element_info info = bake_element(from, input);
        if (strcmp(info.name, "surfaceshader") == 0) {
            surface = bake_follow(from, input).node;
        } else if (strcmp(info.category, "input") == 0) {
            char *path = bake_path(from, input);
            tell_other_input(exporting, path);
            mxg_edit_remove_element(edit, input);
            free(path);
        }
        input = info.next;
    }
    return surface;
}

/* True for an element of the file: every one or --element, or of a stage what its objects have. */
static bool is_wanted(const struct exporting *exporting, const char *path)
{
    const char *element = exporting->options.bake.element;
    return exporting->options.stage ? names_find(&exporting->stage.worn, path) != NULL
                                    : !element || strcmp(element, path) == 0;
}

static void tell_all_bare(struct exporting *exporting, const mxg_document *from)
{
    const char *element = exporting->options.bake.element;
    uint32_t num = element ? 1 : mxg_document_num_renderables(from);
    for (uint32_t i = 0; i < num; ++i) {
        mxg_renderable renderable = {.size = sizeof renderable, .path = element};
        if (!element)
            mxg_document_renderable(from, i, &renderable);
        mxg_element node = mxg_document_find_element(from, 0, renderable.path);
        if (node && is_wanted(exporting, renderable.path))
            tell_bare(exporting, from, node);
    }
}

/*
 * Removes what would be baked and is not in the file: looks, other shaders, and of a stage
 * materials that no object has, with their surfaces.
 */
static void remove_others(struct exporting *exporting, const mxg_document *from, mxg_edit *edit)
{
    struct name_table kept = {0};
    bool is_new;
    const mxg_element first = bake_element(from, 0).first_child;
    for (mxg_element node = first; node; node = bake_element(from, node).next) {
        mxg_element_info info = bake_element(from, node);
        if (strcmp(info.type, "material") == 0 && is_wanted(exporting, info.name)) {
            mxg_element surface = keep_surface(exporting, from, node, edit);
            names_add(&kept, info.name, &is_new);
            if (surface)
                names_add(&kept, bake_element(from, surface).name, &is_new);
            else
                mxg_edit_remove_element(edit, node);
        }
    }
    for (mxg_element node = first; node; node = bake_element(from, node).next) {
        mxg_element_info info = bake_element(from, node);
        bool may_stay = !exporting->options.stage && strcmp(info.type, "displacementshader") != 0,
             is_shader = strstr(info.type, "shader") || strcmp(info.type, "material") == 0;
        if ((is_shader && !may_stay && !names_find(&kept, info.name))
            || bake_is_of_look(from, node))
            mxg_edit_remove_element(edit, node);
    }
    names_finish(&kept);
}

/* The document with the surfaces of the file alone. NULL after reporting an error. */
static mxg_document *keep_surfaces(struct exporting *exporting, const mxg_document *from)
{
    struct cli *cli = &exporting->baking.cli;
    mxg_document *kept = NULL;
    mxg_edit *edit = NULL;
    mxg_status status = mxg_edit_create(cli->context, cli->library, from, NULL, &edit);
    if (status == MXG_OK) {
        remove_others(exporting, from, edit);
        status = mxg_edit_commit(edit, &kept);
    }
    mxg_edit_destroy(edit);
    report_status(&cli->report, status);
    return kept;
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
    baking->has_plain_tile = true; /* no format here has sets */
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
    const struct export_options *options = &exporting->options;
    size_t num = cli->parser.inputs.len;
    if (num > 1 || (!num && !options->stage) || (options->look && !options->stage) || !output) {
        fputs("usage: mxgen export FILE -o FILE.glb\n"
              "       mxgen export [FILE] --stage STAGE [--look LOOK] -o FILE.glb\n",
              stderr);
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

/* The document, with the materials of the stage. NULL after reporting an error. */
static mxg_document *load(struct exporting *exporting)
{
    struct cli *cli = &exporting->baking.cli;
    struct dressed_site *stage = &exporting->stage;
    const struct export_options *options = &exporting->options;
    const char *path = cli->parser.inputs.len ? cli->parser.inputs.items[0] : NULL;
    mxg_document *own = path ? cli_load(cli, path) : NULL;
    if (!options->stage || (path && !own))
        return own;
    mxg_document *whole = dressed_site_open(stage, cli, options->stage)
                              ? scene_file_document(cli, own, stage->site.scene)
                              : NULL;
    bool is_bound =
        whole
        && dressed_site_bind(stage, cli, whole, options->look, exporting->format->has_variants);
    mxg_document_destroy(own);
    if (is_bound)
        return whole;
    mxg_document_destroy(whole);
    return NULL;
}

static bool is_surface(const mxg_document *source, mxg_element element)
{
    return strcmp(bake_element(source, element).type, "surfaceshader") == 0;
}

static bool is_made_of_others(const mxg_document *source, mxg_element surface)
{
    bool is = false;
    for (mxg_element input = bake_element(source, surface).first_child; input && !is;
         input = bake_element(source, input).next)
        is = is_surface(source, input);
    return is;
}

/* The document with a material for a surface, which is then no part of others alone. */
static mxg_document *dress(struct cli *cli, const mxg_document *source, const char *surface)
{
    mxg_document *dressed = NULL;
    mxg_edit *edit = NULL;
    char *name = cli_format("%s_material", surface);
    while (mxg_document_find_element(source, 0, name)) {
        char *longer = cli_format("%s_", name);
        free(name);
        name = longer;
    }
    mxg_status status = mxg_edit_create(cli->context, cli->library, source, NULL, &edit);
    if (status == MXG_OK) {
        mxg_element node = mxg_edit_find_element(edit, 0, surface),
                    material = mxg_edit_add_element(edit, 0, "surfacematerial", name, "material");
        mxg_edit_connect_input(edit, material, "surfaceshader", node, NULL);
        status = mxg_edit_commit(edit, &dressed);
    }
    mxg_edit_destroy(edit);
    free(name);
    report_status(&cli->report, status);
    return dressed;
}

/*
 * The document as surfaces of the format's model: several ones that make one are joined, except to
 * have one that --element names. NULL after reporting an error.
 */
static mxg_document *translate(struct exporting *exporting, const mxg_document *source)
{
    struct cli *cli = &exporting->baking.cli;
    const char *name = exporting->options.bake.element, *model = exporting->format->model;
    mxg_element element =
        name && !strchr(name, '/') ? mxg_document_find_element(source, 0, name) : 0;
    bool has_surface = element && is_surface(source, element),
         is_made = has_surface && is_made_of_others(source, element);
    if (!is_made)
        return translated_make(cli, source, exporting->path, model,
                               has_surface ? mxg_translate : mxg_translate_joined);
    mxg_document *translated = NULL, *dressed = dress(cli, source, name);
    if (dressed)
        translated = translated_make(cli, dressed, exporting->path, model, mxg_translate_joined);
    mxg_document_destroy(dressed);
    return translated;
}

static void run(struct exporting *exporting)
{
    struct baking *baking = &exporting->baking;
    const struct arg_list *inputs = &baking->cli.parser.inputs;
    mxg_document *source = NULL, *translated = NULL, *kept = NULL;
    exporting->path = inputs->len ? inputs->items[0] : exporting->options.stage;
    baking->options = exporting->options.bake;
    bake_begin(baking, exporting->path);
    bool is_free =
        outputs_write(&baking->files, &baking->cli.report, exporting->options.output, "--output");
    if (exporting->options.stage)
        is_free =
            outputs_read(&baking->files, &baking->cli.report, exporting->options.stage) && is_free;
    if (is_free)
        source = load(exporting);
    if (source)
        translated = translate(exporting, source);
    exporting->source = source;
    if (translated) {
        tell_all_bare(exporting, translated);
        kept = keep_surfaces(exporting, translated);
    }
    if (kept)
        bake_and_write(exporting, kept);
    mxg_document_destroy(kept);
    mxg_document_destroy(translated);
    mxg_document_destroy(source);
    dressed_site_close(&exporting->stage);
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
