// SPDX-License-Identifier: Apache-2.0
/*
 * Surfaces below rough interfaces: an edge of paint below frosted lacquer, blurred by the pass,
 * and waves of paint, blurred by the forward shader.
 */
#include "deferred/drawing.h"
#include "unit/test.h"

#include <math.h>

#define ROUGHNESS 0.6
#define THICKNESS 0.5
#define WAVES 20.0 /* radians in a unit of the world */

static double edge_at(double x)
{
    return x > 0 ? 1 : 0;
}

static double wave_at(double x)
{
    return 0.5 + 0.5 * sin(WAVES * x);
}

/*
 * The mean of a pattern that the viewer sees at x. A way along the normal meets a facet of GGX
 * (Walter 2007), whose visible slope is above s for the share 1 / (1 + (s / alpha)^2) of the ways,
 * and is refracted to the index 1.5.
 */
static double behind_interface(double (*pattern)(double), double x)
{
    enum { SLOPES = 2000, TURNS = 200 };
    const double alpha = ROUGHNESS * ROUGHNESS, pi = acos(-1);
    double bright = 0;
    for (int i = 0; i < SLOPES; ++i) {
        double u = (i + 0.5) / SLOPES, facet = atan(alpha * sqrt(u / (1 - u)));
        double away = THICKNESS * tan(facet - asin(sin(facet) / 1.5));
        for (int k = 0; k < TURNS; ++k)
            bright += pattern(x + away * cos(2 * pi * (k + 0.5) / TURNS));
    }
    return bright / ((double)SLOPES * TURNS);
}

/* A clear lacquer over "paint", a grey from 0 to 1, which nodes make of x. */
static bool parse_lacquer(struct bench *b, const char *paint)
{
    char text[3072];
    snprintf(
        text, sizeof text,
        "<materialx version='1.39'><position name='p' type='vector3' space='world'/>"
        "<extract name='x' type='float'><input name='in' type='vector3' nodename='p'/></extract>%s"
        "<multiply name='white' type='float'><input name='in1' type='float' nodename='paint'/>"
        "<input name='in2' type='float' value='0.8'/></multiply><convert name='color' "
        "type='color3'>"
        "<input name='in' type='float' nodename='white'/></convert>"
        "<slab name='base' type='BSDF'><input name='f0' type='color3' value='0, 0, 0'/>"
        "<input name='diffuse_albedo' type='color3' nodename='color'/></slab>"
        "<slab name='coat' type='BSDF'><input name='diffuse_albedo' type='color3' value='0, 0, 0'/>"
        "<input name='mean_free_path' type='vector3' value='1000, 1000, 1000'/>"
        "<input name='roughness' type='float' value='%g'/></slab>"
        "<slab_layer name='both' type='BSDF'><input name='top' type='BSDF' nodename='coat'/>"
        "<input name='base' type='BSDF' nodename='base'/><input name='thickness' type='float' "
        "value='%g'/></slab_layer><slab_surface name='Lacquer' type='surfaceshader'>"
        "<input name='bsdf' type='BSDF' nodename='both'/></slab_surface></materialx>",
        paint, ROUGHNESS, THICKNESS);
    return bench_parse(b, "lacquer.mtlx", text);
}

/* Bright at x > edge. */
static bool parse_edge(struct bench *b, double edge)
{
    char text[512];
    snprintf(text, sizeof text,
             "<ifgreater name='paint' type='float'><input name='value1' type='float' nodename='x'/>"
             "<input name='value2' type='float' value='%g'/><input name='in1' type='float' "
             "value='1'/><input name='in2' type='float' value='0'/></ifgreater>",
             edge);
    return parse_lacquer(b, text);
}

static bool parse_waves(struct bench *b)
{
    char text[768];
    snprintf(text, sizeof text,
             "<multiply name='turn' type='float'><input name='in1' type='float' nodename='x'/>"
             "<input name='in2' type='float' value='%g'/></multiply><sin name='sine' type='float'>"
             "<input name='in' type='float' nodename='turn'/></sin><range name='paint' "
             "type='float'><input name='in' type='float' nodename='sine'/><input name='inlow' "
             "type='float' value='-1'/></range>",
             WAVES);
    return parse_lacquer(b, text);
}

