// SPDX-License-Identifier: Apache-2.0
#include "program/profile.h"

#include "program/args.h"
#include "program/cli.h"
#include "program/files.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_VALUE = 1024 };

struct reader {
    const char *name; /* of the profile, for messages */
    unsigned line;
    mxg_options *options;
};

static bool complain(const struct reader *r, const char *what)
{
    fprintf(stderr, "mxgen: %s:%u: error: %s\n", r->name, r->line, what);
    return false;
}

static const char *skip_space(const char *at)
{
    return at + strspn(at, " \t\r");
}

/* Appends a number, a word or a string in quotes, and moves behind it. False: there is none. */
static bool read_item(const char **at, char *value)
{
    bool is_quoted = **at == '"' || **at == '\'';
    const char quote[] = {**at, '\0'}, *begin = *at + is_quoted;
    size_t len = strcspn(begin, is_quoted ? quote : " \t\r#,]"), before = strlen(value);
    if ((is_quoted && !begin[len]) || (!is_quoted && !len) || before + len + 2 > MAX_VALUE)
        return false;
    memcpy(value + before, begin, len);
    value[before + len] = '\0';
    *at = begin + len + is_quoted;
    return true;
}

/* The items of an array, with commas between them. */
static bool read_array(const char **at, char *value)
{
    for (*at = skip_space(*at + 1); **at != ']';) {
        size_t len = strlen(value);
        if (len)
            memcpy(value + len, ",", 2);
        if (!read_item(at, value))
            return false;
        *at = skip_space(*at);
        if (**at == ',')
            *at = skip_space(*at + 1);
        else if (**at != ']')
            return false;
    }
    ++*at;
    return true;
}

static bool read_line(const struct reader *r, const char *line)
{
    const char *at = skip_space(line);
    size_t len = strcspn(at, " \t\r=");
    char value[MAX_VALUE] = "";
    if (!*at || *at == '#')
        return true;
    char *key = cli_copy(at, len);
    at = skip_space(at + len);
    bool is_pair = len && *at == '=';
    if (is_pair)
        at = skip_space(at + 1);
    bool good = is_pair && (*at == '[' ? read_array(&at, value) : read_item(&at, value));
    at = skip_space(at);
    if (!good || (*at && *at != '#'))
        good = complain(r, "a line is a comment, or an option, '=' and a value");
    else if (mxg_options_set(r->options, key, value) != MXG_OK)
        good = complain(r, mxg_options_error(r->options));
    free(key);
    return good;
}

static bool read_lines(struct reader *r, const char *text)
{
    bool good = true;
    while (*text && good) {
        size_t len = strcspn(text, "\n");
        char *line = cli_copy(text, len);
        r->line++;
        good = read_line(r, line);
        free(line);
        text += len + (text[len] == '\n');
    }
    return good;
}

static bool read_file(struct reader *r)
{
    size_t size;
    char *text = files_read(r->name, &size);
    if (!text) {
        fprintf(stderr, "mxgen: cannot read the profile '%s': %s\n", r->name, strerror(errno));
        return false;
    }
    bool good = read_lines(r, text);
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

bool profile_apply(mxg_options *options, const char *name)
{
    struct reader r = {.name = name, .options = options};
    size_t len = strlen(name);
    if (len > 5 && strcmp(name + len - 5, ".toml") == 0)
        return read_file(&r);
    for (size_t i = 0; profile_texts[i]; i += 2)
        if (strcmp(profile_texts[i], name) == 0)
            return read_lines(&r, profile_texts[i + 1]);
    return complain_of_name(name);
}
