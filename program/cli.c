// SPDX-License-Identifier: Apache-2.0
#include "program/cli.h"

#include "program/files.h"
#include "program/help.h"
#include "program/memory.h"
#include "program/name_table.h"
#include "program/texel_reader.h"
#include "program/warnings.h"

#include <assert.h>
#include <errno.h>
#ifndef __wasi__
#include <signal.h>
#endif
#include <stdarg.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <stdlib.h>
#include <string.h>

#define MAX_OWN_ARGS 40 /* options of a command */
#define MAX_COMMON_ARGS 24
#define MAX_ERRORS 20 /* default limit per document */

/* Adds the options that every command has after the command's own. */
static size_t add_common_args(struct cli *cli, struct arg *table)
{
    const struct arg common[] = {
        {"library", 0, ARG_LIST, "PATH", "adds a library: a folder, a file or an image",
         &cli->library_paths, ARG_COMMON},
        {"no-builtin-library", 0, ARG_FLAG, NULL, "does not load the built-in library",
         &cli->no_builtin_library, ARG_COMMON},
        {"source-path", 0, ARG_LIST, "DIR",
         "another folder to search for source files of implementations and included documents",
         &cli->source_paths, ARG_COMMON},
        {"plugin", 0, ARG_LIST, "FILE",
         "loads a shared object with nodes in C and targets; it runs with your rights, so not with "
         "--sandbox",
         &cli->plugin_files, ARG_COMMON},
        {"profile", 0, ARG_TEXT, "NAME",
         "options of a platform: desktop, console, mobile, one-slab, or a file.toml; other "
         "options of generation override them",
         &cli->profile_name, ARG_COMMON},
        {"max-memory", 0, ARG_SIZE, "BYTES", "limit of memory (default: none)", &cli->max_memory,
         ARG_LIMITS},
        {"max-file-size", 0, ARG_SIZE, "MIB", "limit of the size of an input file (default: 256)",
         &cli->max_file_size, ARG_LIMITS},
        {"max-elements", 0, ARG_SIZE, "N", "limit of elements of a document (default: 16000000)",
         &cli->max_elements, ARG_LIMITS},
        {"max-nodes", 0, ARG_SIZE, "N", "limit of IR nodes of a shader (default: 64000000)",
         &cli->max_nodes, ARG_LIMITS},
        {"max-output-size", 0, ARG_SIZE, "MIB", "limit of the size of a shader (default: 256)",
         &cli->max_output_size, ARG_LIMITS},
        {"max-depth", 0, ARG_SIZE, "N", "limit of nested elements (default: 128)", &cli->max_depth,
         ARG_LIMITS},
        {"max-include-depth", 0, ARG_SIZE, "N", "limit of nested includes (default: 16)",
         &cli->max_include_depth, ARG_LIMITS},
        {"max-includes", 0, ARG_SIZE, "N",
         "limit of files that a document includes (default: 4096)", &cli->max_includes, ARG_LIMITS},
        {"trust", 0, ARG_FLAG, NULL, "accepts source code for one target in documents", &cli->trust,
         ARG_LIMITS},
        {"sandbox", 0, ARG_FLAG, NULL,
         "accepts only files in and below the folder of the document, and no source code in it",
         &cli->sandbox, ARG_LIMITS},
        {"include-root", 0, ARG_LIST, "DIR", "another folder that --sandbox accepts",
         &cli->include_roots, ARG_LIMITS},
        {"max-errors", 0, ARG_SIZE, "N", "errors printed for a document; 0: all (default: 20)",
         &cli->max_errors, ARG_COMMON},
        {"warning", 'W', ARG_LIST, "WORD",
         "-WID and -Wno-ID switch a warning on and off; -Werror turns all warnings into errors, "
         "-Werror=ID and -Wno-error=ID one of them",
         &cli->warnings, ARG_COMMON},
        {"quiet", 'q', ARG_FLAG, NULL, "prints errors only", &cli->quiet, ARG_COMMON,
         .is_own = true},
        {"verbose", 0, ARG_FLAG, NULL, "also prints the upgrades of older documents", &cli->verbose,
         ARG_COMMON},
        {"version", 0, ARG_FLAG, NULL, "prints the version", &cli->version, ARG_COMMON,
         .is_own = true},
        {"help", 'h', ARG_HELP, "[all]", "prints help; 'all' includes all options", &cli->help,
         ARG_COMMON, .is_own = true},
    };
    _Static_assert(sizeof common / sizeof *common <= MAX_COMMON_ARGS, "more options than room");
    memcpy(table, common, sizeof common);
    return sizeof common / sizeof *common;
}

