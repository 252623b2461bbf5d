// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_PROGRAM_UTF8_H
#define MXG_PROGRAM_UTF8_H

#include <stdbool.h>
#include <stddef.h>

/*
 * Length in bytes of the UTF-8 sequence at the start of a NUL-terminated text (Unicode 15, table
 * 3-7); 0 if none begins there.
 */
size_t utf8_length(const char *bytes);

/*
 * True for a character that people do not see and that terminals act on (src/base/hidden_chars.h),
 * and for a byte that is no UTF-8. `len`: utf8_length of the text.
 */
bool utf8_is_hidden(const char *text, size_t len);

/* Makes '?' of hidden characters but line ends and tabs, because texts of files go to terminals. */
void utf8_clean(char *text);

/*
 * The text with U+FFFD for each invalid byte, which the caller frees; ends the program if memory is
 * exhausted.
 */
char *utf8_repair(const char *text);

#endif
