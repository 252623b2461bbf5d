// SPDX-License-Identifier: Apache-2.0
#include "cli/json.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

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

/* Bytes of the UTF-8 sequence that begins here (Unicode 15, table 3-7); 0 where none does. */
static size_t utf8_length(const unsigned char *text)
{
    unsigned char lead = text[0], low = 0x80, high = 0xbf;
    if (lead < 0x80)
        return 1;
    size_t len = lead >= 0xc2 && lead <= 0xdf ? 2 : lead >= 0xe0 && lead <= 0xef ? 3 : lead >= 0xf0 && lead <= 0xf4 ? 4 : 0;
    if (lead == 0xe0)
        low = 0xa0;
    else if (lead == 0xed)
        high = 0x9f;
    else if (lead == 0xf0)
        low = 0x90;
    else if (lead == 0xf4)
        high = 0x8f;
    for (size_t i = 1; i < len; ++i) {
        if (text[i] < low || text[i] > high)
            return 0;
        low = 0x80;
        high = 0xbf;
    }
    return len;
}

static void write_quoted(FILE *out, const char *text)
{
    putc('"', out);
    for (const unsigned char *c = (const unsigned char *)text; *c;) {
        size_t len = utf8_length(c);
        if (len == 0)
            fputs("\\ufffd", out);
        else if (*c == '"' || *c == '\\')
            fprintf(out, "\\%c", *c);
        else if (*c == '\n')
            fputs("\\n", out);
        else if (*c < 0x20)
            fprintf(out, "\\u%04x", *c);
        else
            fwrite(c, 1, len, out);
        c += len ? len : 1;
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

void json_number(struct json_writer *json, double value)
{
    begin_item(json);
    fprintf(json->out, "%.15g", round(value * 1000.0) / 1000.0);
}

void json_count(struct json_writer *json, uint64_t value)
{
    begin_item(json);
    fprintf(json->out, "%" PRIu64, value);
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
