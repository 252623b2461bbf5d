// SPDX-License-Identifier: Apache-2.0
/*
 * Writes JSON (RFC 8259). Every item of an array or object stands on a line of its own, unless the
 * array or object is flat: then it stands on one line with all that is in it.
 */
#ifndef MXG_BASE_JSON_H
#define MXG_BASE_JSON_H

#include "base/text.h"

#include <stdbool.h>

/* Zero but for `out` at first. */
struct json {
    struct text *out;
    unsigned depth;
    unsigned flat_depth; /* of the outermost flat array or object around; 0: there is none */
    bool has_items;      /* the array or object at hand has some already */
};

/* A value begins an array or object with '[' or '{', which ']' or '}' ends. */
void json_open(struct json *json, char bracket);
void json_open_flat(struct json *json, char bracket);
void json_close(struct json *json, char bracket);

/* An item of an array follows, or one of an object with its key. */
void json_item(struct json *json);
void json_key(struct json *json, const char *key);

/* An item of an object with its value; json_put_text and json_put_nonzero leave out empty texts,
 * NULL and 0. */
void json_put_text(struct json *json, const char *key, const char *value);
void json_put_number(struct json *json, const char *key, uint32_t value);
void json_put_nonzero(struct json *json, const char *key, uint32_t value);
void json_put_bool(struct json *json, const char *key, bool value);

#endif
