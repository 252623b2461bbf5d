// SPDX-License-Identifier: Apache-2.0
/*
 * TOML 1.0 line by line, as far as a statement stands in one line: tables "[a]" and "[a.b]", and
 * pairs "key = value", with comments. Escapes in strings stay as they are.
 */
#ifndef MXG_PROGRAM_TOML_H
#define MXG_PROGRAM_TOML_H

#include "program/store.h"

#include <stdbool.h>
#include <stdint.h>

/* A part of a line. */
struct toml_part {
    const char *at;
    size_t len;
    const char *text; /* of a name: without quotes; NULL: there is none */
};

enum toml_kind {
    TOML_TABLE, /* begins with a bracket */
    TOML_PAIR,
    TOML_OTHER, /* neither; `name` is what stands in the place of a key */
};

/* A reader: set store, for copies of the lines, and rest, the text of a file. */
struct toml {
    struct store *store;
    const char *rest;
    /* the line, without its end */
    const char *line;
    uint32_t number; /* from 1 */
    enum toml_kind kind;
    struct toml_part name, sub; /* sub: of "[name.sub]"; at NULL: there is no dot */
    const char *stop;           /* where the head of a table is wrong; NULL: it is not */
    struct toml_part value;     /* of a pair, without spaces and comment around it */
};

/* Why the bytes of a file are no text of TOML; NULL: they are. */
const char *toml_fault(const char *text, size_t size);

/* Reads the next line that is not empty. False: there is none. */
bool toml_next(struct toml *toml);

/*
 * A whole number in any base of TOML: digits with a '_' between two of them, no 0 in front of
 * decimal ones. False: it is none, is negative, or is larger than 64 bits.
 */
bool toml_number(struct toml_part value, uint64_t *out);

/* The type of a value that is no whole number: "a string"; NULL: it has none. */
const char *toml_type(struct toml_part value);

/*
 * The text of a string, a number or a word, or of the items of an array, joined by commas. NULL:
 * the value is none of these.
 */
const char *toml_text(struct store *store, struct toml_part value);

#endif
