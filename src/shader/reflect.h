// SPDX-License-Identifier: Apache-2.0
/* reflect.c: what the reflection of a shader and that of a network write alike. */
#ifndef MXG_SHADER_REFLECT_H
#define MXG_SHADER_REFLECT_H

#include "base/json.h"
#include "shader/shader.h"

struct reflect {
    struct json json;
    const struct shader *shader;
    const struct shader_reflect_options *options;
};

/* An item of an object whose value is an interned string of the shader; none for the empty one. */
void reflect_id(struct reflect *r, const char *key, str_id value);
/* An item of an object with a number, a truth value, or a flat array of them. */
void reflect_value(struct json *json, const char *key, const struct ir_value *value);

#endif