/* True if the arguments request only help or the version; prints it. */
static bool answer_help(const struct cli *cli, const struct command *command, int *out_exit)
{
    if (cli->help)
        *out_exit = help_print(command, &cli->parser, cli->help) ? EXIT_DONE : EXIT_USAGE;
    else if (cli->version) {
        printf("mxgen %s\n", mxg_version_string());
        *out_exit = EXIT_DONE;
    }
    return cli->help || cli->version;
}

static uint32_t limit_u32(size_t value)
{
    return value > UINT32_MAX ? UINT32_MAX : (uint32_t)value;
}

char *cli_describe_context(const struct cli *cli, mxg_context_desc *out)
{
    static const mxg_texel_reader texels = {.read_texels = cli_read_texels};
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    desc.max_memory = cli->max_memory;
    desc.max_file_mib = limit_u32(cli->max_file_size);
    desc.max_elements = limit_u32(cli->max_elements);
    desc.max_nodes = limit_u32(cli->max_nodes);
    desc.max_output_mib = limit_u32(cli->max_output_size);
    desc.max_errors = cli->max_errors ? limit_u32(cli->max_errors) : UINT32_MAX;
    desc.max_depth = limit_u32(cli->max_depth);
    desc.max_include_depth = limit_u32(cli->max_include_depth);
    desc.max_includes = limit_u32(cli->max_includes);
    desc.trust = cli->trust;
    desc.sandbox = cli->sandbox;
    desc.include_roots = cli->include_roots.items;
    desc.num_include_roots = cli->include_roots.len;
    desc.source_paths = cli->source_paths.items;
    desc.num_source_paths = cli->source_paths.len;
    desc.node_codes = cli->plugins.codes;
    desc.num_node_codes = cli->plugins.num_codes;
    desc.dialects = cli->plugins.dialects;
    desc.num_dialects = cli->plugins.num_dialects;
    desc.texels = &texels;
    char *warnings = warnings_join(&cli->warnings);
    desc.warnings = warnings;
    *out = desc;
    return warnings;
}

static bool create_context(struct cli *cli)
{
    mxg_context_desc desc;
    char *warnings = cli_describe_context(cli, &desc);
    mxg_status status = mxg_context_create(&desc, &cli->context);
    if (status == MXG_ERROR_ARGUMENT && cli->plugin_files.len) {
        char reason[512];
        mxg_context_desc_error(&desc, reason, sizeof reason);
        fprintf(stderr, "mxgen: a plug-in is refused: %s\n", reason);
        free(warnings);
        return false;
    }
    free(warnings);
    return report_status(&cli->report, status);
}

/* Plug-ins run with the rights of the user, and a sandbox gives documents fewer rights. */
static bool load_plugins(struct cli *cli)
{
    if (cli->plugin_files.len && cli->sandbox) {
        fputs("mxgen: --sandbox allows no --plugin, because a plug-in runs without limits\n",
              stderr);
        return false;
    }
    return plugins_load(&cli->plugins, &cli->plugin_files);
}

/* The libraries of the command line, then those of plug-ins. */
static bool load_library(struct cli *cli)
{
    mxg_library *base = cli->no_builtin_library ? NULL : mxg_library_builtin(cli->context);
    size_t num_paths = cli->library_paths.len + cli->plugins.libraries.len;
    if (base && num_paths == 0) {
        cli->library = base;
        return true;
    }
    struct arg_list paths = {0};
    for (size_t i = 0; i < num_paths; ++i)
        args_append(&paths, i < cli->library_paths.len
                                ? cli->library_paths.items[i]
                                : cli->plugins.libraries.items[i - cli->library_paths.len]);
    mxg_status status = mxg_library_load(cli->context, base, paths.items, paths.len, &cli->library);
    free(paths.items);
    mxg_library_unref(base);
    if (cli->library)
        report_list(&cli->report, mxg_library_diagnostics(cli->library));
    return report_status(&cli->report, status);
}

