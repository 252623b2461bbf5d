// SPDX-License-Identifier: Apache-2.0
/* What records and reports need of JSON beside Jansson's functions. */
#ifndef MXG_CHECK_JSON_H
#define MXG_CHECK_JSON_H

#include <jansson.h>

#include <stdint.h>

/* How JSON is written: without white space, and with no more digits than times need. */
#define JSON_STYLE (JSON_COMPACT | JSON_REAL_PRECISION(15))

/* From now on the program ends where there is no memory for JSON. */
void json_use_memory(void);

/* A string; bytes that are no UTF-8 become U+FFFD. NULL is the empty text. */
json_t *json_text(const char *text);

/* Sets a member whose key may be any text; takes over the value. */
void json_set(json_t *object, const char *key, json_t *value);

/* Sets a member to a text or a count; does nothing where that is NULL, empty or 0. */
void json_set_text(json_t *object, const char *key, const char *text);
void json_set_count(json_t *object, const char *key, uint64_t count);

/* A member of what may be no object; "" or 0 where there is none of that kind, or it is below 0. */
const char *json_text_of(const json_t *object, const char *key);
uint64_t json_count_of(const json_t *object, const char *key);

#endif
