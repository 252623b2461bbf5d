// SPDX-License-Identifier: Apache-2.0
/*
 * Payloads of rays: one slab in 64 bytes draws what forward draws with one slab. Argument: the root
 * of the sources.
 */
#include "deferred/hits.h"
#include "deferred/pictures.h"
#include "unit/test.h"

#include <math.h>
#include <stdlib.h>

static const struct {
    const char *document, *element;
    int expected; /* dB; 0: not tested */
} rows[] = {
#define MATERIAL(document, element, float_db, dither_db, round_db, payload_db) \
    {document, element, payload_db},
#define MODEL(element, what, float_db, dither_db, round_db)
#define LAYERS(closures, name, float_db, dither_db, round_db)
#include "deferred/pictures.def"
};

enum { CENTER = PIXELS / 2 + SIZE / 2 }; /* a pixel whose ray hits */

/* ---- Rays ---- */

/* Draws an element by payloads alone: no mesh, no lights but those of the pass
 * over them. */
static bool draw_rays(struct bench *b, const char *element, struct drawing *d)
{
    static char text[HITS_ROOM];
    *d = (struct drawing){.pixels = malloc(PIXELS * 4 * sizeof(float)), .count = 1};
    d->canvas = draw_open_canvas(&b->gpu, SIZE, SIZE);
    bool good = drawing_generate(b, element, "payload", "dither", &d->results[0]);
    if (!good || !hits_write(b, d->results[0], HITS_STORED, text, sizeof text))
        return false;
    good = drawing_open_passes(b, d, &(struct passes_setup){.shown = UINT32_MAX, .hits = text});
    for (size_t i = 0; good && i < PIXELS * PAYLOAD_WORDS; ++i) /* empty: a ray may hit nothing */
        d->passes.payloads[i] = i / PAYLOAD_WORDS == CENTER ? MARK : 0;
    return good && drawing_frame(d, 0);
}

/* ---- Payloads ---- */

/* All words of a payload are written, and none where no ray hits. */
static void check_payload(const struct drawing *d)
{
    const uint32_t *words = d->passes.payloads + CENTER * PAYLOAD_WORDS;
    enum { USED = 11 };
    for (size_t i = 0; i < PAYLOAD_WORDS; ++i)
        REQUIRE(words[i] != MARK);
    for (size_t i = USED; i < PAYLOAD_WORDS; ++i)
        REQUIRE_EQ(words[i], 0);               /* the host's */
    const uint32_t *none = d->passes.payloads; /* the corner has no hit */
    for (size_t i = 0; i < PAYLOAD_WORDS; ++i)
        REQUIRE_EQ(none[i], 0);
}

/* One slab in 64 bytes draws what forward draws with one slab. */
static void test_payload(struct bench *b, const char *element, int expected)
{
    struct drawing forward = {0}, rays = {0};
    mxg_options_set(b->options, "max-slabs", "1");
    if (drawing_open(b, element, NULL, UINT32_MAX, &forward) && draw_rays(b, element, &rays)) {
        mxg_storage storage = {sizeof storage};
        mxg_result_storage(rays.results[0], &storage);
        REQUIRE_EQ(storage.words, PAYLOAD_WORDS);
        check_payload(&rays);
        size_t differing = 0;
        for (size_t i = 0; i < PIXELS; ++i) {
            /* forward shows the inside of the ball through holes */
            bool is_hole = rays.pixels[4 * i + 3] < 0.5f;
            bool differs = hits_faces(i) && !is_hole && forward.pixels[4 * i + 3] < 0.5f;
            differing += differs;
            for (size_t c = 0; (differs || is_hole || !hits_faces(i)) && c < 4; ++c)
                forward.pixels[4 * i + c] = rays.pixels[4 * i + c] = 0;
        }
        if (!REQUIRE(differing < 4)) /* edges of holes */
            printf("    %zu pixels differ\n", differing);
        double db = picture_psnr(forward.pixels, rays.pixels);
        printf("%-14s payload %.1f dB, %zu pixels differ\n", element, db, differing);
        picture_require(b, db, expected, LIMIT_ROUNDED);
    }
    drawing_close(&rays);
    drawing_close(&forward);
    mxg_options_set(b->options, "max-slabs", "0");
}

/* A sum of equal slabs weighs 2, which the albedo and f0 of a payload take. */
static const char sum[] =
    "<materialx version='1.39'><slab name='chalk' type='BSDF'>"
    "<input name='diffuse_albedo' type='color3' value='0.4, 0.3, 0.1'/></slab>"
    "<add name='both' type='BSDF'><input name='in1' type='BSDF' nodename='chalk'/>"
    "<input name='in2' type='BSDF' nodename='chalk'/></add>"
    "<slab_surface name='Sum' type='surfaceshader'>"
    "<input name='bsdf' type='BSDF' nodename='both'/></slab_surface></materialx>";

