// SPDX-License-Identifier: Apache-2.0
#include "deferred/pictures.h"

#include "unit/test.h"

#include <math.h>

/* Another compiler rounds floats otherwise; a picture that differs by less than this is the same.
 */
#define ROUNDING 100

double picture_displayed(float linear)
{
    double x = fmin(fmax(0.6 * linear, 0), 1);
    return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055);
}

double picture_psnr(const float *a, const float *b)
{
    double sum = 0;
    for (size_t i = 0; i < PIXELS * 4; ++i) {
        double error = i % 4 == 3 ? 0 : picture_displayed(a[i]) - picture_displayed(b[i]);
        sum += error * error;
    }
    return sum > 0 ? 10 * log10(255 * 255 / (sum / (PIXELS * 3))) : INFINITY;
}

void picture_require(const struct bench *b, double db, int expected, int limit)
{
    bool is_as_listed = expected >= ROUNDING ? db > ROUNDING : fabs(db - expected) < 1.5;
    if (!REQUIRE(gpu_is_processor(&b->gpu) ? is_as_listed : db > limit))
        printf("    %.1f dB, not %d\n", db, expected);
}

void picture_test(struct bench *b, const char *element, const int expected[NUM_STORAGES],
                  unsigned storages)
{
    static const char *const names[NUM_STORAGES] = {"float", "dither", "round"};
    struct drawing forward;
    bool good = drawing_open(b, element, NULL, UINT32_MAX, &forward);
    printf("%-14s", element);
    for (size_t i = 0; good && i < NUM_STORAGES; ++i) {
        struct drawing deferred = {0};
        if (!(storages >> i & 1))
            continue;
        if (drawing_open(b, element, names[i], UINT32_MAX, &deferred)) {
            double db = picture_psnr(forward.pixels, deferred.pixels);
            printf(" %s %.1f dB", names[i], db);
            REQUIRE(deferred.stored_words > 0);
            picture_require(b, db, expected[i], i == 0 ? LIMIT_FLOAT : LIMIT_ROUNDED);
        }
        drawing_close(&deferred);
    }
    printf("\n");
    drawing_close(&forward);
}
