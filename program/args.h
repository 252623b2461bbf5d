// SPDX-License-Identifier: Apache-2.0
/*
 * Arguments of a command: a table of its own options, and the options of generation, which the
 * library describes (mxg_catalogue_option). `--key value`, `--key=value`, `-k value`, `-kvalue`;
 * flags
 * `--key` and `--no-key`; `--` ends the options.
 */
#ifndef MXG_PROGRAM_ARGS_H
#define MXG_PROGRAM_ARGS_H

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
    ARG_PATH, /* out: const char **; what the command cannot print, so '-' is an error */
    ARG_SIZE, /* out: size_t *; a count */
    ARG_LIST, /* out: struct arg_list *; may appear several times */
    ARG_HELP, /* out: const char **; "", or "all" if this word follows */
};

/* The parts of --help; --help all also shows ARG_MORE and ARG_LIMITS. */
enum arg_group { ARG_OWN, ARG_MORE, ARG_COMMON, ARG_LIMITS };

struct arg {
    const char *name;
    char letter; /* 0: none */
    enum arg_kind kind;
    const char *value; /* its value in the help: "DIR", "a|b"; NULL: the option takes none */
    const char *help;
    void *out;
    enum arg_group group;
    bool is_own;      /* not forwarded to other programs */
    size_t low, high; /* ARG_SIZE: the range; high 0: no limit */
};

/* An option of generation from the command line, in order; applied when the context exists. */
struct arg_setting {
    const char *key, *value;
};

struct arg_parser {
    const struct arg *args;
    size_t num_args;
    bool generation; /* the command accepts options of generation */
    struct arg_list inputs;
    struct arg_list given; /* names of the options on the command line, in order */
    struct arg_setting *settings;
    size_t num_settings;
};

/* Prints an error and returns false for an unknown option or a missing value. */
bool args_parse(struct arg_parser *parser, int argc, char **argv);
void args_finish(struct arg_parser *parser);

/*
 * False after an error: the value of an option that names a file or a folder ("FILE", "DIR") is
 * '-', which is standard output for what is a single text.
 */
bool args_check_path(const char *option, const char *what, const char *path);

/* True if the command line has this option, also if it repeats the default. */
bool args_is_given(const struct arg_parser *parser, const char *name);
/* The last value of an option of generation on the command line; NULL: it has none. */
const char *args_setting(const struct arg_parser *parser, const char *key);
/* True if that value is this one. */
bool args_has_setting(const struct arg_parser *parser, const char *key, const char *value);

void args_append(struct arg_list *list, const char *item);
/* Frees the list and its items, which come from cli_format or cli_copy. */
void args_free(struct arg_list *list);

/*
 * Appends an option with its value in command line form; nothing for a text option without a value.
 * The caller frees the items.
 */
void args_forward(const struct arg *arg, struct arg_list *out);

/* True if a word is one of a list, which NULL ends. */
bool args_is_one_of(const char *word, const char *const *words);

/* The closest candidate by edit distance; NULL if none is near. */
const char *args_closest(const char *word, const char *const *candidates, size_t num_candidates);

#endif
