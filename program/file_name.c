// SPDX-License-Identifier: Apache-2.0
#include "program/file_name.h"

#include "program/cli.h"
#include "program/memory.h"
#include "program/name_table.h"
#include "program/utf8.h"

#include <stdlib.h>
#include <string.h>

/*
 * make ends a rule at ';', reads an assignment at '=', and has no escape for '|' and a last '\'. At
 * the begin of a name it reads '~' as a folder.
 */
static bool is_unfit(const char *text, size_t len, bool is_first)
{
    return utf8_is_hidden(text, len) || strchr(";=|\\", *text) || (is_first && *text == '~');
}

/* The name of a target with one of these stands for other names, too. */
static bool is_pattern(char c)
{
    return c && strchr("%*?[", c);
}

static unsigned hash_of(const char *name)
{
    return (unsigned)names_hash(NAMES_HASH_OF_NOTHING, name);
}

char *file_name_clean(const char *path)
{
    char *clean = memory_alloc(strlen(path) + 1), *out = clean;
    bool is_changed = false;
    for (const char *c = path; *c;) {
        size_t len = utf8_length(c), step = len ? len : 1;
        bool is_bad = is_unfit(c, len, c == path) || is_pattern(*c);
        if (is_bad)
            *out = '_';
        else
            memcpy(out, c, step);
        out += is_bad ? 1 : step;
        c += step;
        is_changed |= is_bad;
    }
    *out = '\0';
    if (!is_changed)
        return clean;
    char *marked = cli_format("%s-%08x", clean, hash_of(path));
    free(clean);
    return marked;
}

char *file_name_of_element(const char *element_path)
{
    /*
     * File systems allow names of 255 bytes. In a longer name a hash of the whole name replaces the
     * end, so that names stay distinct.
     */
    enum { MAX_NAME = 200 };
    size_t len = strlen(element_path);
    if (len > MAX_NAME)
        len = MAX_NAME;
    while (element_path[len] && ((unsigned char)element_path[len] & 0xc0) == 0x80)
        --len; /* not inside a character */
    char *part = element_path[len]
                     ? cli_format("%.*s-%08x", (int)len, element_path, hash_of(element_path))
                     : cli_format("%s", element_path);
    char *name = file_name_clean(part);
    free(part);
    for (char *c = name; *c; ++c)
        if (*c == '/')
            *c = '.';
    return name;
}

static bool suits_make(const char *name, bool is_target)
{
    bool is_good = true;
    size_t len = 1;
    for (const char *c = name; *c && is_good; c += len) {
        len = utf8_length(c);
        bool is_inner = *c == '\\' && c[1];
        is_good =
            len && (is_inner || !is_unfit(c, len, c == name)) && !(is_target && is_pattern(*c));
    }
    return is_good;
}

bool file_name_put_make(FILE *out, const char *name, bool is_target)
{
    if (!suits_make(name, is_target))
        return false;
    for (size_t slashes = 0; *name; ++name) {
        bool is_special = *name == ' ' || *name == '#' || *name == ':';
        for (size_t i = 0; is_special && i < slashes + 1; ++i)
            putc('\\', out);
        if (*name == '$')
            putc('$', out);
        putc(*name, out);
        slashes = *name == '\\' ? slashes + 1 : 0;
    }
    return true;
}
