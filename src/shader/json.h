// SPDX-License-Identifier: Apache-2.0
/*
 * json_write.c: JSON with an item per line; keys whose value says nothing are left out by the
 * functions that take text.
 */
#ifndef MXG_SHADER_JSON_H
#define MXG_SHADER_JSON_H

#include "shader/shader.h"

struct json {
    const struct shader *shader;
    const struct shader_reflect_options *options;
    struct text *out;
    unsigned depth;
    bool first; /* nothing stands yet in the object or array at hand */
};

void reflect_item(struct json *json);
void reflect_open(struct json *json, char bracket);
void reflect_close(struct json *json, char bracket);
void reflect_key(struct json *json, const char *name);
void reflect_string(struct json *json, const char *name, const char *value);
void reflect_id(struct json *json, const char *name, str_id value);
void reflect_number(struct json *json, const char *name, uint32_t value);
void reflect_nonzero(struct json *json, const char *name, uint32_t value);
void reflect_bool(struct json *json, const char *name, bool value);
void reflect_value(struct json *json, const char *name, const struct ir_value *value);

#endif
