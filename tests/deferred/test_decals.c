// SPDX-License-Identifier: Apache-2.0
/*
 * Decals in images of their own: what they make of bases draws as a surface that has both, and as
 * the same decal stored over the base where both can express it. Argument: the root of the sources.
 */
#include "deferred/hits.h"
#include "deferred/pictures.h"
#include "unit/test.h"

/*
 * Decals in their order over a base, and the surface that has them, within dB. Whole floats: images
 * of decals are halves.
 */
static const struct row {
    const char *base, *decals[2], *both, *storage;
    int least;
} rows[] = {
    {"Plastic", {"Quarter"}, "PaintOnPlastic", "float", 60},
    {"Plastic", {"Quarter"}, "PaintOnPlastic", "dither", 44},
    {"Plastic", {"Quarter", "Half"}, "MudOnBoth", "float", 60},
    {"Plastic", {"Half", "Quarter"}, "PaintOnHalves", "float", 60},
    {"Plastic", {"Gold"}, "Gold", "float", 60},
    {"Fuzzy", {"Gold"}, "Gold", "float", 60},
    {"Brushed", {"Gold"}, "Gold", "float", 60},
    {"Wax", {"Gold"}, "Gold", "float", 60},
    {"Lamp", {"Gold"}, "Gold", "float", 60},
    {"Hazy", {"Gold"}, "Gold", "float", 60},
    {"Beside", {"Quarter", "Gold"}, "Gold", "float", 48}, /* two closures have other samples */
    {"Coated", {"Gold"}, "CoatedGold", "float", 60},
    {"Bumpy", {"Gold"}, "BumpyGold", "float", 60},
    {"Plastic", {"BumpyGold"}, "BumpyGold", "float", 55},
    {"Bumpy", {"Gold", "BumpyGold"}, "BumpyGold", "float", 55},
};

static double compare(struct drawing *a, struct drawing *b)
{
    for (size_t i = 0; i < PIXELS * 4; ++i)
        if (!hits_faces(i / 4))
            a->pixels[i] = b->pixels[i] = 0;
    return picture_psnr(a->pixels, b->pixels);
}

/* The function of a decal; texts: of the compute shaders that put it into images. */
static bool paint(struct bench *b, const char *const decals[2], char texts[2][HITS_ROOM])
{
    bool good = true;
    mxg_options_set(b->options, "decals", "images");
    for (int i = 0; good && i < 2 && decals[i]; ++i) {
        mxg_result *result = NULL;
        good = drawing_generate(b, decals[i], "payload", "dither", &result)
               && hits_write(b, result, HITS_BLENDED, texts[i], HITS_ROOM);
        mxg_result_destroy(result);
        b->painted[i] = texts[i];
    }
    return good;
}

static void clear(struct bench *b)
{
    mxg_options_set(b->options, "decals", "over");
    b->painted[0] = b->painted[1] = NULL;
}

static void test_row(struct bench *b, const struct row *row)
{
    static char texts[2][HITS_ROOM];
    struct drawing expected = {0}, painted = {0};
    if (drawing_open(b, row->both, row->storage, UINT32_MAX, &expected)
        && paint(b, row->decals, texts)
        && drawing_open(b, row->base, row->storage, UINT32_MAX, &painted)) {
        double db = compare(&expected, &painted);
        printf("%s%s%s in images on %s, %s: %.1f dB\n", row->decals[0], row->decals[1] ? ", " : "",
               row->decals[1] ? row->decals[1] : "", row->base, row->storage, db);
        REQUIRE(db > row->least);
    }
    clear(b);
    drawing_close(&painted);
    drawing_close(&expected);
}

/* Without a decal a material stores the same words; with one on part of a pixel, others. */
static void test_empty(struct bench *b)
{
    struct drawing plain = {0}, empty = {0};
    bool good = drawing_open(b, "Coated", "dither", UINT32_MAX, &plain);
    mxg_options_set(b->options, "decals", "images");
    if (good && drawing_open(b, "Coated", "dither", UINT32_MAX, &empty)) {
        REQUIRE_EQ(empty.layout, plain.layout);
        REQUIRE(memcmp(empty.pixels, plain.pixels, PIXELS * 4 * sizeof(float)) == 0);
    }
    clear(b);
    drawing_close(&empty);
    drawing_close(&plain);
}

/* The decal stored over the base draws alike. */
static void test_over(struct bench *b)
{
    static char over[HITS_ROOM], texts[2][HITS_ROOM];
    static const char *const decals[2] = {"Quarter", NULL};
    enum { ROOM = 3 * 47 };
    struct drawing stored = {0}, painted = {0};
    mxg_result *result = NULL;
    bool good = drawing_generate(b, "Quarter", "payload", "dither", &result)
                && hits_write(b, result, HITS_STORED, over, sizeof over);
    b->decals = over;
    b->words = ROOM;
    good = good && drawing_open(b, "Plastic", "float", UINT32_MAX, &stored);
    b->decals = NULL;
    b->words = 0;
    if (good && paint(b, decals, texts)
        && drawing_open(b, "Plastic", "float", UINT32_MAX, &painted)) {
        double db = compare(&stored, &painted);
        printf("a decal in images, and stored over the base: %.1f dB\n", db);
        REQUIRE(stored.pixels[4 * (PIXELS / 2 + SIZE / 2)] > 0.02f
                && db > 45); /* 7 bits of a payload */
    }
    clear(b);
    drawing_close(&painted);
    drawing_close(&stored);
    mxg_result_destroy(result);
}

int main(int argc, char **argv)
{
    struct bench b = {0};
    if (argc != 2)
        return 2;
    if (!bench_open_ball(&b))
        return 77;
    if (bench_load(&b, argv[1], "tests/deferred/decals.mtlx")) {
        for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i)
            test_row(&b, &rows[i]);
        test_empty(&b);
        test_over(&b);
    }
    bench_close(&b);
    return test_report("deferred-decals");
}