/* Invalid values are bad usage; the message of the option gives the reason. */
static bool apply_settings(struct cli *cli)
{
    if (cli->profile_name && !profile_apply(&cli->profile, cli->options, cli->profile_name))
        return false;
    for (size_t i = 0; i < cli->parser.num_settings; ++i) {
        const struct arg_setting *setting = &cli->parser.settings[i];
        if (mxg_options_set(cli->options, setting->key, setting->value) != MXG_OK) {
            char *reason = cli_option_error(cli->options);
            fprintf(stderr, "mxgen: %s\n", reason);
            free(reason);
            return false;
        }
        profile_override(&cli->profile, setting->key);
    }
    return true;
}

/*
 * Keeps freed memory in the process: the next shader needs it again, and the system need not clear
 * it (docs/benchmarks.md).
 */
static void keep_memory(void)
{
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 256 << 10); /* arrays that grow leave no holes */
    mallopt(M_TRIM_THRESHOLD, 16 << 20);
    mallopt(M_TOP_PAD, 256 << 10);
#endif
}

/* A limit of file sizes is told as a full disk is; WebAssembly and Windows have no signal of it. */
static void ignore_file_limit(void)
{
#ifdef SIGXFSZ
    signal(SIGXFSZ, SIG_IGN);
#endif
}

bool cli_start(struct cli *cli, const struct command *command, const struct arg *args,
               size_t num_args, unsigned wants, int argc, char **argv, int *out_exit)
{
    *cli = (struct cli){.max_errors = MAX_ERRORS};
    keep_memory();
    ignore_file_limit();
    if (wants & CLI_KEEPS_INPUTS)
        args_append(&cli->warnings, "no-unread-input");
    struct arg table[MAX_OWN_ARGS + MAX_COMMON_ARGS];
    assert(num_args <= MAX_OWN_ARGS);
    for (size_t i = 0; i < num_args; ++i)
        table[i] = args[i];
    cli->parser.args = table;
    cli->parser.num_args = num_args + add_common_args(cli, table + num_args);
    cli->parser.generation = wants & CLI_GENERATES;
    report_init(&cli->report);

    if (command->book) {
        help_add(command->book, command, &cli->parser);
        *out_exit = EXIT_DONE;
        return false;
    }
    *out_exit = EXIT_USAGE;
    bool parsed = args_parse(&cli->parser, argc, argv);
    cli->report.quiet = cli->quiet;
    cli->report.warnings = &cli->warnings;
    cli->report.profile = &cli->profile;
    cli->report.profile_line = profile_line;
    cli->report.verbose = cli->verbose;
    cli->report.max_errors = cli->max_errors;
    cli->report.max_source_size = cli_max_file_size(cli) << 20;
    if (!parsed)
        return false;
    if (answer_help(cli, command, out_exit))
        return false;
    if (!warnings_check(&cli->warnings))
        return false;
    if ((wants & CLI_NEEDS_INPUT) && cli->parser.inputs.len == 0) {
        fprintf(stderr, "usage: mxgen %s\n", command->usage);
        return false;
    }
    if (!load_plugins(cli))
        return false;
    if (!create_context(cli)
        || !report_status(&cli->report, mxg_options_create(cli->context, &cli->options))) {
        *out_exit = EXIT_FAULT;
        return false;
    }
    if (!apply_settings(cli))
        return false;
    *out_exit = EXIT_FAULT;
    return (wants & CLI_LIBRARY_IS_INPUT) || load_library(cli);
}

/* True for options that make slabs cheaper. */
static bool is_budget(const char *key)
{
    static const char *const keys[] = {"slabs",    "max-slabs", "max-bytes", "max-error",
                                       "features", "profile",   "max-steps"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; ++i)
        if (strcmp(keys[i], key) == 0)
            return true;
    return false;
}

bool cli_has_budget(const struct cli *cli)
{
    bool has = cli->profile_name != NULL;
    for (size_t i = 0; i < cli->parser.num_settings; ++i)
        has |= is_budget(cli->parser.settings[i].key);
    return has;
}

/* Appends the common options that `is_wanted` accepts. */
static void forward_args(struct cli *cli, bool (*is_wanted)(const struct arg *arg),
                         struct arg_list *args)
{
    struct arg table[MAX_COMMON_ARGS];
    size_t num_args = add_common_args(cli, table);
    for (size_t i = 0; i < num_args; ++i)
        if (!table[i].is_own && is_wanted(&table[i]))
            args_forward(&table[i], args);
    args_append(args, cli_format("--quiet"));
}

