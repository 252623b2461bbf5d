// SPDX-License-Identifier: Apache-2.0
/* mxgen-render: renders pictures of materials without a display. `mxgen render` starts it. */
#define _POSIX_C_SOURCE 200809L
#include "export/export.h"
#include "program/cli_targets.h"
#include "program/files.h"
#include "program/parent.h"
#include "program/scene_file.h"
#include "program/texel_reader.h"
#include "render/applies.h"
#include "render/bake.h"
#include "render/prefilter.h"
#include "render/job.h"
#include "render/means.h"
#include "render/occlusion.h"
#include "render/site_picture.h"

#include <stdlib.h>
#include <string.h>

static void print_slot(void *user_data, const char *slot, const unsigned char color[3])
{
    const struct job *job = user_data;
    if (!job->cli.quiet)
        fprintf(stderr, "slot %s: #%02x%02x%02x\n", slot, color[0], color[1], color[2]);
}

static void draw_stage(struct job *job, const mxg_document *document, const char *path)
{
    struct site_subjects subjects;
    struct image picture = {0};
    const char *show = job_shows_slots(job) ? job->options.show : NULL;
    job->painter.wants_aovs = show || job_writes_channels(job);
    mxg_bindings_desc desc = MXG_BINDINGS_DESC_INIT;
    desc.look = job->options.look;
    desc.solo = job->options.solo.items;
    desc.num_solo = job->options.solo.len;
    desc.mute = job->options.mute.items;
    desc.num_mute = job->options.mute.len;
    if (site_subjects_make(&job->painter, &job->site, document, path, &desc, &subjects)
        && picture_draw(&job->painter, subjects.items, subjects.len, &picture)) {
        if (show)
            aovs_show(&job->painter.aovs, strcmp(show, "weights") == 0, &picture, print_slot, job);
        picture_write(&job->painter, job->options.output, &picture);
        if (job->options.copy)
            picture_write(&job->painter, job->options.copy, &picture);
    }
    image_finish(&picture);
    site_subjects_finish(&subjects);
}

/* Renders the stage. `path` is the document of the look; NULL: the stage brings all. */
static void render_stage(struct job *job, const char *path)
{
    mxg_document *own = path ? job_load(job, path) : NULL, *document = NULL;
    if ((!path || own) && job_prepare(job))
        document = scene_file_document(&job->cli, own, job->site.scene);
    if (document)
        draw_stage(job, document, path ? path : job->options.stage);
    mxg_document_destroy(document);
    mxg_document_destroy(own);
}

/* mxgen render --bake-environment FILE -o FOLDER */
static int bake(struct job *job)
{
    struct studio_fault fault;
    struct baked baked = {0};
    struct image map = {0};
    char reason[256] = "out of memory";
    struct studio studio = {.environment =
                                strcmp(job->options.baked, "sky") == 0 ? NULL : job->options.baked};
    if (!job->options.output) {
        fputs("usage: mxgen render --bake-environment FILE -o FOLDER\n", stderr);
        return EXIT_USAGE;
    }
    const char *why = NULL;
    if (!studio_read_map(&studio, &map, &fault))
        report_error(&job->cli.report, fault.id, "%s", fault.text);
    else if (!bake_environment(&map, &baked))
        report_status(&job->cli.report, MXG_ERROR_MEMORY);
    else if ((why = files_make_folder(job->options.output)) != NULL
             || !baked_write(&baked, job->options.output, reason, sizeof reason))
        report_error(&job->cli.report, "output-failed", "cannot write to '%s': %s",
                     job->options.output, why ? why : reason);
    job_tell_bad_environment(job, job->options.baked, &map);
    baked_finish(&baked);
    image_finish(&map);
    return job->cli.report.errors ? EXIT_FAULT : EXIT_DONE;
}

/* mxgen render --stage FILE --bake-occlusion FILE.usda */
static int bake_occlusion(struct job *job)
{
    enum { RAYS = 64 };
    struct report *report = &job->cli.report;
    struct outputs outputs = {0};
    bool is_free = outputs_read(&outputs, report, job->options.stage)
                   && outputs_write(&outputs, report, job->options.occlusion, "--bake-occlusion");
    if (is_free && site_open(&job->site, &job->cli, job->options.stage, job->options.purpose))
        occlusion_bake(&job->site,
                       args_is_given(&job->cli.parser, "paths") ? job->options.paths : RAYS,
                       job->options.occlusion);
    site_close(&job->site);
    outputs_finish(&outputs);
    return report->errors ? EXIT_FAULT : EXIT_DONE;
}

