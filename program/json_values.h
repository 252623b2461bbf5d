// SPDX-License-Identifier: Apache-2.0
/* JSON functions of all programs, beyond Jansson's. */
#ifndef MXG_PROGRAM_JSON_VALUES_H
#define MXG_PROGRAM_JSON_VALUES_H

#include <jansson.h>

#include <stdint.h>

/* The JSON style: no white space, and enough digits for times. */
#define JSON_STYLE (JSON_COMPACT | JSON_REAL_PRECISION(15))

/* Makes the program end if memory for JSON is exhausted. */
void json_use_memory(void);

/* A string; bytes that are no UTF-8 become U+FFFD. NULL is the empty text. */
json_t *json_text(const char *text);

/* Sets a member; the key may be any text. Takes ownership of the value. */
void json_set(json_t *object, const char *key, json_t *value);

/* Sets a member to a text or a count; does nothing for NULL, "" or 0. */
void json_set_text(json_t *object, const char *key, const char *text);
void json_set_count(json_t *object, const char *key, uint64_t count);

/*
 * A member of a value, which may be no object; "" or 0 if the member is missing, has another type,
 * or is negative.
 */
const char *json_text_of(const json_t *object, const char *key);
uint64_t json_count_of(const json_t *object, const char *key);

#endif
