// SPDX-License-Identifier: Apache-2.0
/* The pass that blurs what lies below rough interfaces: an edge of paint below frosted lacquer. */
#include "deferred/drawing.h"
#include "unit/test.h"

#include <math.h>

#define ROUGHNESS 0.6
#define THICKNESS 0.5

/*
 * What the viewer sees at the distance t into the half that is bright. A way along the normal meets
 * a facet of GGX (Walter 2007), whose visible slope is above s for the share 1 / (1 + (s /
 * alpha)^2) of the ways, and is refracted to the index 1.5.
 */
static double behind_interface(double t)
{
    enum { SLOPES = 2000, TURNS = 200 };
    const double alpha = ROUGHNESS * ROUGHNESS, pi = acos(-1);
    double bright = 0;
    for (int i = 0; i < SLOPES; ++i) {
        double u = (i + 0.5) / SLOPES, facet = atan(alpha * sqrt(u / (1 - u)));
        double away = THICKNESS * tan(facet - asin(sin(facet) / 1.5));
        for (int k = 0; k < TURNS; ++k)
            bright += t + away * cos(2 * pi * (k + 0.5) / TURNS) > 0 ? 1.0 : 0.0;
    }
    return bright / ((double)SLOPES * TURNS);
}

/* Paint that is bright at x > edge, below a clear lacquer. */
static bool parse_lacquer(struct bench *b, double edge)
{
    char text[2048];
    snprintf(
        text, sizeof text,
        "<materialx version='1.39'><position name='p' type='vector3' space='world'/>"
        "<extract name='x' type='float'><input name='in' type='vector3' nodename='p'/></extract>"
        "<ifgreater name='paint' type='color3'><input name='value1' type='float' nodename='x'/>"
        "<input name='value2' type='float' value='%g'/><input name='in1' type='color3' "
        "value='0.8, 0.8, 0.8'/><input name='in2' type='color3' value='0, 0, 0'/></ifgreater>"
        "<slab name='base' type='BSDF'><input name='f0' type='color3' value='0, 0, 0'/>"
        "<input name='diffuse_albedo' type='color3' nodename='paint'/></slab>"
        "<slab name='coat' type='BSDF'><input name='diffuse_albedo' type='color3' value='0, 0, 0'/>"
        "<input name='mean_free_path' type='vector3' value='1000, 1000, 1000'/>"
        "<input name='roughness' type='float' value='%g'/></slab>"
        "<slab_layer name='both' type='BSDF'><input name='top' type='BSDF' nodename='coat'/>"
        "<input name='base' type='BSDF' nodename='base'/><input name='thickness' type='float' "
        "value='%g'/></slab_layer><slab_surface name='Lacquer' type='surfaceshader'>"
        "<input name='bsdf' type='BSDF' nodename='both'/></slab_surface></materialx>",
        edge, ROUGHNESS, THICKNESS);
    mxg_document_destroy(b->document);
    b->document = NULL;
    return REQUIRE_EQ(mxg_document_parse(b->context, mxg_library_builtin(b->context),
                                         "lacquer.mtlx", text, strlen(text), &b->document),
                      MXG_OK);
}

static double at(const struct drawing *drawing, size_t x, size_t y)
{
    return (double)drawing->pixels[4 * (y * SIZE + x)];
}

/* How much of the paint's light each column has: the furthest from the truth, and from a step. */
static void compare(const struct drawing *dark, const struct drawing *bright,
                    const struct drawing *edge, double *out_worst, double *out_step)
{
    enum { FIRST = SIZE / 4, END = SIZE - FIRST };
    for (size_t x = FIRST; x < END; ++x) {
        double share = 0, t = 2 * ((double)x + 0.5) / SIZE - 1;
        for (size_t y = FIRST; y < END; ++y)
            share += (at(edge, x, y) - at(dark, x, y)) / (at(bright, x, y) - at(dark, x, y))
                     / (END - FIRST);
        *out_worst = fmax(*out_worst, fabs(share - behind_interface(t)));
        *out_step = fmax(*out_step, fabs(share - (t > 0)));
    }
}

/* limit: of the difference between the edge and the truth. */
static void test_edge(struct bench *b, const char *storage, double limit)
{
    struct drawing dark = {0}, bright = {0}, edge = {0};
    double worst = 0, step = 0;
    if (parse_lacquer(b, 2) && drawing_open(b, "Lacquer", storage, UINT32_MAX, &dark)
        && parse_lacquer(b, -2) && drawing_open(b, "Lacquer", storage, UINT32_MAX, &bright)
        && parse_lacquer(b, 0) && drawing_open(b, "Lacquer", storage, UINT32_MAX, &edge)) {
        compare(&dark, &bright, &edge, &worst, &step);
        printf("blur, storage %s: the edge is within %.3f of ways through facets\n", storage,
               worst);
        REQUIRE(worst > 0 && worst < limit);
        REQUIRE(step > 0.25);
    }
    drawing_close(&edge);
    drawing_close(&bright);
    drawing_close(&dark);
}

/* Without the option, or with the feature left out, the edge is sharp. */
static void test_sharp(struct bench *b)
{
    struct drawing blurred = {0}, sharp = {0};
    REQUIRE(parse_lacquer(b, 0));
    mxg_options_set(b->options, "features", "-rough-refraction");
    if (drawing_open(b, "Lacquer", "float", UINT32_MAX, &blurred)) {
        mxg_options_set(b->options, "rough-refraction", "sharp");
        if (drawing_open(b, "Lacquer", "float", UINT32_MAX, &sharp)) {
            REQUIRE(memcmp(sharp.pixels, blurred.pixels, sizeof(float) * 4 * PIXELS) == 0);
            REQUIRE(sharp.layout != blurred.layout);
        }
    }
    drawing_close(&sharp);
    drawing_close(&blurred);
}

int main(void)
{
    struct bench b = {0};
    if (!bench_open(&b))
        return 77;
    REQUIRE(scene_init_plane(&b.scene));
    b.scene.num_lights = 1;
    mxg_options_set(b.options, "environment", "none");
    mxg_options_set(b.options, "rough-refraction", "blur");
    test_edge(&b, "float", 0.05);
    test_edge(&b, "dither", 0.07);
    test_sharp(&b);
    bench_close(&b);
    return test_report("blur");
}
