// SPDX-License-Identifier: Apache-2.0
/* Numbers as text, independent of the locale. */
#ifndef MXG_BASE_NUM_H
#define MXG_BASE_NUM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { NUM_FLOAT_MAX = 32 }; /* bytes that num_print_float may write */

/*
 * Shortest decimal that reads back to the same float; see text_float. Returns its length; no NUL is
 * written.
 */
size_t num_print_float(char *out, float value);

/*
 * Reads a decimal at `text`: sign, digits, fraction, exponent, as the MaterialX and GLSL grammars
 * have them. Returns the bytes read, 0 where no number stands there. Values beyond float's range
 * give an infinity or 0.
 */
size_t num_parse_float(const char *text, size_t len, float *out_value);

/* A decimal or 0x integer with optional sign; 0 where there is none or where it does not fit. */
size_t num_parse_int(const char *text, size_t len, int64_t *out_value);

#endif
