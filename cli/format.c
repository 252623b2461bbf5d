// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen format and mxgen upgrade: write documents again, in one layout or in version 1.39. Both
 * keep comments and includes.
 */
#include "cli/commands.h"
#include "program/cli.h"
#include "program/files.h"
#include "program/output_files.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

struct format_args {
    mxg_rewriting rewriting;
    bool in_place, check;
    const char *output;
};

/* Writes the new text to its place. --check only says which files would change. */
static void write_text(struct cli *cli, const struct format_args *args, const char *path,
                       const char *old, size_t old_size, const mxg_result *result)
{
    size_t size;
    const char *text = mxg_result_text(result, &size);
    bool is_equal = size == old_size && memcmp(text, old, size) == 0;
    const char *place = args->in_place ? path : args->output;
    if (args->check) {
        if (!is_equal)
            report_error(&cli->report, "would-change", "'%s' would change", path);
        return;
    }
    if (!place) {
        fwrite(text, 1, size, stdout);
        return;
    }
    const char *reason = !args->in_place ? files_write(place, text, size)
                         : is_equal      ? NULL
                                         : files_replace(place, text, size);
    if (reason)
        report_error(&cli->report, "output-failed", "cannot write '%s': %s", place, reason);
}

static void rewrite(struct cli *cli, const struct format_args *args, const char *path)
{
    bool is_stdin = strcmp(path, "-") == 0;
    const char *name = is_stdin ? CLI_STDIN_NAME : path;
    size_t size = 0;
    report_document(&cli->report);
    const char *fault =
        cli->sandbox && !is_stdin ? mxg_context_file_fault(cli->context, path, path) : NULL;
    char *data = fault ? NULL : files_read(is_stdin ? "/dev/stdin" : path, &size);
    if (fault) {
        report_error(&cli->report, "file-unreadable", "cannot read '%s': %s", name, fault);
        return;
    }
    if (!data) {
        report_error(&cli->report, errno == ENOENT ? "file-missing" : "file-unreadable",
                     "cannot read '%s': %s", name, strerror(errno));
        return;
    }
    mxg_result *result = NULL;
    mxg_status status = mxg_rewrite(cli->context, args->rewriting, name, data, size, &result);
    if (result)
        report_list(&cli->report, mxg_result_diagnostics(result));
    if (report_status(&cli->report, status) && mxg_result_text(result, NULL))
        write_text(cli, args, path, data, size, result);
    mxg_result_destroy(result);
    free(data);
}

/* False after a message about options that exclude each other. */
static bool check_args(const struct format_args *args, const struct arg_list *inputs)
{
    const char *fault = NULL;
    if (args->in_place && args->output)
        fault = "--in-place and --output exclude each other";
    else if (args->check && (args->in_place || args->output))
        fault = "--check writes nothing; leave out --in-place and --output";
    else if (args->output && inputs->len > 1)
        fault = "--output takes one document; use --in-place for several";
    for (size_t i = 0; i < inputs->len && !fault; ++i)
        if (args->in_place && strcmp(inputs->items[i], "-") == 0)
            fault = "standard input has no place to write to; leave out --in-place";
    if (fault)
        fprintf(stderr, "mxgen: %s\n", fault);
    return !fault;
}

static int run(const struct command *command, mxg_rewriting rewriting, int argc, char **argv)
{
    struct format_args values = {.rewriting = rewriting};
    const struct arg args[] = {
        {"in-place", 'i', ARG_FLAG, NULL, "writes each document over its old text",
         &values.in_place},
        {"check", 0, ARG_FLAG, NULL,
         "writes nothing; the exit code is 1 if a document would change", &values.check},
        {"output", 'o', ARG_TEXT, "FILE", "output file (default: standard output)", &values.output},
    };
    struct cli cli;
    int code;
    if (cli_start(&cli, command, args, sizeof args / sizeof *args,
                  CLI_NEEDS_INPUT | CLI_LIBRARY_IS_INPUT, argc, argv, &code)) {
        bool is_possible = check_args(&values, &cli.parser.inputs);
        bool is_free = outputs_claim(&cli.parser.inputs, &cli.report, values.output);
        for (size_t i = 0; i < cli.parser.inputs.len && is_possible && is_free; ++i)
            rewrite(&cli, &values, cli.parser.inputs.items[i]);
        code = !is_possible ? EXIT_USAGE : cli.report.errors ? EXIT_FAULT : EXIT_DONE;
    }
    cli_finish(&cli);
    return code;
}

int command_format(const struct command *command, int argc, char **argv)
{
    return run(command, MXG_REWRITE_FORMAT, argc, argv);
}

int command_upgrade(const struct command *command, int argc, char **argv)
{
    return run(command, MXG_REWRITE_UPGRADE, argc, argv);
}
