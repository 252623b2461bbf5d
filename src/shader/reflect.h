// SPDX-License-Identifier: Apache-2.0
/* reflect.c: the functions that the reflections of shaders and networks share. */
#ifndef MXG_SHADER_REFLECT_H
#define MXG_SHADER_REFLECT_H

#include "base/json.h"
#include "shader/shader.h"

struct reflect {
    struct json json;
    const struct shader *shader;
    const struct shader_reflect_options *options;
};

/* Writes an item with an interned string of the shader; nothing for the empty string. */
void reflect_id(struct reflect *r, const char *key, str_id value);
/* Writes an item with a number, a truth value, or a flat array of these. */
void reflect_value(struct json *json, const char *key, const struct ir_value *value);

#endif
