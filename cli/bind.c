// SPDX-License-Identifier: Apache-2.0
/* mxgen bind: the layers of each primitive of a stage under a look. */
#define _POSIX_C_SOURCE 200809L
#include "cli/commands.h"
#include "program/cli.h"
#include "program/files.h"
#include "program/memory.h"
#include "program/scene_file.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct bind {
    struct cli cli;
    const char *look, *stage, *json, *usda, *geom, *purpose;
    struct arg_list solo, mute;
    bool checks;
};

/* A file that --max-output-size limits: paths of deep scenes are much longer than the scene. */
struct output {
    FILE *out;
    size_t left;
    bool is_full;
};

static struct output output_of(const struct bind *bind, FILE *out)
{
    return (struct output){out, cli_max_output_size(&bind->cli) << 20, false};
}

static bool put(void *user_data, const char *data, size_t size)
{
    struct output *output = user_data;
    output->is_full = output->is_full || size > output->left;
    output->left -= output->is_full ? 0 : size;
    return !output->is_full && fwrite(data, 1, size, output->out) == size;
}

/* False after an error: the output was larger than its limit. */
static bool was_enough(struct bind *bind, const struct output *output)
{
    if (output->is_full)
        report_error(&bind->cli.report, "output-limit",
                     "the layers have more than %zu MiB; raise the limit 'max-output-size' if this "
                     "is intended",
                     cli_max_output_size(&bind->cli));
    return !output->is_full;
}

/* Writes a file with `write`, which gives false where something is missing in it. */
static void write_file(struct bind *bind, const mxg_bindings *bindings, const char *path,
                       mxg_bindings_format format)
{
    struct files_stream stream;
    const char *reason = files_begin(&stream, path);
    if (!reason) {
        struct output output = output_of(bind, stream.out);
        mxg_status status = mxg_bindings_write(bindings, format, put, &output);
        if (status == MXG_ERROR_DOCUMENT)
            report_warning(
                &bind->cli.report, "usda-loss",
                "'%s' lacks products of weaker assignments, variants, volumes beside "
                "layers, or instances, which comments at its beginning name, or has other "
                "names: slot bindings have no place for them, and names of USD have "
                "letters, digits and '_'",
                path);
        else
            report_status(&bind->cli.report, status);
        reason = files_end(&stream, was_enough(bind, &output));
    }
    if (reason)
        report_error(&bind->cli.report, "output-failed", "cannot write '%s': %s", path, reason);
}

static void explain(struct bind *bind, const mxg_scene *scene, const mxg_bindings *bindings)
{
    struct output output = output_of(bind, stdout);
    uint32_t primitive = mxg_scene_find_primitive(scene, bind->geom);
    if (primitive == UINT32_MAX)
        scene_file_report_unknown(&bind->cli.report, scene, bind->geom);
    else
        report_status(&bind->cli.report,
                      mxg_bindings_write_reasons(bindings, primitive, put, &output));
}

/* The files for programs. */
static void write_bindings(struct bind *bind, const mxg_bindings *bindings)
{
    if (bind->json)
        write_file(bind, bindings, bind->json, MXG_BINDINGS_JSON);
    if (bind->usda)
        write_file(bind, bindings, bind->usda, MXG_BINDINGS_USDA);
}

/* Shows the bindings to people. */
static void show_bindings(struct bind *bind, const mxg_scene *scene, const mxg_bindings *bindings)
{
    mxg_bindings_format format =
        isatty(STDOUT_FILENO) ? MXG_BINDINGS_TABLE_COLOUR : MXG_BINDINGS_TABLE;
    struct output output = output_of(bind, stdout);
    if (bind->geom)
        explain(bind, scene, bindings);
    else if (!bind->json && !bind->usda)
        report_status(&bind->cli.report, mxg_bindings_write(bindings, format, put, &output));
    was_enough(bind, &output);
}