/*
 * The sum sends back as much light as forward, of all pixels: but for its edges, where no slab
 * reflects more than 1.
 */
static void test_sum(struct bench *b)
{
    struct drawing forward = {0}, rays = {0};
    if (bench_parse(b, "sum.mtlx", sum) && drawing_open(b, "Sum", NULL, UINT32_MAX, &forward)
        && draw_rays(b, "Sum", &rays))
        for (size_t c = 0; c < 3; ++c) {
            double drawn = 0, expected = 0;
            for (size_t i = 0; i < PIXELS; ++i) {
                drawn += hits_faces(i) ? (double)rays.pixels[4 * i + c] : 0;
                expected += hits_faces(i) ? (double)forward.pixels[4 * i + c] : 0;
            }
            printf("sum of equal slabs, channel %zu: %.4f of forward\n", c, drawn / expected);
            REQUIRE(fabs(drawn / expected - 1) < 0.015);
        }
    drawing_close(&rays);
    drawing_close(&forward);
}

/* ---- Words by a function ---- */

/* The words of a material by the function of the role `pack`, of all pixels of rays. */
static bool pack_rays(struct bench *b, const char *element, struct drawing *d)
{
    static char text[HITS_ROOM];
    *d = (struct drawing){.pixels = malloc(PIXELS * 4 * sizeof(float)), .count = 1};
    d->canvas = draw_open_canvas(&b->gpu, SIZE, SIZE);
    return drawing_generate(b, element, "pack", "dither", &d->results[0])
           && hits_write(b, d->results[0], HITS_STORED, text, sizeof text)
           && drawing_open_passes(b, d, &(struct passes_setup){.shown = UINT32_MAX, .hits = text})
           && REQUIRE(render_frame(d->renders, 0, d->canvas, d->pixels));
}

/* Steps between two normals of 12 bits. */
static int normal_steps(uint32_t a, uint32_t b)
{
    int x = (int)(a & 0xfff) - (int)(b & 0xfff),
        y = (int)(a >> 12 & 0xfff) - (int)(b >> 12 & 0xfff);
    return abs(x) > abs(y) ? abs(x) : abs(y);
}

/* Glints and nothing more: the results of all pixels have room in the buffer of payloads. */
static const char flakes[] =
    "<materialx version='1.39'><slab name='flakes' type='BSDF'>"
    "<input name='f0' type='color3' value='0.4, 0.4, 0.4'/>"
    "<input name='glint_density' type='float' value='15'/></slab>"
    "<slab_surface name='Flakes' type='surfaceshader'>"
    "<input name='bsdf' type='BSDF' nodename='flakes'/></slab_surface></materialx>";

/* True if glints have facets, whose third word has the extent of the pixel in steps of 2 %. */
static bool is_near(uint32_t a, uint32_t b)
{
    for (int shift = 0; shift < 20; shift += 10)
        if (abs((int)(a >> shift & 0x3ff) - (int)(b >> shift & 0x3ff)) > 4)
            return false;
    return a && b && a >> 20 == b >> 20;
}

/*
 * The function stores what the material pass stores: the first two words to the bit, normals within
 * steps, because a mesh has others than a ball, and of all words a part to the bit. The function
 * returns color, alpha, and the words. Glints are the last four words; at the seam of the ball
 * their coordinates jump.
 */
static void test_pack(struct bench *b, const char *element, uint32_t num, bool has_glints,
                      double least)
{
    struct drawing drawn = {0}, packed = {0};
    const uint32_t head = 4, stride = (head + num + 3) / 4 * 4;
    size_t pixels = 0, equal = 0, same = 0, extents = 0;
    if (!REQUIRE(stride <= PAYLOAD_WORDS))
        return;
    if (drawing_open(b, element, "dither", UINT32_MAX, &drawn) && pack_rays(b, element, &packed)) {
        REQUIRE_EQ(drawn.stored_words, num);
        for (size_t i = 0; i < PIXELS; i += 7) {
            uint32_t words[MAX_WORDS] = {0};
            const uint32_t *made = packed.passes.payloads + i * stride + head;
            if (!hits_faces(i)
                || !REQUIRE(stored_read(drawn.passes.stored, (uint32_t)(i % SIZE),
                                        (uint32_t)(i / SIZE), words, num)))
                continue;
            ++pixels;
            same += words[0] == made[0] && words[1] == made[1] && words[2] >> 24 == made[2] >> 24
                    && normal_steps(words[2], made[2]) < 12;
            extents += !has_glints || is_near(words[num - 2], made[num - 2]);
            for (uint32_t k = 0; k < num; ++k)
                equal += words[k] == made[k];
        }
        double part = (double)equal / (double)(pixels * num);
        printf("%s packed: %zu of %zu pixels, %zu extents, %.2f of all words equal\n", element,
               same, pixels, extents, part);
        REQUIRE(pixels > 300 && same == pixels && 100 * extents > 95 * pixels && part > least);
    }
    drawing_close(&packed);
    drawing_close(&drawn);
}

