// SPDX-License-Identifier: Apache-2.0
/*
 * The words that pixels of the deferred pipeline store, and the debug views of them. Argument: the
 * root of the sources.
 */
#include "deferred/drawing.h"
#include "render/matrix.h"
#include "unit/test.h"

#include <math.h>

/* ---- Sizes ---- */

/* The words of a pixel that the material wrote. */
static uint32_t written(struct drawing *d, uint32_t x, uint32_t y, uint32_t *words)
{
    uint32_t count = d->stored_words;
    if (!REQUIRE(count >= 3 && count <= MAX_WORDS)
        || !REQUIRE(stored_read(d->passes.stored, x, y, words, count)))
        return 0;
    while (count > 3 && words[count - 1] == MARK)
        --count;
    return count;
}

/* The passes that light a class of pixels; those of other classes are left out. */
static uint32_t num_lighting(const struct passes *passes)
{
    uint32_t num = 0;
    for (uint32_t i = 0; i < passes->num_parts; ++i) {
        mxg_storage storage = {sizeof storage};
        mxg_result_storage(passes->parts[i].result, &storage);
        num += storage.classes != 0;
    }
    return num;
}

/* docs/deferred.md has this table. */
static void test_sizes(struct bench *b)
{
    static const struct {
        const char *element;
        uint32_t bytes, top, closures; /* top: the highest four bits of word 0 */
        uint32_t passes;               /* that light a class */
    } rows[] = {{"Plain", 12, 1, 1, 1},  {"Wax", 16, 2, 1, 2},       {"Hazy", 20, 2, 1, 2},
                {"Downy", 24, 2, 1, 2},  {"Satin", 28, 3, 1, 3},     {"Lacquered", 40, 3, 2, 3},
                {"Pearly", 44, 5, 2, 4}, {"Glittering", 60, 7, 2, 4}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        struct drawing d;
        uint32_t words[MAX_WORDS] = {0};
        if (drawing_open(b, rows[i].element, "round", UINT32_MAX, &d)) {
            REQUIRE_EQ(4 * written(&d, SIZE / 2, SIZE / 2, words), rows[i].bytes);
            REQUIRE_EQ(4 * d.stored_words, rows[i].bytes);
            REQUIRE_EQ(words[0] >> 28, rows[i].top);
            REQUIRE_EQ(num_lighting(&d.passes), rows[i].passes);
            REQUIRE_EQ((words[1] >> 28) + 1, rows[i].closures);
            REQUIRE(stored_read(d.passes.stored, 0, 0, words, 3)); /* beside the sphere */
            REQUIRE_EQ(words[0], 0);
        }
        drawing_close(&d);
    }
}

/* A closure of weight 0 in a pixel is not there: the ends of the mix are one
 * slab each. */
static void test_culling(struct bench *b)
{
    enum { SIMPLE = 1, COMPLEX = 3 };
    static const uint32_t bytes[] = {[SIMPLE] = 12, [COMPLEX] = 32};
    uint32_t words[MAX_WORDS], seen[4] = {0};
    struct drawing d;
    if (drawing_open(b, "Chipped", "round", UINT32_MAX, &d))
        for (uint32_t y = 0; y < SIZE; y += 4) {
            uint32_t size = 4 * written(&d, SIZE / 2, y, words), which = words[0] >> 28;
            if (which == 0)
                continue;
            if (REQUIRE(which == SIMPLE || which == COMPLEX))
                REQUIRE_EQ(size, bytes[which]);
            ++seen[which & 3];
        }
    REQUIRE(seen[SIMPLE] > 0 && seen[COMPLEX] > 0);
    drawing_close(&d);
}

/* ---- Order ---- */

/*
 * A ball around another one hides it, in either order: the one whose words are all in targets has
 * no depth pass, the other one has layers of an image.
 */
