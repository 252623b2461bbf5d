// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen library: packs libraries into images, lists and documents their definitions, expands their
 * templates.
 */
#define _POSIX_C_SOURCE 200809L
#include "cli/commands.h"
#include "program/files.h"
#include "cli/node_list.h"
#include "program/output_files.h"
#include "doc/reference.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* False after an error: the output is an input. */
static bool claim_output(struct cli *cli, const char *path)
{
    struct outputs outputs = {0};
    bool good = true;
    for (size_t i = 1; i < cli->parser.inputs.len; ++i)
        good = outputs_read(&outputs, &cli->report, cli->parser.inputs.items[i]) && good;
    for (uint32_t i = 0; i < mxg_library_num_files(cli->library); ++i)
        good = outputs_read(&outputs, &cli->report, mxg_library_file(cli->library, i)) && good;
    good = good && outputs_write(&outputs, &cli->report, path, "-o");
    outputs_finish(&outputs);
    return good;
}

static bool write_output(struct cli *cli, const char *path, const void *data, size_t size)
{
    if (!path) {
        fwrite(data, 1, size, stdout);
        return true;
    }
    if (!claim_output(cli, path))
        return false;
    const char *reason = files_write(path, data, size);
    if (reason)
        report_error(&cli->report, "output-failed", "cannot write '%s': %s", path, reason);
    return !reason;
}

static void pack(struct cli *cli, const struct library_args *args)
{
    const void *data;
    size_t size;
    bool is_printed = !args->output || strcmp(args->output, "-") == 0;
    if (is_printed && isatty(STDOUT_FILENO))
        report_error(&cli->report, "output-failed",
                     "cannot write an image, which is no text, to a terminal; say -o FILE");
    else if (mxg_library_image(cli->library, &data, &size) == MXG_ERROR_DOCUMENT)
        report_error(&cli->report, "broken-implementation",
                     "an image has no faulty implementations; correct those above");
    else if (report_status(&cli->report, mxg_library_image(cli->library, &data, &size)))
        write_output(cli, args->output, data, size);
}

static void expand(struct cli *cli, const struct library_args *args)
{
    size_t size;
    const mxg_diagnostics *losses = mxg_library_losses(cli->library);
    const char *text = mxg_library_xml(cli->library, &size);
    if (report_status(&cli->report, losses && text ? MXG_OK : MXG_ERROR_MEMORY)
        && write_output(cli, args->output, text, size))
        report_list(&cli->report, losses);
}

/* A word is neither a file nor the name of one. */
static bool is_word(const char *input)
{
    return access(input, F_OK) != 0 && !strpbrk(input, "/.");
}

/* The words among the arguments of `list`; the others are libraries. The caller frees the items. */
static struct arg_list words_of(const struct cli *cli)
{
    struct arg_list words = {0};
    for (size_t i = 1; i < cli->parser.inputs.len; ++i)
        if (is_word(cli->parser.inputs.items[i]))
            args_append(&words, cli->parser.inputs.items[i]);
    return words;
}

static void list(struct cli *cli, const struct library_args *args)
{
    (void)args;
    struct arg_list words = words_of(cli);
    if (!nodes_list(cli->library, words.items, words.len) && words.len) {
        const char *near = nodes_closest(cli->library, words.items[0]);
        report_error(&cli->report, "unknown-node",
                     near ? "no node has '%s' in its name (did you mean '%s'?)"
                          : "no node has '%s' in its name",
                     words.items[0], near);
    }
    free(words.items);
}

static const struct action {
    const char *name;
    void (*run)(struct cli *cli, const struct library_args *args);
    bool on_builtin;            /* the paths extend the built-in library */
    bool makes_image;           /* which has no library below it */
    bool has_output, has_pages; /* takes -o; takes --html, --markdown and --pictures */
    bool has_words;             /* arguments that are no paths are words */
    bool has_notes;             /* prints the notes of loading, which are otherwise hidden */
} actions[] = {{"pack", pack, .makes_image = true, .has_output = true},
               {"list", list, .has_words = true, .has_notes = true},
               {"expand", expand, .on_builtin = true, .has_output = true},
               {"doc", library_doc, .on_builtin = true, .has_output = true, .has_pages = true}};
#define NUM_ACTIONS (sizeof actions / sizeof *actions)

static const struct action *find_action(const char *name)
{
    for (size_t i = 0; i < NUM_ACTIONS; ++i) {
        if (strcmp(name, actions[i].name) == 0)
            return &actions[i];
    }
    fprintf(stderr, "mxgen: 'library %s' is none of pack, list, expand, doc\n", name);
    return NULL;
}