static double at(const struct drawing *drawing, size_t x, size_t y)
{
    return (double)drawing->pixels[4 * (y * SIZE + x)];
}

/* A pattern between pictures of dark and bright paint. */
struct seen {
    struct drawing dark, bright, drawn;
    double (*pattern)(double x);
};

/* The furthest of the columns from the truth, and from the pattern itself. */
static void compare(const struct seen *seen, double *out_worst, double *out_moved)
{
    enum { FIRST = SIZE / 4, END = SIZE - FIRST };
    *out_worst = *out_moved = 0;
    for (size_t i = FIRST; i < END; ++i) {
        double share = 0, x = 2 * ((double)i + 0.5) / SIZE - 1;
        for (size_t y = FIRST; y < END; ++y) {
            double dark = at(&seen->dark, i, y), bright = at(&seen->bright, i, y);
            REQUIRE(bright > dark + 0.1);
            share += (at(&seen->drawn, i, y) - dark) / (bright - dark) / (END - FIRST);
        }
        *out_worst = fmax(*out_worst, fabs(share - behind_interface(seen->pattern, x)));
        *out_moved = fmax(*out_moved, fabs(share - seen->pattern(x)));
    }
}

/* limit: of the difference between the picture and the truth; storage NULL: forward. */
static void test_pattern(struct bench *b, double (*pattern)(double), const char *storage,
                         double limit)
{
    struct seen seen = {.pattern = pattern};
    bool is_edge = pattern == edge_at;
    double worst, moved;
    if (parse_edge(b, 2) && drawing_open(b, "Lacquer", storage, UINT32_MAX, &seen.dark)
        && parse_edge(b, -2) && drawing_open(b, "Lacquer", storage, UINT32_MAX, &seen.bright)
        && (is_edge ? parse_edge(b, 0) : parse_waves(b))
        && drawing_open(b, "Lacquer", storage, UINT32_MAX, &seen.drawn)) {
        compare(&seen, &worst, &moved);
        printf("blur, storage %s: %s within %.3f of ways through facets, %.3f of no blur\n",
               storage ? storage : "none", is_edge ? "the edge is" : "waves are", worst, moved);
        REQUIRE(worst > 0 && worst < limit);
        REQUIRE(moved > 2 * limit);
    }
    drawing_close(&seen.drawn);
    drawing_close(&seen.bright);
    drawing_close(&seen.dark);
}

/* Without the option, or with the feature left out, the edge is sharp. */
static void test_sharp(struct bench *b)
{
    struct drawing left_out = {0}, sharp = {0};
    REQUIRE(parse_edge(b, 0));
    mxg_options_set(b->options, "features", "-rough-refraction");
    if (drawing_open(b, "Lacquer", "float", UINT32_MAX, &left_out)) {
        mxg_options_set(b->options, "rough-refraction", "sharp");
        if (drawing_open(b, "Lacquer", "float", UINT32_MAX, &sharp)) {
            enum { MIDDLE = SIZE / 2, AWAY = 10 };
            double step = at(&sharp, MIDDLE, MIDDLE) - at(&sharp, MIDDLE - 1, MIDDLE);
            double whole =
                at(&sharp, MIDDLE + AWAY, MIDDLE) - at(&sharp, MIDDLE - 1 - AWAY, MIDDLE);
            REQUIRE(whole > 0.1 && step > 0.95 * whole);
            REQUIRE(memcmp(sharp.pixels, left_out.pixels, sizeof(float) * 4 * PIXELS) == 0);
            REQUIRE(sharp.layout != left_out.layout);
        }
    }
    drawing_close(&sharp);
    drawing_close(&left_out);
}

int main(void)
{
    struct bench b = {0};
    if (!bench_open_plane(&b))
        return 77;
    mxg_options_set(b.options, "rough-refraction", "blur");
    test_pattern(&b, edge_at, "float", 0.05);
    test_pattern(&b, edge_at, "dither", 0.033);
    test_pattern(&b, wave_at, NULL, 0.046);
    test_sharp(&b);
    bench_close(&b);
    return test_report("deferred-blur");
}
