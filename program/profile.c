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

struct profile_pair {
    const char *key, *items; /* of a list; NULL: it is none */
    uint32_t line;           /* 0: another value replaced this one */
};

/* Frees the message. */
static bool complain(const char *name, const struct toml *toml, char *what)
{
    utf8_clean(what);
    fprintf(stderr, "mxgen: %s:%u: error: %s\n", name, (unsigned)toml->number, what);
    free(what);
    return false;
}

static bool is_list(const char *key)
{
    mxg_option option = {sizeof option};
    for (uint32_t i = 0; mxg_catalogue_option(i, &option) == MXG_OK; ++i)
        if (strcmp(option.key, key) == 0)
            return option.type == MXG_OPTION_LIST;
    return false;
}

static void keep_pair(struct profile *profile, const struct toml *toml, const char *value)
{
    profile->pairs =
        store_grow(&profile->store, profile->pairs, profile->num_pairs, sizeof *profile->pairs);
    profile->pairs[profile->num_pairs++] = (struct profile_pair){
        toml->name.text, is_list(toml->name.text) ? value : NULL, toml->number};
}

/* Sets the option of a line. False after a message. */
static bool read_line(struct profile *profile, mxg_options *options, const struct toml *toml,
                      struct name_table *known)
{
    bool is_new = true;
    const char *name = profile->name;
    const char *value = toml->kind == TOML_PAIR ? toml_text(toml->store, toml->value) : NULL;
    if (!value)
        return complain(name, toml,
                        cli_format("a line is a comment, or an option, '=' and a value"));
    names_add(known, toml->name.text, &is_new);
    if (!is_new)
        return complain(name, toml, cli_format("'%s' stands above already", toml->name.text));
    keep_pair(profile, toml, value);
    return mxg_options_set(options, toml->name.text, value) == MXG_OK
           || complain(name, toml, cli_option_error(options));
}

static bool read_lines(struct profile *profile, mxg_options *options, const char *text)
{
    struct name_table known = {0};
    struct toml toml = {.store = &profile->store, .rest = text};
    bool good = true;
    while (good && toml_next(&toml))
        good = read_line(profile, options, &toml, &known);
    names_finish(&known);
    return good;
}

static bool read_file(struct profile *profile, mxg_options *options)
{
    const char *name = profile->name;
    size_t size;
    char *text = files_read(name, &size);
    if (!text) {
        fprintf(stderr, "mxgen: cannot read the profile '%s': %s\n", name, strerror(errno));
        return false;
    }
    const char *fault = toml_fault(text, size);
    if (fault)
        fprintf(stderr, "mxgen: cannot read the profile '%s': %s\n", name, fault);
    bool good = !fault && read_lines(profile, options, text);
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

bool profile_apply(struct profile *profile, mxg_options *options, const char *name)
{
    profile->name = name;
    if (is_file(name))
        return read_file(profile, options);
    for (size_t i = 0; profile_texts[i]; i += 2)
        if (strcmp(profile_texts[i], name) == 0)
            return read_lines(profile, options, profile_texts[i + 1]);
    return complain_of_name(name);
}

void profile_finish(struct profile *profile)
{
    store_finish(&profile->store);
    *profile = (struct profile){0};
}

void profile_override(struct profile *profile, const char *key)
{
    for (size_t i = 0; i < profile->num_pairs; ++i)
        if (!profile->pairs[i].items && strcmp(profile->pairs[i].key, key) == 0)
            profile->pairs[i].line = 0;
}

static bool has_item(const char *items, const char *item)
{
    size_t len = strlen(item), part;
    for (; *items; items += part + (items[part] == ',')) {
        part = strcspn(items, ",");
        if (part == len && memcmp(items, item, len) == 0)
            return true;
    }
    return false;
}

uint32_t profile_line(const struct profile *profile, const char *key, const char *value)
{
    uint32_t line = 0;
    for (size_t i = 0; i < profile->num_pairs && !line; ++i) {
        const struct profile_pair *pair = &profile->pairs[i];
        if (strcmp(pair->key, key) == 0 && (!pair->items || has_item(pair->items, value)))
            line = pair->line;
    }
    return line;
}