/* ---- Decals ---- */

#define SLAB(name, color, roughness) \
    "<slab name='" name "' type='BSDF'><input name='diffuse_albedo' type='color3' value='" color \
    "'/><input name='roughness' type='float' value='" roughness "'/></slab>"
#define SURFACE(name, bsdf) \
    "<slab_surface name='" name \
    "' type='surfaceshader'><input name='bsdf' type='BSDF' nodename='" bsdf "'/></slab_surface>"
#define MIX(name, fg, bg) \
    "<slab_mix name='" name "' type='BSDF'><input name='fg' type='BSDF' nodename='" fg \
    "'/><input name='bg' type='BSDF' nodename='" bg \
    "'/><input name='mix' type='float' value='0.25'/></slab_mix>"

/* A decal that covers a quarter, and the surfaces that it makes of others. */
static const char decals[] = "<materialx version='1.39'>" SLAB("paint", "0.1, 0.6, 0.2", "0.6")
    SLAB("mud", "0.3, 0.2, 0.1",
         "0.9") "<slab name='plastic' type='BSDF'><input name='diffuse_albedo' type='color3' "
                "value='0.7, 0.2, 0.1'/>"
                "<input name='roughness' type='float' value='0.2'/>"
                "<input name='fuzz_amount' type='float' value='0.5'/></slab>"
                "<slab_coverage name='part' type='BSDF'><input name='in' type='BSDF' "
                "nodename='paint'/>"
                "<input name='weight' type='float' value='0.25'/></slab_coverage>" MIX(
                    "halves", "mud", "plastic") MIX("on_one", "paint", "plastic")
                    MIX("on_two", "paint", "halves") SURFACE("Decal", "part")
                        SURFACE("Whole", "paint") SURFACE("One", "plastic") SURFACE("Two", "halves")
                            SURFACE("OnOne", "on_one") SURFACE("OnTwo", "on_two") "</materialx>";

/*
 * A base under a decal, with so many words more in the images: the picture of the surface
 * that has both, within dB.
 */
static void test_decal(struct bench *b, const char *decal, const char *base, const char *both,
                       const char *storage, uint32_t words, int least)
{
    static char text[HITS_ROOM];
    struct drawing expected = {0}, stored = {0};
    mxg_result *result = NULL;
    bool good = drawing_generate(b, decal, "payload", "dither", &result)
                && hits_write(b, result, HITS_STORED, text, sizeof text)
                && drawing_open(b, both, storage, UINT32_MAX, &expected);
    b->decals = text;
    b->words = words;
    if (good && drawing_open(b, base, storage, UINT32_MAX, &stored)) {
        for (size_t i = 0; i < PIXELS * 4; ++i)
            if (!hits_faces(i / 4))
                expected.pixels[i] = stored.pixels[i] = 0;
        double db = picture_psnr(expected.pixels, stored.pixels);
        printf("%s over %s, %s, %u words: %.1f dB\n", decal, base, storage, (unsigned)words, db);
        REQUIRE(stored.pixels[4 * CENTER] > 0.02f && db > least);
    }
    b->decals = NULL;
    b->words = 0;
    drawing_close(&stored);
    drawing_close(&expected);
    mxg_result_destroy(result);
}

static void test_decals(struct bench *b)
{
    enum { ROOM = 12, WHOLE_ROOM = 3 * 47 };
    if (!bench_parse(b, "decals.mtlx", decals))
        return;
    test_decal(b, "Decal", "One", "OnOne", "float", WHOLE_ROOM, 45);
    test_decal(b, "Decal", "One", "OnOne", "round", ROOM, 40);
    test_decal(b, "Decal", "Two", "OnTwo", "dither", ROOM, 40);
    test_decal(b, "Whole", "Two", "Whole", "round", ROOM, 45);
    test_decal(b, "Decal", "Two", "OnTwo", "round", 0, 25); /* blended with the top */
}

int main(int argc, char **argv)
{
    struct bench b = {0};
    const char *document = "";
    if (argc != 2)
        return 2;
    if (!bench_open_ball(&b))
        return 77;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        if (!rows[i].expected
            || (strcmp(rows[i].document, document) != 0
                && !bench_load(&b, argv[1], rows[i].document)))
            continue;
        document = rows[i].document;
        test_payload(&b, rows[i].element, rows[i].expected);
    }
    test_sum(&b);
    if (bench_load(&b, argv[1], "examples/deferred.mtlx")) {
        test_pack(&b, "Plain", 3, false, 0.6);
        test_pack(&b, "Lacquered", 10, false, 0.6);
    }
    if (bench_parse(&b, "flakes.mtlx", flakes))
        test_pack(&b, "Flakes", 7, true, 0.4);
    test_decals(&b);
    bench_close(&b);
    return test_report("deferred-payload");
}