static void test_order(struct bench *b)
{
    static const char *const pairs[][2] = {{"Plain", "Lacquered"}, {"Lacquered", "Plain"}};
    for (size_t i = 0; i < 4; ++i) {
        const char *const *pair = pairs[i / 2]; /* outside, inside */
        size_t first = i % 2;
        struct drawing_part parts[2] = {{pair[first], b->scene.object},
                                        {pair[1 - first], b->scene.object}};
        struct matrix *inside = &parts[1 - first].object.world;
        *inside = matrix_multiply(*inside, matrix_scale(0.9, 0.9, 0.9));
        struct drawing alone = {0}, both = {0};
        if (drawing_open(b, pair[0], "round", UINT32_MAX, &alone)
            && drawing_open_both(b, parts, &both)
            && REQUIRE(alone.pixels[4 * (SIZE / 2 * SIZE + SIZE / 2) + 3] == 1))
            REQUIRE(memcmp(alone.pixels, both.pixels, PIXELS * 4 * sizeof(float)) == 0);
        drawing_close(&alone);
        drawing_close(&both);
    }
}

/* ---- Debug views ---- */

/* The words of `mx_show` are those of `mxgen render --show`. */
static void test_words_of_views(void)
{
    enum { FRAME = 8, SHOW = 4 };
    char words[256] = "";
    mxg_pass_member member = {sizeof member};
    for (size_t i = 0; pass_views[i]; ++i) {
        strcat(words, i ? "|" : "");
        strcat(words, pass_views[i]);
    }
    REQUIRE(mxg_catalogue_pass_member(FRAME, SHOW, &member) == MXG_OK);
    REQUIRE(strcmp(member.name, "mx_show") == 0 && strcmp(member.values, words) == 0);
}

/* Numbers are shown over 255. */
#define SHOWN(n) \
    { \
        (n) / 255.0f, (n) / 255.0f, (n) / 255.0f \
    }

static void test_views(struct bench *b)
{
    enum { CLASSES, BYTES, CLOSURES, COVERAGE, TRANSMITTANCE, PROPERTIES };
    static const struct {
        const char *element, *storage;
        uint32_t view;
        float rgb[3], limit;
    } rows[] = {{"Plain", "round", CLASSES, {0, 0.6f, 0}, 1e-6f},
                {"Satin", "round", CLASSES, {0.8f, 0, 0}, 1e-6f},
                {"Plain", "round", BYTES, SHOWN(12), 1e-6f},
                {"Lacquered", "round", BYTES, SHOWN(40), 1e-6f},
                {"Plain", "round", CLOSURES, SHOWN(1), 1e-6f},
                {"Lacquered", "round", CLOSURES, SHOWN(2), 1e-6f},
                {"Plain", "round", COVERAGE, {1, 1, 1}, 1e-6f},
                /* below the interface, f0 0.04: 0.96 of twice through (0.95, 0.8, 0.6) */
                {"Lacquered", "float", TRANSMITTANCE, {0.8664f, 0.6144f, 0.3456f}, 1e-4f},
                {"Plain", "float", PROPERTIES, {0.6f, 0.2f, 0.1f}, 1e-6f},
                /* of seven bits */
                {"Lacquered", "round", TRANSMITTANCE, {0.8664f, 0.6144f, 0.3456f}, 0.006f},
                {"Plain", "round", PROPERTIES, {0.6f, 0.2f, 0.1f}, 0.005f}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        struct drawing d;
        if (drawing_open(b, rows[i].element, rows[i].storage, rows[i].view, &d)) {
            const float *pixel = d.pixels + 4 * (SIZE / 2 * SIZE + SIZE / 2);
            for (size_t c = 0; c < 3; ++c)
                if (!REQUIRE(fabsf(pixel[c] - rows[i].rgb[c]) < rows[i].limit))
                    printf("    %s, %s: %g\n", rows[i].element, pass_views[rows[i].view],
                           (double)pixel[c]);
            REQUIRE(d.pixels[3] == 0); /* nothing is stored beside the sphere */
        }
        drawing_close(&d);
    }
}

int main(int argc, char **argv)
{
    struct bench b = {0};
    if (argc != 2)
        return 2;
    if (!bench_open_ball(&b))
        return 77;
    if (bench_load(&b, argv[1], "examples/deferred.mtlx")) {
        test_sizes(&b);
        test_culling(&b);
        test_order(&b);
        test_views(&b);
        test_words_of_views();
    }
    bench_close(&b);
    return test_report("deferred-stored");
}
