// SPDX-License-Identifier: Apache-2.0
#include "base/num.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/*
 * Powers of ten that are exact in double: a product or quotient with an integer below 2^53 rounds
 * once.
 */
static const double exact_pow10[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                     1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                     1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

enum { MAX_EXACT_POW10 = 22 };

#define LOG10_2 0.30102999566398120

static double scale_pow10(double value, int exponent)
{
    for (; exponent > MAX_EXACT_POW10; exponent -= MAX_EXACT_POW10)
        value *= 1e22;
    for (; exponent < -MAX_EXACT_POW10; exponent += MAX_EXACT_POW10)
        value /= 1e22;
    return exponent >= 0 ? value * exact_pow10[exponent] : value / exact_pow10[-exponent];
}

/*
 * The fewest digits (as an integer), and the exponent of the last one, with digits * 10^exponent ==
 * value > 0. Nine digits distinguish all floats.
 */
static uint32_t shortest_digits(float value, int exponent, int *out_exponent)
{
    for (;; exponent--) {
        uint32_t digits = (uint32_t)(scale_pow10((double)value, -exponent) + 0.5);
        if ((float)scale_pow10((double)digits, exponent) == value || digits >= 100000000) {
            *out_exponent = exponent;
            return digits;
        }
    }
}

static size_t put(char *out, const char *text)
{
    size_t len = strlen(text);
    memcpy(out, text, len);
    return len;
}

static size_t print_scientific(char *out, const char *digits, size_t num_digits, int magnitude)
{
    size_t n = 0;
    out[n++] = digits[0];
    if (num_digits > 1) {
        out[n++] = '.';
        memcpy(out + n, digits + 1, num_digits - 1);
        n += num_digits - 1;
    }
    out[n++] = 'e';
    if (magnitude < 0)
        out[n++] = '-';
    int m = magnitude < 0 ? -magnitude : magnitude;
    if (m >= 10)
        out[n++] = (char)('0' + m / 10);
    out[n++] = (char)('0' + m % 10);
    return n;
}

static size_t print_fixed(char *out, const char *digits, size_t num_digits, int magnitude)
{
    size_t n = 0;
    if (magnitude < 0) {
        n = put(out, "0.");
        for (int i = -1; i > magnitude; i--)
            out[n++] = '0';
        memcpy(out + n, digits, num_digits);
        return n + num_digits;
    }
    size_t whole = (size_t)magnitude + 1;
    for (size_t i = 0; i < whole; i++)
        out[n++] = i < num_digits ? digits[i] : '0';
    out[n++] = '.';
    if (num_digits <= whole)
        out[n++] = '0';
    for (size_t i = whole; i < num_digits; i++)
        out[n++] = digits[i];
    return n;
}

size_t num_print_float(char *out, float value)
{
    if (isnan(value))
        return put(out, "nan");
    size_t n = 0;
    if (signbit(value))
        out[n++] = '-';
    value = fabsf(value);
    if (isinf(value))
        return n + put(out + n, "inf");
    if (value == 0.0f)
        return n + put(out + n, "0.0");
    int exponent;
    int binary; /* value < 2^binary */
    frexpf(value, &binary);
    uint32_t integer = shortest_digits(value, (int)floor(binary * LOG10_2), &exponent);
    char buffer[20], *end = buffer + sizeof buffer, *digits = end;
    for (; integer; integer /= 10)
        *--digits = (char)('0' + integer % 10);
    int magnitude = exponent + (int)(end - digits) - 1;
    while (end[-1] == '0')
        end--;
    bool fixed = magnitude >= -5 && magnitude < 9;
    return n
           + (fixed ? print_fixed : print_scientific)(out + n, digits, (size_t)(end - digits),
                                                      magnitude);
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

struct decimal {
    uint64_t digits; /* leading digits, as many as fit */
    int exponent;    /* of the last one */
    bool any;
};

static size_t scan_digits(const char *text, size_t len, size_t at, bool fraction, struct decimal *d)
{
    for (; at < len && is_digit(text[at]); at++) {
        d->any = true;
        if (d->digits < UINT64_MAX / 10 - 9) {
            d->digits = d->digits * 10 + (uint64_t)(text[at] - '0');
            d->exponent -= fraction;
        } else {
            d->exponent += !fraction; /* beyond 19 digits nothing can change a float */
        }
    }
    return at;
}

static size_t scan_exponent(const char *text, size_t len, size_t at, struct decimal *d)
{
    size_t p = at;
    if (p >= len || (text[p] != 'e' && text[p] != 'E'))
        return at;
    p++;
    bool negative = p < len && text[p] == '-';
    if (p < len && (text[p] == '-' || text[p] == '+'))
        p++;
    if (p >= len || !is_digit(text[p]))
        return at;
    int exponent = 0;
    for (; p < len && is_digit(text[p]); p++)
        exponent = exponent < 1000 ? exponent * 10 + (text[p] - '0') : exponent;
    d->exponent += negative ? -exponent : exponent;
    return p;
}

size_t num_parse_float(const char *text, size_t len, float *out_value)
{
    size_t at = 0;
    bool negative = len > 0 && text[0] == '-';
    if (len > 0 && (text[0] == '-' || text[0] == '+'))
        at++;
    struct decimal d = {0};
    at = scan_digits(text, len, at, false, &d);
    if (at < len && text[at] == '.')
        at = scan_digits(text, len, at + 1, true, &d);
    if (!d.any)
        return 0;
    at = scan_exponent(text, len, at, &d);
    double value = 0.0;
    if (d.digits && d.exponent > 60)
        value = INFINITY;
    else if (d.digits && d.exponent > -90)
        value = scale_pow10((double)d.digits, d.exponent);
    *out_value = (float)(negative ? -value : value);
    return at;
}

static int digit_value(char c, int base)
{
    int v = c >= '0' && c <= '9'   ? c - '0'
            : c >= 'a' && c <= 'f' ? c - 'a' + 10
            : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                   : 99;
    return v < base ? v : -1;
}

size_t num_parse_int(const char *text, size_t len, int64_t *out_value)
{
    size_t at = 0;
    bool negative = len > 0 && text[0] == '-';
    if (len > 0 && (text[0] == '-' || text[0] == '+'))
        at++;
    int base = 10;
    if (len - at > 2 && text[at] == '0' && (text[at + 1] == 'x' || text[at + 1] == 'X')) {
        base = 16;
        at += 2;
    }
    size_t start = at;
    int64_t value = 0;
    for (; at < len && digit_value(text[at], base) >= 0; at++) {
        if (value > (INT64_MAX - 15) / base)
            return 0;
        value = value * base + digit_value(text[at], base);
    }
    *out_value = negative ? -value : value;
    return at > start ? at : 0;
}

int num_compare(const void *a, const void *b)
{
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

void num_sort(uint32_t *numbers, size_t count)
{
    if (count > 1)
        qsort(numbers, count, sizeof *numbers, num_compare);
}
