// SPDX-License-Identifier: Apache-2.0
/*
 * Fits the directional albedo and the mean direction of Chan's diffuse lobe (2018, "Material
 * Advances in Call of Duty: WWII") for mx_chan_share and mx_chan_axis in
 * libraries/slabs/chan.glsl. Prints the constants of the functions.
 */
#include "fit.h"

#include <math.h>
#include <stdio.h>

enum { STEPS = 24, CELLS = STEPS * STEPS, POINTS = 256 };

static const double pi = 3.14159265358979323846;

struct cell {
    double cosine, gloss;
    double rough;     /* the mean of Fd of a rough surface over cosine-weighted directions */
    double bump;      /* of Fb */
    double smooth;    /* of Fd of a smooth surface, which has a closed form */
    double along, up; /* the lobe times its direction: towards the viewer's side, and the normal */
};

static double limited(double x)
{
    return fmin(fmax(x, 0.0), 1.0);
}

static double smoothness(double g)
{
    return limited(2.2 * g - 0.5);
}

static void measure(struct cell *cell)
{
    double c = cell->cosine, sine = sqrt(1.0 - c * c), g = cell->gloss;
    double height = (34.5 * g - 59.0) * g + 24.5, fall = fmax(73.2 * g - 21.2, 8.9);
    for (int i = 0; i < POINTS; ++i)
        for (int j = 0; j < POINTS; ++j) {
            double u = (i + 0.5) / POINTS, phi = pi * (j + 0.5) / POINTS, cos_l = sqrt(u);
            double x = sine + sqrt(1.0 - u) * cos(phi), y = sqrt(1.0 - u) * sin(phi), z = c + cos_l,
                   length = sqrt(x * x + y * y + z * z);
            double cos_h = z / length, vh = (sine * x + c * z) / length;
            double rough = vh + pow(1.0 - vh, 5.0), bump = height * vh * exp2(-fall * sqrt(cos_h));
            double smooth = (1.0 - 0.75 * pow(1.0 - cos_l, 5.0)) * (1.0 - 0.75 * pow(1.0 - c, 5.0));
            double lobe = (1.0 - smoothness(g)) * rough + smoothness(g) * smooth + bump;
            cell->rough += rough / (POINTS * POINTS);
            cell->bump += bump / (POINTS * POINTS);
            cell->along += lobe * sqrt(1.0 - u) * cos(phi);
            cell->up += lobe * cos_l;
        }
    /* the mean of (1 - x)^5 is 1/21 */
    cell->smooth = (1.0 - 0.75 / 21.0) * (1.0 - 0.75 * pow(1.0 - c, 5.0));
}

static double albedo(const struct cell *cell)
{
    double s = smoothness(cell->gloss);
    return (1.0 - s) * cell->rough + s * cell->smooth + cell->bump;
}

/* Row `i` of the parameters is a cubic polynomial of the cosine. */
static double row(const double *p, int i, double c)
{
    const double *r = p + i * FIT_TERMS;
    return r[0] + c * (r[1] + c * (r[2] + c * r[3]));
}

/*
 * Rough and smooth Fd, and a bump whose height has one shape until it falls faster: then it falls
 * by the mean of the root of N·H.
 */
static double fitted(const double *p, const struct cell *cell)
{
    double c = cell->cosine, g = cell->gloss, s = smoothness(g);
    double height = (34.5 * g - 59.0) * g + 24.5, faster = fmax(73.2 * g - 30.1, 0.0);
    return (1.0 - s) * row(p, 0, c) + s * cell->smooth
           + height * exp2(-faster * row(p, 2, c)) * row(p, 1, c) / (row(p, 3, c) + c);
}

static void residuals(const double *p, double *out, void *user_data)
{
    const struct cell *cells = user_data;
    for (int i = 0; i < CELLS; ++i)
        out[i] = fitted(p, &cells[i]) / albedo(&cells[i]) - 1.0;
}

/* How far the normal bends towards the viewer, in lengths of V. */
static double bend(const double *p, const struct cell *cell)
{
    double c = cell->cosine, g = cell->gloss, s = smoothness(g);
    return (p[0] + c * (p[1] + c * p[2])) * (1.0 - p[3] * g) * (1.0 - p[4] * s * s);
}

/* Angles between both directions. */
static void turns(const double *p, double *out, void *user_data)
{
    const struct cell *cells = user_data;
    for (int i = 0; i < CELLS; ++i) {
        double c = cells[i].cosine, k = bend(p, &cells[i]);
        out[i] = atan2(k * sqrt(1.0 - c * c), 1.0 + k * c) - atan2(cells[i].along, cells[i].up);
    }
}

int main(void)
{
    static struct cell cells[CELLS];
    double axis[FIT_PARAMETERS] = {0.4, -0.4, 0.2, 1.0, 1.0};
    double p[FIT_PARAMETERS] = {0.7, 0.2, 0.0, 0.0, 0.003, 0.001, 0.0,
                                0.0, 0.6, 0.2, 0.0, 0.0,   0.2};
    for (int i = 0; i < CELLS; ++i) {
        double c = (i % STEPS + 0.5) / STEPS, g = (double)(i / STEPS) / (STEPS - 1);
        cells[i] = (struct cell){.cosine = c, .gloss = g};
        measure(&cells[i]);
    }
    printf("// within %.4f, relatively\n",
           fit_minimax(p, FIT_PARAMETERS, residuals, CELLS, cells, FIT_ROUNDS));
    fit_print_form("FIT", p, 1.0);
    printf("// within %.4f radians\n",
           fit_minimax(axis, FIT_PARAMETERS, turns, CELLS, cells, FIT_ROUNDS));
    printf(
        "float bend = (%.4f + c * (%.4f + %.4f * c)) * (1.0 - %.4f * g) * (1.0 - %.4f * s * s);\n",
        axis[0], axis[1], axis[2], axis[3], axis[4]);
    return 0;
}
