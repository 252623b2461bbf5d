// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_CLI_UTF8_H
#define MXG_CLI_UTF8_H

#include <stddef.h>

/*
 * Bytes of the UTF-8 sequence at the start of a text that ends with NUL (Unicode 15, table 3-7); 0
 * where none begins.
 */
size_t utf8_length(const char *text);

#endif
