// SPDX-License-Identifier: Apache-2.0
/*
 * Every program has common options on its command line, and the library objects for them. It
 * uses only mxgen.h.
 *
 * Exit codes: 0 success, 1 errors in the input or while writing, 2 bad usage.
 */
#ifndef MXG_PROGRAM_CLI_H
#define MXG_PROGRAM_CLI_H

#include "program/args.h"
#include "program/plugin.h"
#include "program/profile.h"
#include "program/report.h"

#include <mxgen/mxgen.h>

#include <sys/types.h>

/* The name of the document from standard input. */
#define CLI_STDIN_NAME "<stdin>"

enum exit_code { EXIT_DONE = 0, EXIT_FAULT = 1, EXIT_USAGE = 2 };

struct help_book;

struct command {
    const char *name;
    const char *usage; /* "FILE... [--target T] [options]"; "-compile FILE..." of a program */
    const char *brief;
    int (*run)(const struct command *command, int argc, char **argv);
    struct help_book *book; /* the command only adds its options; NULL: none */
};

struct cli {
    struct arg_parser parser;
    struct arg_list library_paths;
    bool quiet, verbose, version, no_builtin_library;
    const char *help;         /* the word after --help; NULL: no --help */
    struct arg_list warnings; /* words of -W */
    struct arg_list include_roots;
    struct arg_list source_paths;
    struct arg_list plugin_files;
    const char *profile_name; /* NULL: none */
    struct profile profile;
    bool trust, sandbox;
    size_t max_memory, max_file_size, max_elements, max_nodes, max_output_size, max_errors,
        max_depth, max_include_depth, max_includes;

    struct report report;
    struct plugins plugins;
    mxg_context *context;
    mxg_library *library;
    mxg_options *options; /* options of generation */
};

/* Parts that a command needs besides its own table of options. */
enum cli_wants {
    CLI_GENERATES = 1,
    CLI_NEEDS_INPUT = 2,
    CLI_LIBRARY_IS_INPUT = 4, /* the command loads no library */
    CLI_KEEPS_INPUTS = 8      /* it writes, and tells of, inputs that no shader reads */
};

/*
 * Parses the arguments and makes context, library and options. False, after --help or an error: the
 * command ends with *out_exit. Call cli_finish in both cases.
 */
bool cli_start(struct cli *cli, const struct command *command, const struct arg *args,
               size_t num_args, unsigned wants, int argc, char **argv, int *out_exit);
void cli_finish(struct cli *cli);

/*
 * How the context is made, for a program that needs another one. Its texts live as long as `cli`,
 * except the warnings, which are the value: the caller frees it after it made the context.
 */
char *cli_describe_context(const struct cli *cli, mxg_context_desc *out);

/*
 * Appends the arguments that give another mxgen program the same library, limits and options of
 * generation, and make it print only errors. The caller frees the items.
 */
void cli_forward(struct cli *cli, struct arg_list *args);
/* Forwards limits alone, and makes the program print only errors. */
void cli_forward_limits(struct cli *cli, struct arg_list *args);
/* Forwards the options without those that make slabs cheaper. */
void cli_forward_full(struct cli *cli, struct arg_list *args);
/* True if there are such options. */
bool cli_has_budget(const struct cli *cli);

/*
 * Loads a document ("-": of standard input) and prints its diagnostics; NULL where errors leave
 * nothing of it that can be rendered.
 */
mxg_document *cli_load(struct cli *cli, const char *path);

/* The limits of the size of an input file, and of a shader or another output, in MiB. */
size_t cli_max_file_size(const struct cli *cli);
size_t cli_max_output_size(const struct cli *cli);

/* The element after `at` in document order, `top` or below it; 0: `at` is the last. */
mxg_element cli_next_element(const mxg_document *document, mxg_element top, mxg_element at);

/* The path of a file that the file `from` names, relative to its folder. The caller frees it. */
char *cli_beside(const char *from, const char *file);

/* Another mxgen program: its path beside this one, else its name, for PATH. The caller frees it. */
char *cli_program(const char *name);

/*
 * Starts a program, whose arguments end with NULL, and waits for its end. false after a message if
 * it could not start.
 */
bool cli_run(struct report *report, char *const *arguments, int *out_status);
/*
 * Starts or runs a program without a message: returns 0, or an error of errno. Its output goes to
 * the new file `log`, and it reads nothing; NULL: it writes and reads what this program does.
 */
int cli_start_logged(char *const *arguments, const char *log, pid_t *out_process);
int cli_run_logged(char *const *arguments, const char *log, int *out_status);

/* Formats into new memory, which the caller frees; ends the program if memory is exhausted. */
#if defined(__GNUC__)
__attribute__((format(printf, 1, 2)))
#endif
char *
cli_format(const char *format, ...);

/* How many items a list with commas has. */
size_t cli_count_items(const char *list);
/*
 * A copy of `len` bytes with a NUL after them, which the caller frees; ends the program if memory
 * is exhausted.
 */
char *cli_copy(const char *text, size_t len);
/* Why the last option was not set. The caller frees it. */
char *cli_option_error(const mxg_options *options);

#endif
