// SPDX-License-Identifier: Apache-2.0
#include "program/profile.h"

#include "program/args.h"
#include "program/cli.h"
#include "program/files.h"
#include "program/name_table.h"
#include "program/toml.h"
#include "program/utf8.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Frees the message. */
static bool complain(const char *name, const struct toml *toml, char *what)
{
    utf8_clean(what);
    fprintf(stderr, "mxgen: %s:%u: error: %s\n", name, (unsigned)toml->number, what);
    free(what);
    return false;
}

/* Sets the option of a line. False after a message. */
static bool read_line(mxg_options *options, const char *name, const struct toml *toml,
                      struct name_table *known)
{
    bool is_new = true;
    const char *value = toml->kind == TOML_PAIR ? toml_text(toml->store, toml->value) : NULL;
    if (!value)
        return complain(name, toml,
                        cli_format("a line is a comment, or an option, '=' and a value"));
    names_add(known, toml->name.text, &is_new);
    if (!is_new)
        return complain(name, toml, cli_format("'%s' stands above already", toml->name.text));
    return mxg_options_set(options, toml->name.text, value) == MXG_OK
           || complain(name, toml, cli_option_error(options));
}

static bool read_lines(mxg_options *options, const char *name, const char *text)
{
    struct store store = {0};
    struct name_table known = {0};
    struct toml toml = {.store = &store, .rest = text};
    bool good = true;
    while (good && toml_next(&toml))
        good = read_line(options, name, &toml, &known);
    names_finish(&known);
    store_finish(&store);
    return good;
}

static bool read_file(mxg_options *options, const char *name)
{
    size_t size;
    char *text = files_read(name, &size);
    if (!text) {
        fprintf(stderr, "mxgen: cannot read the profile '%s': %s\n", name, strerror(errno));
        return false;
    }
    const char *fault = toml_fault(text, size);
    if (fault)
        fprintf(stderr, "mxgen: cannot read the profile '%s': %s\n", name, fault);
    bool good = !fault && read_lines(options, name, text);
    free(text);
    return good;
}

/* "desktop, console, mobile" */
static bool complain_of_name(const char *name)
{
    const char *names[16];
    size_t num = 0;
    while (num < sizeof names / sizeof *names && profile_texts[2 * num]) {
        names[num] = profile_texts[2 * num];
        ++num;
    }
    const char *near = args_closest(name, names, num);
    fprintf(stderr, "mxgen: there is no profile '%s'; ", name);
    if (near)
        fprintf(stderr, "did you mean '%s'?\n", near);
    for (size_t i = 0; !near && i < num; ++i)
        fprintf(stderr, "%s%s", i ? ", " : "profiles are ", names[i]);
    if (!near)
        fprintf(stderr, ", and files that end with .toml\n");
    return false;
}

static bool is_file(const char *name)
{
    size_t len = strlen(name);
    return len > 5 && strcmp(name + len - 5, ".toml") == 0;
}

uint32_t profile_line(const char *name, const char *key, const char *value)
{
    size_t size;
    char *text = is_file(name) ? files_read(name, &size) : NULL;
    struct store store = {0};
    struct toml toml = {.store = &store, .rest = text ? text : ""};
    uint32_t line = 0;
    while (!line && toml_next(&toml)) {
        bool is_key = toml.kind == TOML_PAIR && strcmp(toml.name.text, key) == 0;
        const char *set = is_key ? toml_text(&store, toml.value) : NULL;
        line = set && strstr(set, value) ? toml.number : 0;
    }
    store_finish(&store);
    free(text);
    return line;
}

bool profile_apply(mxg_options *options, const char *name)
{
    if (is_file(name))
        return read_file(options, name);
    for (size_t i = 0; profile_texts[i]; i += 2)
        if (strcmp(profile_texts[i], name) == 0)
            return read_lines(options, name, profile_texts[i + 1]);
    return complain_of_name(name);
}
