// SPDX-License-Identifier: Apache-2.0
#include "cli/json.h"

#include "cli/utf8.h"

#include <math.h>

static void begin_item(struct json_writer *json)
{
    if (json->comma)
        putc(',', json->out);
    json->comma = true;
}

void json_begin(struct json_writer *json, char bracket)
{
    begin_item(json);
    putc(bracket, json->out);
    json->comma = false;
}

void json_end(struct json_writer *json, char bracket)
{
    putc(bracket, json->out);
    json->comma = true;
}

/* How many characters stand for themselves. */
static size_t plain_length(const char *text)
{
    size_t len = 0;
    for (unsigned char c;
         c = (unsigned char)text[len], c >= 0x20 && c < 0x80 && c != '"' && c != '\\';)
        ++len;
    return len;
}

/* One character that is not plain; returns how many bytes it has. */
static size_t write_special(FILE *out, const char *c)
{
    size_t len = utf8_length(c);
    if (len == 0)
        fputs("\\ufffd", out);
    else if (*c == '"' || *c == '\\')
        fprintf(out, "\\%c", *c);
    else if (*c == '\n')
        fputs("\\n", out);
    else if ((unsigned char)*c < 0x20)
        fprintf(out, "\\u%04x", (unsigned)*c);
    else
        fwrite(c, 1, len, out);
    return len ? len : 1;
}

static void write_quoted(FILE *out, const char *text)
{
    putc('"', out);
    for (const char *c = text; *c;) {
        size_t plain = plain_length(c);
        if (plain)
            fwrite(c, 1, plain, out);
        c += plain;
        if (*c)
            c += write_special(out, c);
    }
    putc('"', out);
}

void json_key(struct json_writer *json, const char *key)
{
    begin_item(json);
    write_quoted(json->out, key);
    putc(':', json->out);
    json->comma = false;
}

void json_string(struct json_writer *json, const char *text)
{
    begin_item(json);
    write_quoted(json->out, text);
}

/* Backwards from `end`; returns where it begins. */
static char *put_digits(char *end, uint64_t value)
{
    do
        *--end = (char)('0' + value % 10);
    while (value /= 10);
    return end;
}

void json_number(struct json_writer *json, double value)
{
    char digits[32], *end = digits + sizeof digits, *begin;
    if (!(value >= 0.0 && value < 1e9)) {
        begin_item(json);
        fprintf(json->out, "%.15g", round(value * 1000.0) / 1000.0);
        return;
    }
    uint64_t thousandths = (uint64_t)round(value * 1000.0);
    json_count(json, thousandths / 1000);
    if (thousandths % 1000 == 0)
        return;
    for (begin = put_digits(end, thousandths % 1000 + 1000); end[-1] == '0';)
        --end;
    *begin = '.'; /* in place of the 1 before three digits */
    fwrite(begin, 1, (size_t)(end - begin), json->out);
}

void json_count(struct json_writer *json, uint64_t value)
{
    char digits[32], *end = digits + sizeof digits, *begin = put_digits(end, value);
    begin_item(json);
    fwrite(begin, 1, (size_t)(end - begin), json->out);
}

void json_bool(struct json_writer *json, bool value)
{
    begin_item(json);
    fputs(value ? "true" : "false", json->out);
}

void json_put_string(struct json_writer *json, const char *key, const char *text)
{
    if (!text || !*text)
        return;
    json_key(json, key);
    json_string(json, text);
}

void json_put_count(struct json_writer *json, const char *key, uint64_t value)
{
    if (value == 0)
        return;
    json_key(json, key);
    json_count(json, value);
}

void json_put_number(struct json_writer *json, const char *key, double value)
{
    if (value == 0.0)
        return;
    json_key(json, key);
    json_number(json, value);
}
