// SPDX-License-Identifier: Apache-2.0
#include "cli/json.h"

#include <stdlib.h>
#include <string.h>

#define MAX_DEPTH 64

/*
 * A text with a NUL behind it, so that no look ahead needs the end. It is ours: strings are decoded
 * where they stand.
 */
struct reader {
    struct store *store;
    char *at;
    unsigned depth;
};

static struct json_value *read_value(struct reader *reader);

static void skip_space(struct reader *reader)
{
    while (*reader->at == ' ' || *reader->at == '\n' || *reader->at == '\r' || *reader->at == '\t')
        ++reader->at;
}

/* A character that must stand here, after white space. */
static bool accept(struct reader *reader, char c)
{
    skip_space(reader);
    if (*reader->at != c)
        return false;
    ++reader->at;
    return true;
}

/* Four hexadecimal digits; -1 for anything else. */
static long read_hex(struct reader *reader)
{
    long value = 0;
    for (int i = 0; i < 4; ++i, ++reader->at) {
        static const char digits[] = "0123456789abcdef0123456789ABCDEF";
        const char *digit = *reader->at ? strchr(digits, *reader->at) : NULL;
        if (!digit)
            return -1;
        value = value * 16 + (digit - digits) % 16;
    }
    return value;
}

static char *put_utf8(char *out, unsigned long code)
{
    if (code < 0x80) {
        *out++ = (char)code;
        return out;
    }
    int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    static const unsigned char leads[] = {0, 0xc0, 0xe0, 0xf0};
    *out++ = (char)(leads[more] | code >> (6 * more));
    while (more--)
        *out++ = (char)(0x80 | ((code >> (6 * more)) & 0x3f));
    return out;
}

/* Behind "\u": one unit, or a pair of surrogates. */
static char *read_unicode(struct reader *reader, char *out)
{
    long code = read_hex(reader);
    if (code >= 0xd800 && code < 0xdc00 && reader->at[0] == '\\' && reader->at[1] == 'u') {
        reader->at += 2;
        long low = read_hex(reader);
        code =
            low >= 0xdc00 && low < 0xe000 ? 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00) : -1;
    }
    return code <= 0 || (code >= 0xd800 && code < 0xe000) ? NULL
                                                          : put_utf8(out, (unsigned long)code);
}

static char *read_escape(struct reader *reader, char *out)
{
    static const char names[] = "\"\\/bfnrt", values[] = "\"\\/\b\f\n\r\t";
    char name = *reader->at++;
    if (name == 'u')
        return read_unicode(reader, out);
    const char *found = name ? strchr(names, name) : NULL;
    if (!found)
        return NULL;
    *out++ = values[found - names];
    return out;
}

/* A string, which is never longer than its spelling. NULL where it is none. */
static char *read_string(struct reader *reader)
{
    if (!accept(reader, '"'))
        return NULL;
    char *text = reader->at, *out = text;
    while (*reader->at != '"') {
        char *begin = reader->at;
        while ((unsigned char)*reader->at >= 0x20 && *reader->at != '"' && *reader->at != '\\')
            ++reader->at;
        size_t len = (size_t)(reader->at - begin);
        if (out != begin)
            memmove(out, begin, len);
        out += len;
        if ((unsigned char)*reader->at < 0x20)
            return NULL;
        if (*reader->at == '"')
            break;
        ++reader->at;
        out = read_escape(reader, out);
        if (!out)
            return NULL;
    }
    ++reader->at;
    *out = '\0';
    return text;
}

static struct json_value *new_value(struct reader *reader, enum json_kind kind)
{
    struct json_value *value = store_alloc(reader->store, sizeof *value);
    value->kind = kind;
    return value;
}

/* Items up to the closing bracket, each with its key in an object. */
static struct json_value *read_items(struct reader *reader, enum json_kind kind, char end)
{
    struct json_value *parent = new_value(reader, kind);
    if (accept(reader, end))
        return parent;
    const struct json_value **link = &parent->first;
    do {
        char *key = NULL;
        if (kind == JSON_OBJECT) {
            key = read_string(reader);
            if (!key || !accept(reader, ':'))
                return NULL;
        }
        struct json_value *item = read_value(reader);
        if (!item)
            return NULL;
        item->key = key;
        *link = item;
        link = &item->next;
    } while (accept(reader, ','));
    return accept(reader, end) ? parent : NULL;
}

/* Counts are read at once; what else there is takes strtod. */
static struct json_value *read_number(struct reader *reader)
{
    size_t len = strspn(reader->at, "+-.0123456789eE"), num_digits = 0;
    if (len == 0 || strchr("+.eE", *reader->at))
        return NULL;
    struct json_value *value = new_value(reader, JSON_NUMBER);
    for (uint64_t count = 0;
         num_digits < 15 && reader->at[num_digits] >= '0' && reader->at[num_digits] <= '9';) {
        count = count * 10 + (uint64_t)(reader->at[num_digits++] - '0');
        value->number = (double)count;
    }
    char *end = reader->at + num_digits;
    if (num_digits != len)
        value->number = strtod(reader->at, &end);
    if (end != reader->at + len)
        return NULL;
    reader->at = end;
    return value;
}

static struct json_value *read_word(struct reader *reader)
{
    static const struct {
        const char *text;
        enum json_kind kind;
    } words[] = {{"null", JSON_NULL}, {"false", JSON_FALSE}, {"true", JSON_TRUE}};
    for (size_t i = 0; i < sizeof words / sizeof *words; ++i) {
        size_t len = strlen(words[i].text);
        if (strncmp(reader->at, words[i].text, len) == 0) {
            reader->at += len;
            return new_value(reader, words[i].kind);
        }
    }
    return NULL;
}

static struct json_value *read_value(struct reader *reader)
{
    struct json_value *value = NULL;
    if (++reader->depth > MAX_DEPTH)
        return NULL;
    skip_space(reader);
    if (*reader->at == '"') {
        char *text = read_string(reader);
        value = text ? new_value(reader, JSON_STRING) : NULL;
        if (value)
            value->text = text;
    } else if (accept(reader, '{')) {
        value = read_items(reader, JSON_OBJECT, '}');
    } else if (accept(reader, '[')) {
        value = read_items(reader, JSON_ARRAY, ']');
    } else if (*reader->at == '-' || (*reader->at >= '0' && *reader->at <= '9')) {
        value = read_number(reader);
    } else {
        value = read_word(reader);
    }
    --reader->depth;
    return value;
}

const struct json_value *json_parse(struct store *store, const char *text, size_t len)
{
    char *copy = store_text(store, text, len);
    struct reader reader = {.store = store, .at = copy};
    struct json_value *value = read_value(&reader);
    if (!value)
        return NULL;
    skip_space(&reader);
    return reader.at == copy + len ? value : NULL;
}

const struct json_value *json_get(const struct json_value *object, const char *key)
{
    static const struct json_value none = {.kind = JSON_NULL};
    if (object->kind != JSON_OBJECT)
        return &none;
    for (const struct json_value *item = object->first; item; item = item->next)
        if (strcmp(item->key, key) == 0)
            return item;
    return &none;
}

const char *json_get_text(const struct json_value *object, const char *key)
{
    const struct json_value *value = json_get(object, key);
    return value->kind == JSON_STRING ? value->text : "";
}

double json_get_number(const struct json_value *object, const char *key)
{
    return json_get(object, key)->number;
}

uint64_t json_get_count(const struct json_value *object, const char *key)
{
    double number = json_get_number(object, key);
    return number > 0.0 && number < 9007199254740992.0 ? (uint64_t)number : 0; /* 2^53 */
}