/* mxgen render --stage FILE --list */
static int list_stage(struct job *job)
{
    if (!job->options.stage) {
        fputs("usage: mxgen render --stage FILE --list\n", stderr);
        return EXIT_USAGE;
    }
    if (site_open(&job->site, &job->cli, job->options.stage, job->options.purpose))
        site_list(&job->site);
    site_close(&job->site);
    return job->cli.report.errors ? EXIT_FAULT : EXIT_DONE;
}

static int run(struct job *job)
{
    const struct arg_list *inputs = &job->cli.parser.inputs;
    static const char *const of_environment[] = {"bake-environment", "output", NULL},
                             *const of_occlusion[] = {"bake-occlusion", "stage", "purpose", "paths",
                                                      NULL};
    if (job->options.baked && inputs->len == 0)
        return applies_alone(&job->cli.parser, of_environment) ? bake(job) : EXIT_USAGE;
    if (job->options.occlusion && job->options.stage && inputs->len == 0)
        return applies_alone(&job->cli.parser, of_occlusion) ? bake_occlusion(job) : EXIT_USAGE;
    if (job->options.occlusion) {
        fputs("usage: mxgen render --stage FILE --bake-occlusion FILE.usda\n", stderr);
        return EXIT_USAGE;
    }
    if (job->options.baked || (inputs->len == 0 && !job->options.stage)) {
        fputs(job->options.baked ? "usage: mxgen render --bake-environment FILE -o FOLDER\n"
                                 : "usage: mxgen render FILE|FOLDER... -o PICTURE.png\n",
              stderr);
        return EXIT_USAGE;
    }
    if (job->options.list)
        return list_stage(job);
    bool is_grid = !strcmp(job->options.scene, "grid"),
         is_one = job->options.stage ? inputs->len < 2
                                     : inputs->len == 1 && !files_is_folder(inputs->items[0])
                                           && !job->options.look;
    if (!job->options.output && !is_grid) {
        fputs("mxgen: where to? say -o PICTURE.png\n", stderr);
        return EXIT_USAGE;
    }
    if (!job->options.size)
        job->options.size = is_grid ? "4" : is_one ? "512" : "160";
    if (!cli_options_apply(&job->cli, (const char *const[]){"vulkan"}, 1) || !job_parse(job)
        || !applies_all(&job->cli.parser, job_find_facts(job, is_grid, is_one)))
        return EXIT_USAGE;
    if (job_claim_files(job)) {
        compile_begin();
        if (job->options.stage)
            render_stage(job, job->found.len ? job->found.items[0] : NULL);
        else if (is_one)
            job_render_file(job, job->found.items[0]);
        else
            job_render_all(job);
        compile_end();
        gpu_close(&job->painter.gpu);
        mesh_finish(&job->painter.fine);
        scene_finish(&job->painter.scene);
        site_close(&job->site);
    }
    return job->cli.report.errors ? EXIT_FAULT : EXIT_DONE;
}

int main(int argc, char **argv)
{
    static const struct command command = {
        "render", "render FILE|FOLDER... -o PICTURE.png [options]",
        "Renders materials without a display: one picture, or a sheet of several.", NULL};
    struct job job = {.options = RENDER_OPTIONS_DEFAULTS, .painter.studio = STUDIO_DEFAULTS};
    struct arg args[MAX_RENDER_ARGS];
    size_t num_args = render_args(&job.options, args);
    int code;
    parent_follow();
    if (strcmp(argv[0], "bake") == 0)
        return bake_main(argc, argv);
    if (strcmp(argv[0], "export") == 0)
        return export_main(argc, argv);
    if (argc == 5 && strcmp(argv[1], CLI_TEXELS) == 0)
        return means_print(argv[2], argv[3], (uint32_t)strtoul(argv[4], NULL, 10));
    if (cli_start(&job.cli, &command, args, num_args, CLI_GENERATES, argc, argv, &code)) {
        job.painter.cli = &job.cli;
        job.painter.files = &job.files;
        job.painter.studio.mesh = job.options.mesh;
        job.painter.studio.cli = &job.cli;
        /*
         * llvmpipe's optimiser takes minutes for large shaders. Without it the pictures are the
         * same after seconds.
         */
        if (!job.options.path_trace)
            setenv("GALLIVM_PERF", "nopt", 0);
        code = run(&job);
    }
    cli_finish(&job.cli);
    args_free(&job.found);
    names_finish(&job.painter.told_textures);
    aovs_finish(&job.painter.aovs);
    outputs_finish(&job.files);
    job_free_values(job.values, job.options.settings.len);
    free(job.options.settings.items);
    free(job.options.environments.items);
    free(job.options.solo.items);
    free(job.options.mute.items);
    return code;
}
