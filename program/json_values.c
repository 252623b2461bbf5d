// SPDX-License-Identifier: Apache-2.0
#include "program/json_values.h"

#include "program/memory.h"
#include "program/utf8.h"

#include <stdlib.h>

void json_use_memory(void)
{
    json_set_alloc_funcs(memory_alloc, free);
}

json_t *json_text(const char *text)
{
    json_t *string = json_string(text ? text : "");
    if (string)
        return string;
    char *repaired = utf8_repair(text);
    string = json_string(repaired);
    free(repaired);
    return string;
}

void json_set(json_t *object, const char *key, json_t *value)
{
    json_t *name = json_text(key);
    json_object_set_new_nocheck(object, json_string_value(name), value);
    json_decref(name);
}

void json_set_text(json_t *object, const char *key, const char *text)
{
    if (text && *text)
        json_object_set_new(object, key, json_text(text));
}

void json_set_count(json_t *object, const char *key, uint64_t count)
{
    if (count)
        json_object_set_new(object, key, json_integer((json_int_t)count));
}

const char *json_text_of(const json_t *object, const char *key)
{
    const char *text = json_string_value(json_object_get(object, key));
    return text ? text : "";
}

uint64_t json_count_of(const json_t *object, const char *key)
{
    json_int_t count = json_integer_value(json_object_get(object, key));
    return count > 0 ? (uint64_t)count : 0;
}
