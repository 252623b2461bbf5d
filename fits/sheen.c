// SPDX-License-Identifier: Apache-2.0
/*
 * Fits the directional albedo of Conty and Kulla's sheen for mx_sheen_albedo in
 * libraries/pbrlib/shaders/sheen.glsl. Prints the constants of the function.
 */
#include "fit.h"

#include <math.h>
#include <stdio.h>

enum { STEPS = 24, CELLS = STEPS * STEPS, POINTS = 160 };

static const double pi = 3.14159265358979323846;
#define LEAST 0.05 /* the fit extrapolates below this cosine and roughness */

struct cell {
    double roughness, cosine, albedo;
};

/* The response of mx_sheen_bsdf_eval. */
static double response(double roughness, double cos_v, double cos_l, double phi)
{
    double sin_v = sqrt(1.0 - cos_v * cos_v), sin_l = sqrt(1.0 - cos_l * cos_l);
    double h[3] = {sin_v + sin_l * cos(phi), sin_l * sin(phi), cos_v + cos_l};
    double cos_h2 = h[2] * h[2] / (h[0] * h[0] + h[1] * h[1] + h[2] * h[2]), s = 1.0 / roughness;
    double d = (2.0 + s) * pow(fmax(1.0 - cos_h2, 0.0), 0.5 * s) / (2.0 * pi);
    return d * cos_l / (4.0 * (cos_l + cos_v - cos_l * cos_v));
}

static void measure(struct cell *cell)
{
    for (int i = 0; i < POINTS; ++i)
        for (int j = 0; j < POINTS; ++j)
            cell->albedo +=
                response(cell->roughness, cell->cosine, (i + 0.5) / POINTS, pi * (j + 0.5) / POINTS)
                * 2.0 * pi / (POINTS * POINTS);
}

static double albedo(const double *p, const struct cell *cell)
{
    return fit_form(p, 1.0 / (1.0 + cell->cosine), 1.0 / (0.2 + cell->roughness));
}

static void residuals(const double *p, double *out, void *user_data)
{
    const struct cell *cells = user_data;
    for (int i = 0; i < CELLS; ++i)
        out[i] = albedo(p, &cells[i]) - cells[i].albedo;
}

int main(void)
{
    static struct cell cells[CELLS];
    double p[FIT_PARAMETERS] = {0.1};
    for (int i = 0; i < CELLS; ++i) {
        double c = (i % STEPS + 0.5) / STEPS, r = (i / STEPS + 0.5) / STEPS;
        cells[i] = (struct cell){.cosine = LEAST + (1.0 - LEAST) * c,
                                 .roughness = LEAST + (1.0 - LEAST) * r};
        measure(&cells[i]);
    }
    printf("// within %.4f\n", fit_minimax(p, FIT_PARAMETERS, residuals, CELLS, cells, FIT_ROUNDS));
    fit_print_form("FIT", p, 1.0);
    return 0;
}
