// SPDX-License-Identifier: Apache-2.0
#include "shader/json.h"

#include <math.h>

void reflect_item(struct json *json)
{
    text_str(json->out, json->first ? "\n" : ",\n");
    for (unsigned i = 0; i < json->depth; i++)
        text_mem(json->out, "  ", 2);
    json->first = false;
}

void reflect_open(struct json *json, char bracket)
{
    text_char(json->out, bracket);
    json->depth++;
    json->first = true;
}

void reflect_close(struct json *json, char bracket)
{
    json->depth--;
    if (!json->first) {
        json->first = true;
        reflect_item(json);
    }
    text_char(json->out, bracket);
    json->first = false;
}

void reflect_key(struct json *json, const char *name)
{
    reflect_item(json);
    text_json_string(json->out, name, strlen(name));
    text_mem(json->out, ": ", 2);
}

void reflect_string(struct json *json, const char *name, const char *value)
{
    if (!value || !*value)
        return;
    reflect_key(json, name);
    text_json_string(json->out, value, strlen(value));
}

void reflect_id(struct json *json, const char *name, str_id value)
{
    reflect_string(json, name, str_text(json->shader->strings, value));
}

void reflect_number(struct json *json, const char *name, uint32_t value)
{
    reflect_key(json, name);
    text_u32(json->out, value);
}

void reflect_nonzero(struct json *json, const char *name, uint32_t value)
{
    if (value)
        reflect_number(json, name, value);
}

void reflect_bool(struct json *json, const char *name, bool value)
{
    reflect_key(json, name);
    text_str(json->out, value ? "true" : "false");
}

/* JSON has no word for infinities and NaN. */
static void write_scalar(struct text *out, ir_type_id scalar, union ir_word word)
{
    if (scalar == IR_TYPE_BOOL)
        text_str(out, word.u ? "true" : "false");
    else if (scalar == IR_TYPE_INT)
        text_i32(out, word.i);
    else if (scalar == IR_TYPE_UINT)
        text_u32(out, word.u);
    else if (!isfinite(word.f))
        text_str(out, "null");
    else
        text_float(out, word.f);
}

void reflect_value(struct json *json, const char *name, const struct ir_value *value)
{
    const struct ir_type_info *info = ir_type_info(value->type);
    reflect_key(json, name);
    if (info->components > 1)
        text_char(json->out, '[');
    for (unsigned i = 0; i < info->components; i++) {
        if (i)
            text_mem(json->out, ", ", 2);
        write_scalar(json->out, info->scalar, value->w[i]);
    }
    if (info->components > 1)
        text_char(json->out, ']');
}
