// SPDX-License-Identifier: Apache-2.0
/* mxgen translate: a document with its surfaces as another shading model. */
#define _POSIX_C_SOURCE 200809L
#include "cli/commands.h"
#include "program/files.h"
#include "program/output_files.h"
#include "program/relocate.h"
#include "program/scratch.h"
#include "program/translated.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct translate_args {
    const char *model, *output, *accept;
    bool is_drawn;
    double limit; /* of `accept`; below 0: there is none */
};

/* ---- Pictures ---- */

/* Draws each renderable before and after, and tells the difference. */
static void tell_drawn(struct cli *cli, const struct translate_args *args, const char *path,
                       const mxg_document *document)
{
    struct scratch scratch;
    bool good = scratch_make(&scratch);
    for (uint32_t i = 0; good && i < mxg_document_num_renderables(document); ++i) {
        mxg_renderable renderable = {.size = sizeof renderable};
        mxg_document_renderable(document, i, &renderable);
        char *fault = NULL;
        double error =
            translated_difference(cli, path, renderable.path, args->model, scratch.path, &fault);
        if (error < 0)
            report_error(&cli->report, "no-picture", "there is no drawn error of '%s': %s",
                         renderable.path, fault);
        else if (args->limit >= 0 && error > args->limit)
            report_error(&cli->report, "translation-error",
                         "'%s' as '%s' looks different by %.3g, which is more than %g (mean "
                         "CIEDE2000 of three views)",
                         renderable.path, args->model, error, args->limit);
        else
            fprintf(stderr, "%s: drawn error %.3g\n", renderable.path, error);
        free(fault);
    }
    if (!good)
        report_error(&cli->report, "no-picture", "there are no drawn errors: %s", strerror(errno));
    scratch_remove(&scratch);
}

/* ---- The document ---- */

static void write_text(struct cli *cli, const char *output, const char *text, size_t size)
{
    const char *reason = output ? files_write(output, text, size) : NULL;
    if (!output)
        fwrite(text, 1, size, stdout);
    if (reason)
        report_error(&cli->report, "output-failed", "cannot write '%s': %s", output, reason);
}

/* Writes the new document for the folder of the output. */
static void write_document(struct cli *cli, const struct translate_args *args, const char *path,
                           const mxg_result *result)
{
    size_t size;
    const char *text = mxg_result_text(result, &size);
    mxg_document *document = NULL;
    if (!args->output) {
        write_text(cli, NULL, text, size);
        return;
    }
    mxg_status status = mxg_document_parse(cli->context, cli->library, path, text, size, &document);
    if (report_status(&cli->report, status))
        document = relocate(cli, document, path, args->output);
    text = document ? mxg_document_xml(document, &size) : NULL;
    if (text)
        write_text(cli, args->output, text, size);
    mxg_document_destroy(document);
}

static void translate(struct cli *cli, const struct translate_args *args, const char *path)
{
    mxg_document *document = cli_load(cli, path);
    if (!document)
        return;
    mxg_result *result = NULL;
    mxg_status status = mxg_translate(cli->context, document, args->model, &result);
    if (result)
        report_list(&cli->report, mxg_result_diagnostics(result));
    bool good = report_status(&cli->report, status) && mxg_result_text(result, NULL);
    if (good)
        write_document(cli, args, path, result);
    if (good && args->is_drawn)
        tell_drawn(cli, args, path, document);
    mxg_result_destroy(result);
    mxg_document_destroy(document);
}

/* False after a message. */
static bool check_args(struct cli *cli, struct translate_args *args)
{
    char *end = NULL;
    args->limit = args->accept ? strtod(args->accept, &end) : -1;
    args->is_drawn = args->is_drawn || args->accept;
    bool is_number = !args->accept || (*args->accept && !*end && args->limit >= 0);
    const char *fault = !args->model ? "--to names the model; see mxgen translate --help"
                        : cli->parser.inputs.len != 1 ? "translate takes one document"
                        : !is_number                  ? "--accept takes a number, at least 0"
                                                      : NULL;
    if (fault)
        fprintf(stderr, "mxgen: %s\n", fault);
    return !fault;
}

int command_translate(const struct command *command, int argc, char **argv)
{
    struct translate_args values = {0};
    const struct arg args[] = {
        {"to", 0, ARG_TEXT, "MODEL",
         "the model: standard_surface, open_pbr_surface, gltf_pbr, UsdPreviewSurface, "
         "disney_principled, or another one "
         "that a translation of a library makes",
         &values.model},
        {"drawn", 0, ARG_FLAG, NULL,
         "draws each material before and after, and prints how far the pictures differ (mean "
         "CIEDE2000 of three views)",
         &values.is_drawn},
        {"accept", 0, ARG_TEXT, "ERROR", "fails if the drawn error of a material is more",
         &values.accept},
        {"output", 'o', ARG_TEXT, "FILE", "output file (default: standard output)", &values.output},
    };
    struct cli cli;
    int code;
    if (cli_start(&cli, command, args, sizeof args / sizeof *args, CLI_NEEDS_INPUT, argc, argv,
                  &code)) {
        bool is_possible = check_args(&cli, &values);
        if (is_possible && outputs_claim(&cli.parser.inputs, &cli.report, values.output))
            translate(&cli, &values, cli.parser.inputs.items[0]);
        code = !is_possible ? EXIT_USAGE : cli.report.errors ? EXIT_FAULT : EXIT_DONE;
    }
    cli_finish(&cli);
    return code;
}
