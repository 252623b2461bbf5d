// SPDX-License-Identifier: Apache-2.0
#include "program/toml.h"

#include <ctype.h>
#include <string.h>

static const char *skip_space(const char *at)
{
    return at + strspn(at, " \t");
}

static bool is_quote(char c)
{
    return c == '"' || c == '\'';
}

/* The length of a quoted text with its quotes, the second of which may be missing. */
static size_t quoted_length(const char *at)
{
    size_t len = strcspn(at + 1, *at == '"' ? "\"" : "'") + 1;
    return len + (at[len] != '\0');
}

/* ---- Lines ---- */

/* A bare or quoted key. */
static struct toml_part read_name(struct toml *toml, const char *at)
{
    struct toml_part name = {.at = at};
    if (is_quote(*at)) {
        name.len = quoted_length(at);
        bool is_closed = name.len > 1 && at[name.len - 1] == *at;
        name.text = store_text(toml->store, at + 1, name.len - 1 - is_closed);
        return name;
    }
    while (isalnum((unsigned char)at[name.len]) || at[name.len] == '_' || at[name.len] == '-')
        ++name.len;
    name.text = name.len ? store_text(toml->store, at, name.len) : NULL;
    return name;
}

static bool ends(const char *at)
{
    at = skip_space(at);
    return !*at || *at == '#';
}

/* `at` is behind the bracket. */
static void read_table(struct toml *toml, const char *at)
{
    toml->kind = TOML_TABLE;
    toml->name = read_name(toml, skip_space(at));
    at = skip_space(toml->name.at + toml->name.len);
    if (toml->name.text && *at == '.') {
        toml->sub = read_name(toml, skip_space(at + 1));
        at = skip_space(toml->sub.at + toml->sub.len);
    }
    bool has_names = toml->name.text && (!toml->sub.at || toml->sub.text);
    toml->stop = has_names && *at == ']' && ends(at + 1) ? NULL : at;
}

static struct toml_part read_value(const char *at)
{
    struct toml_part value = {.at = at};
    while (at[value.len] && at[value.len] != '#')
        value.len += is_quote(at[value.len]) ? quoted_length(at + value.len) : 1;
    while (value.len && strchr(" \t", at[value.len - 1]))
        --value.len;
    return value;
}

static void read_pair(struct toml *toml, const char *at)
{
    toml->name = read_name(toml, at);
    at = skip_space(at + toml->name.len);
    toml->kind = toml->name.text && *at == '=' ? TOML_PAIR : TOML_OTHER;
    if (toml->kind == TOML_PAIR)
        toml->value = read_value(skip_space(at + 1));
}

const char *toml_fault(const char *text, size_t size)
{
    return strlen(text) < size ? "it has the character NUL, behind which nothing is read" : NULL;
}

/* A byte order mark at the beginning is no part of the text. */
static void skip_mark(struct toml *toml)
{
    if (!toml->number && strncmp(toml->rest, "\xEF\xBB\xBF", 3) == 0)
        toml->rest += 3;
}

bool toml_next(struct toml *toml)
{
    skip_mark(toml);
    while (*toml->rest) {
        const char *text = toml->rest;
        size_t len = strcspn(text, "\n");
        toml->rest += len + (text[len] == '\n');
        text = store_text(toml->store, text, len && text[len - 1] == '\r' ? len - 1 : len);
        *toml = (struct toml){toml->store, toml->rest, text, toml->number + 1};
        if (ends(text))
            continue;
        text = skip_space(text);
        if (*text == '[')
            read_table(toml, text + 1);
        else
            read_pair(toml, text);
        return true;
    }
    return false;
}

/* ---- Values ---- */

/* The base of a number by its prefix; moves behind the prefix. */
static unsigned base_of(const char **at)
{
    static const struct {
        const char *prefix;
        unsigned base;
    } bases[] = {{"0x", 16}, {"0o", 8}, {"0b", 2}};
    for (size_t i = 0; i < sizeof bases / sizeof *bases; ++i) {
        if (strncmp(*at, bases[i].prefix, 2) == 0) {
            *at += 2;
            return bases[i].base;
        }
    }
    *at += **at == '+';
    return 10;
}

static unsigned digit_of(char c)
{
    return c >= '0' && c <= '9'   ? (unsigned)(c - '0')
           : c >= 'a' && c <= 'f' ? (unsigned)(c - 'a') + 10
           : c >= 'A' && c <= 'F' ? (unsigned)(c - 'A') + 10
                                  : 99;
}

bool toml_number(struct toml_part value, uint64_t *out)
{
    const char *at = value.at;
    unsigned base = base_of(&at);
    const char *begin = at;
    *out = 0;
    for (; digit_of(*at) < base || *at == '_'; ++at) {
        if (*at == '_' && (at == begin || at[-1] == '_' || digit_of(at[1]) >= base))
            return false;
        if (*at != '_' && *out > (UINT64_MAX - digit_of(*at)) / base)
            return false;
        if (*at != '_')
            *out = *out * base + digit_of(*at);
    }
    return at > begin && at == value.at + value.len
           && !(base == 10 && *begin == '0' && at > begin + 1);
}

const char *toml_type(struct toml_part value)
{
    const char *at = value.at;
    size_t digits = strspn(at, "0123456789_");
    if (is_quote(*at))
        return "a string";
    if (*at == '[')
        return "an array";
    if (*at == '{')
        return "a table";
    if (strncmp(at, "true", 4) == 0 || strncmp(at, "false", 5) == 0)
        return "a boolean";
    if (digits && at[digits] == '-')
        return "a date";
    if (digits && at[digits] == ':')
        return "a time";
    at += *at == '+' || *at == '-';
    digits = strspn(at, "0123456789_");
    if ((digits && at[digits] && strchr(".eE", at[digits])) || strncmp(at, "inf", 3) == 0
        || strncmp(at, "nan", 3) == 0)
        return "a number with a fraction";
    return NULL;
}

/*
 * Writes the text of a value that is no array, and moves behind both. False: there is none.
 */
static bool read_item(const char **at, char **out)
{
    bool is_quoted = is_quote(**at);
    size_t len = is_quoted ? quoted_length(*at) : strcspn(*at, " \t,[]{}#=");
    if (!len || (is_quoted && (len < 2 || (*at)[len - 1] != **at)))
        return false;
    size_t text_len = is_quoted ? len - 2 : len;
    memcpy(*out, *at + is_quoted, text_len);
    *out += text_len;
    *at += len;
    return true;
}

const char *toml_text(struct store *store, struct toml_part value)
{
    const char *at = value.at, *end = at + value.len;
    char *text = store_alloc(store, value.len + 1), *out = text;
    if (*at != '[')
        return value.len && read_item(&at, &out) && at == end ? text : NULL;
    for (at = skip_space(at + 1); *at != ']'; at = skip_space(at)) {
        if (out > text)
            *out++ = ',';
        if (!read_item(&at, &out))
            return NULL;
        at = skip_space(at);
        if (*at == ',')
            ++at;
        else if (*at != ']')
            return NULL;
    }
    return at + 1 == end ? text : NULL;
}
