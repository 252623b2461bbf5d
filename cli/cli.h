// SPDX-License-Identifier: Apache-2.0
/*
 * What the commands share: their common options, and the objects of the library made from them.
 * Everything stands on mxgen.h.
 *
 * Exit codes: 0 everything asked for was done, 1 errors in the input or while writing, 2 bad usage.
 */
#ifndef MXG_CLI_CLI_H
#define MXG_CLI_CLI_H

#include "cli/args.h"
#include "cli/report.h"

#include <mxgen/mxgen.h>

/* What a document of standard input is called. */
#define CLI_STDIN_NAME "<stdin>"

enum exit_code { EXIT_DONE = 0, EXIT_FAULT = 1, EXIT_USAGE = 2 };

struct help_book;

struct command {
    const char *name;
    const char *usage; /* "FILE... [--target T] [options]" */
    const char *brief;
    int (*run)(const struct command *command, int argc, char **argv);
    struct help_book
        *book; /* that its options are added to, and nothing else is done; NULL: none */
};

struct cli {
    struct arg_parser parser;
    struct arg_list library_paths;
    bool quiet, verbose, version, no_builtin_library;
    const char *help;         /* the word behind --help; NULL: help is not asked for */
    struct arg_list warnings; /* words of -W */
    struct arg_list include_roots;
    bool trust, sandbox;
    size_t max_memory, max_file_size, max_elements, max_nodes, max_output_size, max_errors,
        max_depth, max_include_depth, max_includes;

    struct report report;
    mxg_context *context;
    mxg_library *library;
    mxg_options *options; /* of generation */
};

/* What a command wants besides its own table of options. */
enum cli_wants {
    CLI_GENERATES = 1,
    CLI_NEEDS_INPUT = 2,
    CLI_LIBRARY_IS_INPUT = 4 /* loads none by itself */
};

/*
 * Parses the arguments and makes context, library and options. False: the command ends with
 * *out_exit, after --help or an error. cli_finish must follow in both cases.
 */
bool cli_start(struct cli *cli, const struct command *command, const struct arg *args,
               size_t num_args, unsigned wants, int argc, char **argv, int *out_exit);
void cli_finish(struct cli *cli);

/* Appends the arguments that give another of our programs the same library, limits and options of
 * generation, and let it print errors only. The items are to be freed. */
void cli_forward(struct cli *cli, struct arg_list *args);

/*
 * Loads a document ("-": of standard input) and prints its diagnostics; NULL where errors leave
 * nothing of it that can be rendered.
 */
mxg_document *cli_load(struct cli *cli, const char *path);

/* The target by its name, or by MaterialX's; prints that there is none, and which there are. */
bool cli_find_target(const char *name, size_t len, mxg_target *out);

/* What a file of an element is called: its path with dots. To be freed. */
char *cli_file_name(const char *element_path);

/* Another of our programs: its path beside this one, else its name, for PATH. To be freed. */
char *cli_program(const char *name);

/* Formats into new memory, to be freed; ends the program where there is none. */
#if defined(__GNUC__)
__attribute__((format(printf, 1, 2)))
#endif
char *
cli_format(const char *format, ...);

/* FNV-1a of a text and of what was hashed before, at first CLI_HASH_OF_NOTHING. */
#define CLI_HASH_OF_NOTHING 0xcbf29ce484222325u
uint64_t cli_hash(uint64_t hash, const char *text);

/*
 * A copy of `len` bytes with a NUL behind them, to be freed; ends the program where there is no
 * memory.
 */
char *cli_copy(const char *text, size_t len);

/* generate.c, check/check.c, inspect.c, library.c, validate.c, render.c, explain.c */
int command_generate(const struct command *command, int argc, char **argv);
int command_check(const struct command *command, int argc, char **argv);
int command_inspect(const struct command *command, int argc, char **argv);
int command_library(const struct command *command, int argc, char **argv);
int command_validate(const struct command *command, int argc, char **argv);
int command_explain(const struct command *command, int argc, char **argv);
int command_render(const struct command *command, int argc, char **argv);

#endif