static bool is_any(const struct arg *arg)
{
    (void)arg;
    return true;
}

static bool is_limit(const struct arg *arg)
{
    return arg->group == ARG_LIMITS;
}

static bool is_no_budget(const struct arg *arg)
{
    return !is_budget(arg->name);
}

static void forward(struct cli *cli, bool with_budgets, struct arg_list *args)
{
    forward_args(cli, with_budgets ? is_any : is_no_budget, args);
    for (size_t i = 0; i < cli->parser.num_settings; ++i)
        if (with_budgets || !is_budget(cli->parser.settings[i].key))
            args_append(args, cli_format("--%s=%s", cli->parser.settings[i].key,
                                         cli->parser.settings[i].value));
}

void cli_forward_limits(struct cli *cli, struct arg_list *args)
{
    forward_args(cli, is_limit, args);
}

void cli_forward(struct cli *cli, struct arg_list *args)
{
    forward(cli, true, args);
}

void cli_forward_full(struct cli *cli, struct arg_list *args)
{
    forward(cli, false, args);
}

void cli_finish(struct cli *cli)
{
    mxg_options_destroy(cli->options);
    mxg_library_unref(cli->library);
    mxg_context_destroy(cli->context);
    plugins_finish(&cli->plugins);
    free(cli->plugin_files.items);
    report_finish(&cli->report);
    profile_finish(&cli->profile);
    free(cli->library_paths.items);
    free(cli->warnings.items);
    free(cli->include_roots.items);
    free(cli->source_paths.items);
    args_finish(&cli->parser);
}

enum { DEFAULT_MIB = 256 }; /* of the library */

size_t cli_max_file_size(const struct cli *cli)
{
    return cli->max_file_size ? cli->max_file_size : DEFAULT_MIB;
}

size_t cli_max_output_size(const struct cli *cli)
{
    return cli->max_output_size ? cli->max_output_size : DEFAULT_MIB;
}

/* Includes are relative to the current folder. */
static mxg_status parse_stdin(struct cli *cli, mxg_document **out_document)
{
    size_t size = 0;
    char *text = files_read("/dev/stdin", &size);
    if (!text) {
        report_error(&cli->report, "file-unreadable", "cannot read standard input: %s",
                     strerror(errno));
        return MXG_ERROR_DOCUMENT;
    }
    mxg_status status =
        mxg_document_parse(cli->context, cli->library, CLI_STDIN_NAME, text, size, out_document);
    report_source(&cli->report, CLI_STDIN_NAME, text, size);
    return status;
}

mxg_document *cli_load(struct cli *cli, const char *path)
{
    mxg_document *document = NULL;
    report_document(&cli->report);
    mxg_status status = strcmp(path, "-") == 0
                            ? parse_stdin(cli, &document)
                            : mxg_document_load(cli->context, cli->library, path, &document);
    if (document)
        report_list(&cli->report, mxg_document_diagnostics(document));
    bool good = report_status(&cli->report, status);
    /*
     * Errors in one part, such as a missing include, do not prevent the generation of other parts.
     */
    if (good || mxg_document_num_renderables(document))
        return document;
    mxg_document_destroy(document);
    return NULL;
}

size_t cli_count_items(const char *list)
{
    size_t count = *list != '\0';
    for (; *list; ++list)
        count += *list == ',';
    return count;
}

char *cli_copy(const char *text, size_t len)
{
    char *copy = memory_alloc(len + 1);
    return memcpy(copy, text, len);
}

mxg_element cli_next_element(const mxg_document *document, mxg_element top, mxg_element at)
{
    mxg_element_info info = {.size = sizeof info};
    mxg_document_element(document, at, &info);
    mxg_element next = info.first_child;
    for (; !next && at != top; at = info.parent) {
        mxg_document_element(document, at, &info);
        next = info.next;
    }
    return next;
}

char *cli_beside(const char *from, const char *file)
{
    int folder = file[0] == '/' ? 0 : (int)(files_base_name(from) - from);
    return cli_format("%.*s%s", folder, from, file);
}

char *cli_option_error(const mxg_options *options)
{
    size_t size = mxg_options_error(options, NULL, 0) + 1;
    char *text = memory_alloc(size);
    mxg_options_error(options, text, size);
    return text;
}

char *cli_format(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    char *text = memory_format(format, args);
    va_end(args);
    return text;
}
