// SPDX-License-Identifier: Apache-2.0
#include "program/args.h"

#include "program/cli.h"
#include "program/memory.h"

#include <errno.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

void args_append(struct arg_list *list, const char *item)
{
    MEMORY_PUSH(list->items, list->len, item);
}

void args_free(struct arg_list *list)
{
    for (size_t i = 0; i < list->len; ++i)
        free((void *)(uintptr_t)list->items[i]);
    free(list->items);
    *list = (struct arg_list){0};
}

void args_forward(const struct arg *arg, struct arg_list *out)
{
    const struct arg_list *list = arg->out;
    switch (arg->kind) {
    case ARG_FLAG:
        if (*(const bool *)arg->out)
            args_append(out, cli_format("--%s", arg->name));
        break;
    case ARG_TEXT:
    case ARG_PATH:
        if (*(const char *const *)arg->out)
            args_append(out, cli_format("--%s=%s", arg->name, *(const char *const *)arg->out));
        break;
    case ARG_SIZE:
        args_append(out, cli_format("--%s=%zu", arg->name, *(const size_t *)arg->out));
        break;
    case ARG_LIST:
        for (size_t i = 0; i < list->len; ++i)
            args_append(out, cli_format("--%s=%s", arg->name, list->items[i]));
        break;
    case ARG_HELP: break;
    }
}

static void add_setting(struct arg_parser *parser, const char *key, const char *value)
{
    args_append(&parser->given, key);
    MEMORY_PUSH(parser->settings, parser->num_settings, (struct arg_setting){key, value});
}

void args_finish(struct arg_parser *parser)
{
    free(parser->inputs.items);
    free(parser->given.items);
    free(parser->settings);
}

bool args_is_given(const struct arg_parser *parser, const char *name)
{
    for (size_t i = 0; i < parser->given.len; ++i)
        if (strcmp(parser->given.items[i], name) == 0)
            return true;
    return false;
}

const char *args_setting(const struct arg_parser *parser, const char *key)
{
    const char *value = NULL;
    for (size_t i = 0; i < parser->num_settings; ++i)
        if (strcmp(parser->settings[i].key, key) == 0)
            value = parser->settings[i].value;
    return value;
}

bool args_has_setting(const struct arg_parser *parser, const char *key, const char *value)
{
    const char *last = args_setting(parser, key);
    return last && strcmp(last, value) == 0;
}

/* An option on the command line: "--name=value" or "-n". */
struct written {
    const char *text;  /* the whole argument */
    const char *name;  /* after the dashes */
    size_t len;        /* length of the name */
    const char *value; /* after '='; NULL: none */
    bool is_letter;
};

static bool name_is(const struct written *option, const char *name)
{
    return strlen(name) == option->len && memcmp(name, option->name, option->len) == 0;
}

/* "--no-key" switches the flag "key" off. */
static bool strip_no(struct written *option)
{
    if (option->is_letter || option->len < 4 || memcmp(option->name, "no-", 3) != 0)
        return false;
    option->name += 3;
    option->len -= 3;
    return true;
}

static const struct arg *find_arg(const struct arg_parser *parser, const struct written *option)
{
    for (size_t i = 0; i < parser->num_args; ++i) {
        const struct arg *arg = &parser->args[i];
        if (option->is_letter ? arg->letter && option->len == 1 && arg->letter == option->name[0]
                              : name_is(option, arg->name))
            return arg;
    }
    return NULL;
}

static bool find_generation_option(const struct arg_parser *parser, const struct written *option,
                                   mxg_option *out)
{
    if (!parser->generation || option->is_letter)
        return false;
    for (uint32_t i = 0; i < mxg_catalogue_num_options(); ++i) {
        out->size = sizeof *out;
        if (mxg_catalogue_option(i, out) == MXG_OK && name_is(option, out->key))
            return true;
    }
    return false;
}

/* Levenshtein distance, for words shorter than the row. */
static size_t edit_distance(const char *a, const char *b)
{
    size_t row[64], len = strlen(b);
    if (len >= 64)
        return SIZE_MAX;
    for (size_t j = 0; j <= len; ++j)
        row[j] = j;
    for (size_t i = 0; a[i]; ++i) {
        size_t corner = row[0];
        row[0] = i + 1;
        for (size_t j = 1; j <= len; ++j) {
            size_t replace = corner + (a[i] != b[j - 1]);
            size_t insert = (row[j] < row[j - 1] ? row[j] : row[j - 1]) + 1;
            corner = row[j];
            row[j] = replace < insert ? replace : insert;
        }
    }
    return row[len];
}

bool args_is_one_of(const char *word, const char *const *words)
{
    while (*words && strcmp(word, *words) != 0)
        ++words;
    return *words != NULL;
}

const char *args_closest(const char *word, const char *const *candidates, size_t num_candidates)
{
    /* a third of the letters may differ, and one more */
    size_t best_distance = strlen(word) / 3 + 2;
    const char *best = NULL;
    for (size_t i = 0; i < num_candidates; ++i) {
        size_t distance = edit_distance(word, candidates[i]);
        if (distance < best_distance) {
            best_distance = distance;
            best = candidates[i];
        }
    }
    return best;
}

/* The new name of an option that had another one; NULL: it is none. */
static const char *new_name_of(const char *word)
{
    static const char *const renamed[][2] = {{"max-closures", "max-slabs"}};
    for (size_t i = 0; i < sizeof renamed / sizeof *renamed; ++i)
        if (strcmp(renamed[i][0], word) == 0)
            return renamed[i][1];
    return NULL;
}

