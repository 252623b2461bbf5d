// SPDX-License-Identifier: Apache-2.0
/* Tables as lines of fields, which is what reference values are kept in. */
#ifndef MXG_TESTS_CONFORMANCE_LINES_H
#define MXG_TESTS_CONFORMANCE_LINES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Room for one more item behind `len`; exits where there is no memory. */
void *lines_grow(void *items, size_t len, size_t size);

/* "<folder>/<inner>/<name><end>"; to be freed. */
char *lines_path(const char *folder, const char *inner, const char *name, const char *end);

/* Opens to read; NULL after printing that it cannot be opened. */
FILE *lines_open(const char *path);

/* The next line, without its end, in *line, which getline owns. */
bool lines_next(FILE *file, char **line, size_t *room);

/* Cuts the field in front off *rest. */
char *lines_field(char **rest, char separator);

#endif
