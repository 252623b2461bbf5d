// SPDX-License-Identifier: Apache-2.0
#include "check/signature.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { CELLS = 16, SIGNATURE_BYTES = CELLS * CELLS * 3 };

/* RFC 4648, section 4 */
static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

char *picture_base64(struct store *store, const void *data, size_t size)
{
    const unsigned char *bytes = data;
    char *text = store_alloc(store, (size + 2) / 3 * 4 + 1), *out = text;
    for (size_t i = 0; i < size; i += 3) {
        uint32_t group = (uint32_t)bytes[i] << 16;
        group |= i + 1 < size ? (uint32_t)bytes[i + 1] << 8 : 0;
        group |= i + 2 < size ? bytes[i + 2] : 0;
        *out++ = digits[group >> 18];
        *out++ = digits[group >> 12 & 63];
        *out++ = i + 1 < size ? digits[group >> 6 & 63] : '=';
        *out++ = i + 2 < size ? digits[group & 63] : '=';
    }
    return text;
}

/* A signature is a multiple of 3 bytes, so it has no padding. */
static bool read_signature(const char *text, unsigned char out[SIGNATURE_BYTES])
{
    if (strlen(text) != SIGNATURE_BYTES / 3 * 4)
        return false;
    for (size_t i = 0; i < SIGNATURE_BYTES / 3; ++i) {
        uint32_t group = 0;
        for (int k = 0; k < 4; ++k) {
            const char *digit = strchr(digits, *text++);
            if (!digit)
                return false;
            group = group << 6 | (uint32_t)(digit - digits);
        }
        out[3 * i] = (unsigned char)(group >> 16);
        out[3 * i + 1] = (unsigned char)(group >> 8);
        out[3 * i + 2] = (unsigned char)group;
    }
    return true;
}

char *picture_sign(struct store *store, const char *ppm, size_t size)
{
    unsigned width, height, most;
    int header = 0;
    if (sscanf(ppm, "P6 %5u %5u %3u%n", &width, &height, &most, &header) != 3 || most != 255
        || width < CELLS || height < CELLS
        || size < (size_t)header + 1 + (size_t)width * height * 3)
        return NULL;
    const unsigned char *pixels = (const unsigned char *)ppm + header + 1;
    uint32_t sums[SIGNATURE_BYTES] = {0}, counts[CELLS * CELLS] = {0};
    for (size_t y = 0; y < height; ++y) {
        for (size_t x = 0; x < width; ++x) {
            size_t cell = y * CELLS / height * CELLS + x * CELLS / width;
            for (size_t c = 0; c < 3; ++c)
                sums[3 * cell + c] += pixels[3 * (y * width + x) + c];
            ++counts[cell];
        }
    }
    unsigned char signature[SIGNATURE_BYTES];
    for (size_t i = 0; i < SIGNATURE_BYTES; ++i)
        signature[i] = (unsigned char)((sums[i] + counts[i / 3] / 2) / counts[i / 3]);
    return picture_base64(store, signature, sizeof signature);
}

/* CIE 15:2004, 8.2.1.1 */
static double lab_curve(double t)
{
    const double delta = 6.0 / 29.0;
    return t > delta * delta * delta ? cbrt(t) : t / (3.0 * delta * delta) + 4.0 / 29.0;
}

static void to_lab(const unsigned char *srgb, double lab[3])
{
    static const double to_xyz[3][3] = {/* IEC 61966-2-1, relative to the white point D65 */
                                        {0.4124 / 0.9505, 0.3576 / 0.9505, 0.1805 / 0.9505},
                                        {0.2126, 0.7152, 0.0722},
                                        {0.0193 / 1.0890, 0.1192 / 1.0890, 0.9505 / 1.0890}};
    double linear[3], f[3];
    for (int c = 0; c < 3; ++c) {
        double x = srgb[c] / 255.0;
        linear[c] = x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
    }
    for (int i = 0; i < 3; ++i)
        f[i] = lab_curve(to_xyz[i][0] * linear[0] + to_xyz[i][1] * linear[1]
                         + to_xyz[i][2] * linear[2]);
    lab[0] = 116.0 * f[1] - 16.0;
    lab[1] = 500.0 * (f[0] - f[1]);
    lab[2] = 200.0 * (f[1] - f[2]);
}

double picture_difference(const char *a, const char *b)
{
    unsigned char left[SIGNATURE_BYTES], right[SIGNATURE_BYTES];
    if (!read_signature(a, left) || !read_signature(b, right))
        return -1.0;
    double largest = 0.0;
    for (size_t i = 0; i < SIGNATURE_BYTES; i += 3) {
        double x[3], y[3];
        to_lab(left + i, x);
        to_lab(right + i, y);
        double difference = sqrt((x[0] - y[0]) * (x[0] - y[0]) + (x[1] - y[1]) * (x[1] - y[1])
                                 + (x[2] - y[2]) * (x[2] - y[2]));
        largest = fmax(largest, difference);
    }
    return largest;
}
