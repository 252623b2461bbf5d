// SPDX-License-Identifier: Apache-2.0
/* Conversion between numbers and text, independent of the locale. */
#ifndef MXG_BASE_NUM_H
#define MXG_BASE_NUM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { NUM_FLOAT_MAX = 32 }; /* maximum number of bytes that num_print_float writes */

/*
 * Prints the shortest decimal that parses to the same float; see text_float. Returns its length and
 * writes no NUL.
 */
size_t num_print_float(char *out, float value);

/*
 * Parses a decimal with sign, digits, fraction and exponent, as in the grammars of MaterialX and
 * GLSL. Returns the number of bytes, or 0 if there is no number. Values beyond the range of float
 * become an infinity or 0.
 */
size_t num_parse_float(const char *text, size_t len, float *out_value);

/* Parses a decimal or 0x integer with an optional sign; 0 if there is none or it does not fit. */
size_t num_parse_int(const char *text, size_t len, int64_t *out_value);

/* The order of two uint32_t, for bsearch. */
int num_compare(const void *a, const void *b);
/* Sorts numbers, the lowest first. */
void num_sort(uint32_t *numbers, size_t count);

/* True for a whole number from -2^24 to 2^24; between these floats have every integer. */
static inline bool num_is_exact_integer(float value)
{
    const float most = 16777216.0f;
    return value >= -most && value <= most && value == (float)(int32_t)value;
}

#endif
