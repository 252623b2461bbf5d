// SPDX-License-Identifier: Apache-2.0
#include "cli/json.h"

#include "cli/utf8.h"

#include <inttypes.h>
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

static void write_quoted(FILE *out, const char *text)
{
    putc('"', out);
    for (const char *c = text; *c;) {
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
