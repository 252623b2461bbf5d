// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_CLI_UTF8_H
#define MXG_CLI_UTF8_H

#include <stdbool.h>
#include <stddef.h>

/*
 * Bytes of the UTF-8 sequence at the start of a text that ends with NUL (Unicode 15, table 3-7); 0
 * where none begins.
 */
size_t utf8_length(const char *bytes);

bool utf8_is_valid(const char *text);

/*
 * The text with U+FFFD in place of each byte that is part of no character, to be freed; ends the
 * program where there is no memory.
 */
char *utf8_repair(const char *text);

#endif
