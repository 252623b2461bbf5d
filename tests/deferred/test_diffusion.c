// SPDX-License-Identifier: Apache-2.0
/* The pass that spreads the light below the surface of bodies, on a plane with one light. */
#include "deferred/drawing.h"
#include "unit/test.h"

#include <math.h>

/*
 * The light behind the edge of a half plane that is lit, at the distance t into
 * it: Christensen and Burley's profile (2015), integrated over rings.
 */
static double behind_edge(double t, double d)
{
    enum { STEPS = 4000 };
    double dark = 0, from = fabs(t), step = 60 * d / STEPS;
    for (int i = 0; i < STEPS; ++i) {
        double r = from + (i + 0.5) * step, ring = (exp(-r / d) + exp(-r / (3 * d))) / (4 * d);
        dark += step * ring * acos(from / r) / acos(-1);
    }
    return t < 0 ? dark : 1 - dark;
}

/* A plane of wax that is lit at x > edge, because its normal there is that of
 * the light. */
static bool parse_wax(struct bench *b, double edge)
{
    float l[4] = {0};
    char text[2048];
    if (!REQUIRE(scene_light(&b->scene, 0, "direction", l)))
        return false;
    double side = hypot(l[0], l[1]); /* facing the viewer, across the light */
    snprintf(text, sizeof text,
             "<materialx version='1.39'><position name='p' type='vector3' "
             "space='world'/>"
             "<extract name='x' type='float'><input name='in' type='vector3' "
             "nodename='p'/>"
             "</extract><ifgreater name='n' type='vector3'><input name='value1' "
             "type='float' "
             "nodename='x'/><input name='value2' type='float' value='%g'/><input "
             "name='in1' "
             "type='vector3' value='%g, %g, %g'/><input name='in2' "
             "type='vector3' value='%g, %g, "
             "%g'/></ifgreater><slab name='s' type='BSDF'><input name='f0' "
             "type='color3' "
             "value='0, 0, 0'/><input name='diffuse_albedo' type='color3' "
             "value='0.5, 0.5, 0.5'/>"
             "<input name='mean_free_path' type='vector3' value='0.1, 0.12, "
             "0.15'/><input "
             "name='normal' type='vector3' nodename='n'/></slab><slab_surface "
             "name='Wax' "
             "type='surfaceshader'><input name='bsdf' type='BSDF' "
             "nodename='s'/></slab_surface>"
             "</materialx>",
             edge, -(double)l[0], -(double)l[1], -(double)l[2], -l[0] * l[2] / side,
             -l[1] * l[2] / side, side);
    return bench_parse(b, "wax.mtlx", text);
}

/* The mean of the middle rows of a column. */
static void mean_of_column(const float *pixels, size_t column, double out[3])
{
    enum { FIRST = SIZE / 3, END = SIZE - FIRST };
    out[0] = out[1] = out[2] = 0;
    for (size_t y = FIRST; y < END; ++y)
        for (size_t c = 0; c < 3; ++c)
            out[c] += (double)pixels[4 * (y * SIZE + column) + c] / (END - FIRST);
}

/* An even light stays as it is, and is as bright as in forward. Gives the light. */
static bool test_even(struct bench *b, double lit[3])
{
    struct drawing even = {0}, wrapped = {0};
    double of_wrapped[3], uneven = 0, off = 0;
    bool good = parse_wax(b, -2) && drawing_open(b, "Wax", "float", UINT32_MAX, &even);
    mxg_options_set(b->options, "sss", "wrap");
    good = good && drawing_open(b, "Wax", "float", UINT32_MAX, &wrapped);
    mxg_options_set(b->options, "sss", "diffusion");
    if (good) {
        mean_of_column(even.pixels, SIZE / 2, lit);
        mean_of_column(wrapped.pixels, SIZE / 2, of_wrapped);
        for (size_t c = 0; c < 3; ++c)
            off = fmax(off, fabs(lit[c] / of_wrapped[c] - 1));
        for (size_t i = 0; i < PIXELS * 4; ++i)
            if (i % 4 != 3)
                uneven = fmax(uneven, fabs((double)even.pixels[i] / lit[i % 4] - 1));
        printf("diffusion: even light within %.6f, from wrapped light within %.4f\n", uneven, off);
        REQUIRE(lit[0] > 0.05 && uneven < 0.0001 && off < 0.001);
        REQUIRE(even.layout != wrapped.layout);
    }
    drawing_close(&wrapped);
    drawing_close(&even);
    return good;
}

/* The edge of a shadow is as soft as the profile says. */
static void test_edge(struct bench *b, const double lit[3])
{
    static const double paths[3] = {0.1, 0.12, 0.15};
    struct drawing edge = {0};
    double worst = 0;
    if (parse_wax(b, 0) && drawing_open(b, "Wax", "float", UINT32_MAX, &edge))
        for (size_t x = SIZE / 4; x < SIZE - SIZE / 4; ++x) {
            double at[3], depth = 2 * ((double)x + 0.5) / SIZE - 1;
            mean_of_column(edge.pixels, x, at);
            for (size_t c = 0; c < 3; ++c) {
                double expected = behind_edge(depth, paths[c]);
                worst = fmax(worst, fabs(at[c] / lit[c] - expected));
            }
        }
    printf("diffusion: the edge of a shadow within %.4f\n", worst);
    REQUIRE(worst > 0 && worst < 0.02);
    drawing_close(&edge);
}

int main(void)
{
    struct bench b = {0};
    if (!bench_open_plane(&b))
        return 77;
    mxg_options_set(b.options, "sss", "diffusion");
    double lit[3];
    if (test_even(&b, lit))
        test_edge(&b, lit);
    bench_close(&b);
    return test_report("deferred-diffusion");
}