static void bind_document(struct bind *bind, const mxg_document *document, mxg_scene *scene)
{
    mxg_bindings_desc desc = MXG_BINDINGS_DESC_INIT;
    mxg_bindings *bindings = NULL;
    desc.look = bind->look;
    desc.solo = bind->solo.items;
    desc.num_solo = bind->solo.len;
    desc.mute = bind->mute.items;
    desc.num_mute = bind->mute.len;
    mxg_status status = mxg_bindings_create(bind->cli.context, document, scene, &desc, &bindings);
    if (bindings)
        report_list(&bind->cli.report, mxg_bindings_diagnostics(bindings));
    bool is_good = report_status(&bind->cli.report, status);
    if (is_good)
        write_bindings(bind, bindings);
    /* beside errors, the layers that are left help to find their cause */
    if (is_good || (bindings && mxg_bindings_num_resolved_primitives(bindings) > 0))
        show_bindings(bind, scene, bindings);
    mxg_bindings_destroy(bindings);
}

/* The document, which may be missing, with the materials of the stage that it lacks. */
static mxg_document *load(struct bind *bind, const char *path, const mxg_scene *scene)
{
    mxg_document *own = path ? cli_load(&bind->cli, path) : NULL;
    if (path && !own)
        return NULL;
    mxg_document *whole = scene_file_document(&bind->cli, own, scene);
    mxg_document_destroy(own);
    return whole;
}

/* Tells the faults of materials, masks and graphs, which the layers do not depend on. */
static void check(struct bind *bind, const mxg_document *document)
{
    mxg_result *result = NULL;
    mxg_validate(bind->cli.context, document, &result);
    report_list(&bind->cli.report, mxg_result_diagnostics(result));
    mxg_result_destroy(result);
}

static void bind_file(struct bind *bind, const char *path)
{
    mxg_document *document = NULL;
    mxg_scene *scene = scene_file_load(&bind->cli, bind->stage, bind->purpose);
    if (scene && (document = load(bind, path, scene)) != NULL)
        bind_document(bind, document, scene);
    if (document && bind->checks)
        check(bind, document);
    mxg_scene_destroy(scene);
    mxg_document_destroy(document);
}

int command_bind(const struct command *command, int argc, char **argv)
{
    struct bind bind = {0};
    const struct arg args[] = {
        {"look", 0, ARG_TEXT, "LOOK", "a look, or a look group with a default", &bind.look},
        {"stage", 0, ARG_TEXT, "FILE",
         "the primitives: a list of paths (.txt), a file of USD, glTF, OBJ, ...", &bind.stage},
        {"purpose", 0, ARG_TEXT, "full|preview",
         "also takes the bindings of the stage for this purpose", &bind.purpose},
        {"json", 0, ARG_TEXT, "FILE", "writes the layers of all primitives as JSON; '-': prints it",
         &bind.json},
        {"usda", 0, ARG_TEXT, "FILE",
         "writes a layer of USD with slot bindings, over the stage; '-': prints it", &bind.usda},
        {"geom", 0, ARG_TEXT, "PATH", "explains the layers of one primitive", &bind.geom},
        {"solo", 0, ARG_LIST, "SLOT", "shows only this slot, layer or override", &bind.solo},
        {"mute", 0, ARG_LIST, "SLOT", "leaves out this slot, layer or override", &bind.mute},
        {"check", 0, ARG_FLAG, NULL,
         "also finds faults of materials, masks and graphs, without generating", &bind.checks},
    };
    int code;
    if (cli_start(&bind.cli, command, args, sizeof args / sizeof *args, 0, argc, argv, &code)) {
        const struct arg_list *inputs = &bind.cli.parser.inputs;
        if (!bind.stage || inputs->len > 1) {
            fprintf(stderr, "%susage: mxgen %s\n",
                    bind.stage ? "" : "mxgen bind: --stage is missing; it names the primitives\n",
                    command->usage);
            code = EXIT_USAGE;
        } else {
            bind_file(&bind, inputs->len ? inputs->items[0] : NULL);
            code = bind.cli.report.errors ? EXIT_FAULT : EXIT_DONE;
        }
    }
    cli_finish(&bind.cli);
    free(bind.solo.items);
    free(bind.mute.items);
    return code;
}
