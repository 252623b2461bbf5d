// SPDX-License-Identifier: Apache-2.0
/*
 * Materials drawn by the deferred pipeline look as they do by the forward pipeline. Arguments: the
 * root of the sources, and "all" to draw each material by all storages, otherwise by one.
 */
#include "deferred/pictures.h"
#include "unit/test.h"

#include <math.h>

static const struct {
    const char *document, *element;
    int expected[NUM_STORAGES];
    bool is_model; /* of another model, which slabs stand for */
} rows[] = {
#define MATERIAL(document, element, float_db, dither_db, round_db, payload_db) \
    {document, element, {float_db, dither_db, round_db}, false},
#define MODEL(element, what, float_db, dither_db, round_db) \
    {"tests/deferred/materials.mtlx", element, {float_db, dither_db, round_db}, true},
#define LAYERS(closures, name, float_db, dither_db, round_db)
#include "deferred/pictures.def"
};

static void test_pictures(struct bench *b, const char *root, bool is_all)
{
    const char *document = "";
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        if (strcmp(rows[i].document, document) != 0 && !bench_load(b, root, rows[i].document))
            return;
        document = rows[i].document;
        mxg_options_set(b->options, "slabs", rows[i].is_model ? "true" : "false");
        picture_test(b, rows[i].element, rows[i].expected,
                     is_all ? ALL_STORAGES : 1u << i % NUM_STORAGES);
    }
}

/* ---- Bands ---- */

/* The error that areas of 8x8 pixels have in common: what an eye sees as bands.
 */
static double error_of_areas(const float *a, const float *b)
{
    enum { AREA = 8 };
    double sum = 0;
    size_t count = 0;
    for (size_t top = 0; top + AREA <= SIZE; top += AREA)
        for (size_t left = 0; left + AREA <= SIZE; left += AREA) {
            double mean[3] = {0};
            for (size_t i = 0; i < AREA * AREA; ++i) {
                size_t at = 4 * ((top + i / AREA) * SIZE + left + i % AREA);
                for (size_t c = 0; c < 3; ++c)
                    mean[c] += (picture_displayed(a[at + c]) - picture_displayed(b[at + c]))
                               / (AREA * AREA);
            }
            for (size_t c = 0; c < 3; ++c, ++count)
                sum += mean[c] * mean[c];
        }
    return sqrt(sum / (double)count);
}

/* Noise hides the bands of few bits. */
static void test_bands(struct bench *b)
{
    static const char *const storages[] = {"dither", "round"};
    struct drawing forward;
    double errors[2] = {0};
    bool good = drawing_open(b, "Banded", NULL, UINT32_MAX, &forward);
    for (size_t i = 0; good && i < 2; ++i) {
        struct drawing deferred;
        if (drawing_open(b, "Banded", storages[i], UINT32_MAX, &deferred))
            errors[i] = error_of_areas(forward.pixels, deferred.pixels);
        drawing_close(&deferred);
    }
    printf("bands: error of areas with dither %.3f, without %.3f of 255\n", errors[0], errors[1]);
    REQUIRE(errors[0] > 0 && errors[0] < 0.046 && errors[1] > 0.2);
    drawing_close(&forward);
}

int main(int argc, char **argv)
{
    struct bench b = {0};
    if (argc < 2)
        return 2;
    if (!bench_open_ball(&b))
        return 77;
    test_pictures(&b, argv[1], argc > 2 && strcmp(argv[2], "all") == 0);
    mxg_options_set(b.options, "slabs", "true");
    if (bench_load(&b, argv[1], "tests/deferred/materials.mtlx"))
        test_bands(&b);
    bench_close(&b);
    return test_report("deferred-pictures");
}