/* False after a message about an option that the action does not take, or its value. */
static bool check_options(const struct cli *cli, const struct action *action,
                          const struct library_args *args)
{
    static const char *const names[] = {"output", "html", "markdown", "pictures"};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
        if ((i == 0 ? action->has_output : action->has_pages)
            || !args_is_given(&cli->parser, names[i]))
            continue;
        fprintf(stderr, "mxgen: option '--%s' does not apply to 'library %s'\n", names[i],
                action->name);
        return false;
    }
    return !action->has_pages || !args->output || args_check_path("--output", "DIR", args->output);
}

/* True if an image of the library would lack nothing. */
static bool is_whole(const mxg_library *library)
{
    const mxg_diagnostics *list = library ? mxg_library_diagnostics(library) : NULL;
    bool good = list && mxg_diagnostics_num_errors(list) == 0;
    for (uint32_t i = 0; good && i < mxg_diagnostics_num_items(list); ++i) {
        mxg_diagnostic item = {.size = sizeof item};
        good = mxg_diagnostics_item(list, i, &item) == MXG_OK
               && strcmp(item.id, "broken-implementation") != 0;
    }
    return good;
}

/* False after telling that all faults of the library come from the lack of the built-in one. */
static bool stands_alone(struct cli *cli, const struct arg_list *paths, mxg_library *builtin)
{
    mxg_library *above = NULL;
    if (!builtin || is_whole(cli->library))
        return true;
    mxg_library_load(cli->context, builtin, paths->items, paths->len, &above);
    bool needs_builtin = is_whole(above);
    mxg_library_unref(above);
    if (needs_builtin)
        report_error(&cli->report, "image-needs-library",
                     "'%s' uses what the built-in library defines, and an image has no library "
                     "below it; load the files themselves above the built-in one",
                     paths->items[0]);
    return !needs_builtin;
}

/* Loads the library from the paths; without paths the built-in one. */
static bool load(struct cli *cli, const struct action *action)
{
    const struct arg_list *inputs = &cli->parser.inputs;
    struct arg_list paths = {0};
    for (size_t i = 1; i < inputs->len; ++i)
        if (!action->has_words || !is_word(inputs->items[i]))
            args_append(&paths, inputs->items[i]);
    const struct arg_list *more = &cli->plugins.libraries;
    for (size_t i = 0; i < more->len && (action->has_words || action->has_pages); ++i)
        args_append(&paths, more->items[i]);
    mxg_library *builtin = cli->no_builtin_library ? NULL : mxg_library_builtin(cli->context);
    if (paths.len == 0 && builtin) {
        cli->library = builtin;
        return true;
    }
    mxg_status status = mxg_library_load(cli->context, action->on_builtin ? builtin : NULL,
                                         paths.items, paths.len, &cli->library);
    bool good = !action->makes_image || stands_alone(cli, &paths, builtin);
    free(paths.items);
    mxg_library_unref(builtin);
    if (!good)
        return false;
    bool verbose = cli->report.verbose;
    cli->report.verbose |= action->has_notes && !cli->report.quiet;
    if (cli->library)
        report_list(&cli->report, mxg_library_diagnostics(cli->library));
    cli->report.verbose = verbose;
    return report_status(&cli->report, status);
}

int command_library(const struct command *command, int argc, char **argv)
{
    struct library_args values = {0};
    const struct arg args[] = {
        {"output", 'o', ARG_TEXT, "PATH",
         "output file, for doc a folder (default: standard output, the current folder)",
         &values.output},
        {"html", 0, ARG_FLAG, NULL, "doc: writes only index.html (default: both pages)",
         &values.html},
        {"markdown", 0, ARG_FLAG, NULL, "doc: writes only index.md", &values.markdown},
        {"pictures", 0, ARG_FLAG, NULL,
         "doc: renders patterns, closures and shaders with mxgen-render", &values.pictures},
    };
    struct cli cli;
    int code;
    if (cli_start(&cli, command, args, sizeof args / sizeof *args,
                  CLI_NEEDS_INPUT | CLI_LIBRARY_IS_INPUT, argc, argv, &code)) {
        const struct action *action = find_action(cli.parser.inputs.items[0]);
        bool is_sane = action && check_options(&cli, action, &values);
        if (is_sane && load(&cli, action))
            action->run(&cli, &values);
        code = !is_sane ? EXIT_USAGE : cli.report.errors ? EXIT_FAULT : EXIT_DONE;
    }
    cli_finish(&cli);
    return code;
}
