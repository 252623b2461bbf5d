// SPDX-License-Identifier: Apache-2.0
/* JSON (RFC 8259): written to a stream without white space, and read into a tree. */
#ifndef MXG_CLI_JSON_H
#define MXG_CLI_JSON_H

#include "cli/store.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* ---- Writing ---- */

struct json_writer {
    FILE *out;
    bool comma; /* an item stands before the next one */
};

/*
 * Items of an object are written by json_key and a value; '{' and '[' begin what '}' and ']' end.
 */
void json_begin(struct json_writer *json, char bracket);
void json_end(struct json_writer *json, char bracket);
void json_key(struct json_writer *json, const char *key);
/* bytes that are no UTF-8 become U+FFFD */
void json_string(struct json_writer *json, const char *text);
void json_number(struct json_writer *json, double value); /* with at most three decimals */
void json_count(struct json_writer *json, uint64_t value);
void json_bool(struct json_writer *json, bool value);

/* The item `key` of an object; nothing where the text is NULL or empty, or the number 0. */
void json_put_string(struct json_writer *json, const char *key, const char *text);
void json_put_count(struct json_writer *json, const char *key, uint64_t value);
void json_put_number(struct json_writer *json, const char *key, double value);

/* ---- Reading ---- */

enum json_kind {
    JSON_NULL,
    JSON_FALSE,
    JSON_TRUE,
    JSON_NUMBER,
    JSON_STRING,
    JSON_ARRAY,
    JSON_OBJECT
};

struct json_value {
    enum json_kind kind;
    const char *key;  /* in an object */
    const char *text; /* of a string, with NUL */
    double number;
    const struct json_value *first, *next; /* its items; the item behind it */
};

/* NULL where the text is not JSON, or nested deeper than 64. The tree lives in the store. */
const struct json_value *json_parse(struct store *store, const char *text, size_t len);

/* Never NULL: what is not there, or of another kind, is a null, empty or 0. */
const struct json_value *json_get(const struct json_value *object, const char *key);
const char *json_get_text(const struct json_value *object, const char *key);
double json_get_number(const struct json_value *object, const char *key);
uint64_t json_get_count(const struct json_value *object, const char *key);

#endif