static void print_unknown(const struct arg_parser *parser, const struct written *option)
{
    struct arg_list names = {0};
    for (size_t i = 0; i < parser->num_args; ++i)
        args_append(&names, parser->args[i].name);
    for (uint32_t i = 0; parser->generation && i < mxg_catalogue_num_options(); ++i) {
        mxg_option known = {sizeof known};
        mxg_catalogue_option(i, &known);
        args_append(&names, known.key);
    }
    char word[64];
    snprintf(word, sizeof word, "%.*s", (int)option->len, option->name);
    const char *near = parser->generation ? new_name_of(word) : NULL;
    if (!near && !option->is_letter)
        near = args_closest(word, names.items, names.len);
    if (near)
        fprintf(stderr, "mxgen: unknown option '%s' (did you mean '--%s'?)\n", option->text, near);
    else
        fprintf(stderr, "mxgen: unknown option '%s'; see --help\n", option->text);
    free(names.items);
}

static bool store_size(const struct arg *arg, const struct written *option, const char *text)
{
    char *end;
    errno = 0;
    unsigned long long value = strtoull(text, &end, 10);
    if (errno || end == text || *end || text[0] == '-' || value > SIZE_MAX) {
        fprintf(stderr, "mxgen: '%s' of option '%s' is not a count\n", text, option->text);
        return false;
    }
    if (arg->high && (value < arg->low || value > arg->high)) {
        fprintf(stderr, "mxgen: '%s' of option '%s' is not from %zu to %zu\n", text, option->text,
                arg->low, arg->high);
        return false;
    }
    *(size_t *)arg->out = (size_t)value;
    return true;
}

bool args_check_path(const char *option, const char *what, const char *path)
{
    bool is_good = strcmp(path, "-") != 0;
    if (!is_good)
        fprintf(stderr,
                "mxgen: option '%s' cannot be standard output, which '-' names, because it takes "
                "%s; './-' names a file or folder\n",
                option, what);
    return is_good;
}

static bool store(struct arg_parser *parser, const struct arg *arg, const struct written *option,
                  const char *value)
{
    args_append(&parser->given, arg->name);
    switch (arg->kind) {
    case ARG_FLAG: break;
    case ARG_HELP:
    case ARG_TEXT: *(const char **)arg->out = value; break;
    case ARG_PATH:
        *(const char **)arg->out = value;
        return args_check_path(option->text, arg->value, value);
    case ARG_SIZE: return store_size(arg, option, value);
    case ARG_LIST: args_append(arg->out, value); break;
    }
    return true;
}

/*
 * True if the option is a flag, with or without "no-". `known` is a generation option if `arg` is
 * NULL.
 */
static bool parse_flag(struct arg_parser *parser, const struct arg *arg, const mxg_option *known,
                       const struct written *option, bool on)
{
    if (arg && option->value) {
        fprintf(stderr, "mxgen: option '%s' takes no value\n", option->text);
        return false;
    }
    if (arg) {
        args_append(&parser->given, arg->name);
        *(bool *)arg->out = on;
        return true;
    }
    add_setting(parser, known->key, option->value && on ? option->value : on ? "true" : "false");
    return true;
}

/* Parses one option; *index advances if its value is the next argument. */
static bool parse_option(struct arg_parser *parser, struct written option, int argc, char **argv,
                         int *index)
{
    mxg_option known = {sizeof known};
    const struct arg *arg = find_arg(parser, &option);
    bool found = arg || find_generation_option(parser, &option, &known);
    if (found && (arg ? arg->kind == ARG_FLAG : known.type == MXG_OPTION_BOOL))
        return parse_flag(parser, arg, &known, &option, true);
    if (!found) {
        struct written positive = option;
        if (strip_no(&positive)) {
            arg = find_arg(parser, &positive);
            found = arg ? arg->kind == ARG_FLAG
                        : find_generation_option(parser, &positive, &known)
                              && known.type == MXG_OPTION_BOOL;
        }
        if (found && !option.value)
            return parse_flag(parser, arg, &known, &positive, false);
        print_unknown(parser, &option);
        return false;
    }
    const char *value = option.value;
    if (arg && arg->kind == ARG_HELP && !value) {
        bool is_all = *index + 1 < argc && strcmp(argv[*index + 1], "all") == 0;
        *index += is_all;
        return store(parser, arg, &option, is_all ? "all" : "");
    }
    if (!value && *index + 1 < argc)
        value = argv[++*index];
    if (!value || (arg && !*value)) {
        fprintf(stderr, "mxgen: option '%s' needs a value\n", option.text);
        return false;
    }
    if (arg)
        return store(parser, arg, &option, value);
    add_setting(parser, known.key, value);
    return true;
}

bool args_parse(struct arg_parser *parser, int argc, char **argv)
{
    bool only_inputs = false;
    for (int i = 1; i < argc; ++i) {
        const char *text = argv[i];
        if (only_inputs || text[0] != '-' || !text[1]) {
            args_append(&parser->inputs, text);
        } else if (strcmp(text, "--") == 0) {
            only_inputs = true;
        } else {
            bool is_letter = text[1] != '-';
            const char *name = text + (is_letter ? 1 : 2);
            const char *equals = is_letter ? NULL : strchr(name, '=');
            struct written option = {text, name, equals ? (size_t)(equals - name) : strlen(name),
                                     equals ? equals + 1 : NULL, is_letter};
            if (is_letter && name[1]) { /* "-j4" */
                option.len = 1;
                option.value = name + 1;
            }
            if (!parse_option(parser, option, argc, argv, &i))
                return false;
        }
    }
    return true;
}
