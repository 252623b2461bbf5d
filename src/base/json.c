// SPDX-License-Identifier: Apache-2.0
#include "base/json.h"

#include <assert.h>
#include <string.h>

void json_open(struct json *json, char bracket)
{
    assert(bracket == '[' || bracket == '{');
    text_char(json->out, bracket);
    json->depth++;
    json->has_items = false;
}

void json_open_flat(struct json *json, char bracket)
{
    json_open(json, bracket);
    if (!json->flat_depth)
        json->flat_depth = json->depth;
}

static void begin_line(struct json *json)
{
    text_char(json->out, '\n');
    for (unsigned i = 0; i < json->depth; i++)
        text_mem(json->out, "  ", 2);
}

void json_close(struct json *json, char bracket)
{
    assert(json->depth > 0 && json->flat_depth <= json->depth);
    bool is_flat = json->flat_depth != 0;
    json->depth--;
    if (json->has_items && !is_flat)
        begin_line(json);
    text_char(json->out, bracket);
    if (json->flat_depth > json->depth)
        json->flat_depth = 0;
    json->has_items = true;
}

void json_item(struct json *json)
{
    if (json->has_items)
        text_char(json->out, ',');
    if (!json->flat_depth)
        begin_line(json);
    else if (json->has_items)
        text_char(json->out, ' ');
    json->has_items = true;
}

void json_key(struct json *json, const char *key)
{
    json_item(json);
    text_json_string(json->out, key, strlen(key));
    text_mem(json->out, ": ", 2);
}

void json_put_text(struct json *json, const char *key, const char *value)
{
    if (!value || !*value)
        return;
    json_key(json, key);
    text_json_string(json->out, value, strlen(value));
}

void json_put_number(struct json *json, const char *key, uint32_t value)
{
    json_key(json, key);
    text_u32(json->out, value);
}

void json_put_nonzero(struct json *json, const char *key, uint32_t value)
{
    if (value)
        json_put_number(json, key, value);
}

void json_put_bool(struct json *json, const char *key, bool value)
{
    json_key(json, key);
    text_str(json->out, value ? "true" : "false");
}
