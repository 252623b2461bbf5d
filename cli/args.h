// SPDX-License-Identifier: Apache-2.0
/*
 * Arguments of a command: a table of its own options, and the options of generation, which the
 * library describes (mxg_get_option). `--key value`, `--key=value`, `-k value`, `-kvalue`; flags
 * `--key` and `--no-key`; `--` ends the options.
 */
#ifndef MXG_CLI_ARGS_H
#define MXG_CLI_ARGS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

struct arg_list {
    const char **items;
    size_t len;
};

enum arg_kind {
    ARG_FLAG, /* out: bool * */
    ARG_TEXT, /* out: const char ** */
    ARG_SIZE, /* out: size_t *; a count */
    ARG_LIST, /* out: struct arg_list *; may stand several times */
    ARG_HELP, /* out: const char **; "" or the word "all" behind it */
};

/* The parts of --help; those of more options and of limits are shown by --help all. */
enum arg_group { ARG_OWN, ARG_MORE, ARG_COMMON, ARG_LIMITS };

struct arg {
    const char *name;
    char letter; /* 0: none */
    enum arg_kind kind;
    const char *value; /* what stands behind it in the help: "DIR", "a|b"; NULL: it takes none */
    const char *help;
    void *out;
    enum arg_group group;
    bool is_own; /* not passed on to other programs */
};

/* An option of generation as it was written, in order; applied once there is a context. */
struct arg_setting {
    const char *key, *value;
};

struct arg_parser {
    const struct arg *args;
    size_t num_args;
    bool generation; /* options of generation are accepted */
    struct arg_list inputs;
    struct arg_setting *settings;
    size_t num_settings;
};

/* Prints what is wrong and returns false for an unknown option or a missing value. */
bool args_parse(struct arg_parser *parser, int argc, char **argv);
void args_finish(struct arg_parser *parser);

void args_append(struct arg_list *list, const char *item);
/* Frees the list and its items, which must be of cli_format or cli_copy. */
void args_free(struct arg_list *list);

/* Appends what an option was given, as it is written on a command line; nothing for a text that was
 * not given. The items are to be freed. */
void args_forward(const struct arg *arg, struct arg_list *out);

/* The closest of the candidates by edit distance, NULL where none is near. */
const char *args_closest(const char *word, const char *const *candidates, size_t num_candidates);

#endif
