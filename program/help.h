// SPDX-License-Identifier: Apache-2.0
/*
 * Help from the tables of options: text for --help, a manual page, and completions for shells. The
 * last two need the options of all commands, which a book collects.
 */
#ifndef MXG_PROGRAM_HELP_H
#define MXG_PROGRAM_HELP_H

#include "program/cli.h"

/*
 * Prints usage and options of a command; `word` is the word after --help: "" or "all". False for
 * any other word.
 */
bool help_print(const struct command *command, const struct arg_parser *parser, const char *word);

/* The options of a command. */
struct help_chapter {
    struct command command;
    struct arg *args;
    size_t num_args;
    bool generation; /* the command has the options of generation */
};

struct help_book {
    struct help_chapter *chapters;
    size_t len;
};

void help_add(struct help_book *book, const struct command *command,
              const struct arg_parser *parser);
void help_finish(struct help_book *book);

/* A generation option as an entry of the table: "N", "a|b" or "TEXT" stands for its value. */
struct arg help_generation_arg(uint32_t index);

/* man.c: a page with the macros of man(7). */
void help_write_man(const struct help_book *book, FILE *out);

/* cli/shell_completion.c: for "bash", "zsh" or "fish"; false for any other shell. */
bool help_write_completion(const struct help_book *book, const char *shell, FILE *out);

#endif
