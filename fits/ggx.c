// SPDX-License-Identifier: Apache-2.0
/*
 * Integrates the GGX lobe over all directions for mx_ggx_albedo in
 * libraries/pbrlib/shaders/ggx.glsl: the directional albedo of a white lobe with single scattering,
 * and the cosine at which Schlick's curve has its mean. Prints the constants of the function.
 */
#include "fit.h"

#include <math.h>
#include <stdio.h>

enum { STEPS = 24, CELLS = STEPS * STEPS, SAMPLES = 1 << 13 };

static const double pi = 3.14159265358979323846;
#define LEAST_COSINE 0.03 /* the fit extrapolates below, where a surface is hardly visible */
#define SLACK 7e-4        /* maximum error below the albedo */

struct cell {
    double alpha, cosine;
    double albedo, at_grazing; /* the total, and the part weighted by (1 - cosine)^5 */
};

static double masking(double cosine, double alpha)
{
    return sqrt(cosine * cosine + alpha * alpha * (1.0 - cosine * cosine));
}

/* Samples visible normals (Heitz 2018), with the weight G2 / G1. */
static void measure(struct cell *cell)
{
    double c = cell->cosine, a = cell->alpha, sine = sqrt(1.0 - c * c), length = masking(c, a);
    double stretched[2] = {a * sine / length, c / length};
    for (int i = 0; i < SAMPLES; ++i) {
        double phi = 2.0 * pi * (i + 0.5) / SAMPLES,
               top = (1.0 - fmod((i + 0.5) * 0.6180339887498949, 1.0)) * (1.0 + stretched[1]);
        double z = top - stretched[1], around = sqrt(fmax(1.0 - z * z, 0.0));
        double h[3] = {(stretched[0] + around * cos(phi)) * a, around * sin(phi) * a, top};
        double scale = 1.0 / sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]),
               vh = (sine * h[0] + c * h[2]) * scale;
        double l = 2.0 * vh * h[2] * scale - c;
        if (l <= 0.0)
            continue;
        double weight = l * (c + masking(c, a)) / (c * masking(l, a) + l * masking(c, a)),
               x = pow(1.0 - vh, 5.0);
        cell->albedo += weight / SAMPLES;
        cell->at_grazing += weight * x / SAMPLES;
    }
}

/* A variable for the limit of light that grazes the facets. */
static double grazing(const struct cell *cell)
{
    return cell->alpha / (cell->alpha + cell->cosine);
}

static double albedo(const double *p, const struct cell *cell)
{
    return 1.0 - grazing(cell) * fit_form(p, grazing(cell), cell->alpha);
}

static double effective_cosine(const double *p, const struct cell *cell)
{
    return fmin(fmax(cell->cosine + cell->alpha * fit_form(p, grazing(cell), cell->alpha), 0.0),
                1.0);
}

static void albedo_residuals(const double *p, double *out, void *user_data)
{
    const struct cell *cells = user_data;
    for (int i = 0; i < CELLS; ++i)
        out[i] = albedo(p, &cells[i]) / cells[i].albedo - 1.0;
}

static void cosine_residuals(const double *p, double *out, void *user_data)
{
    const struct cell *cells = user_data;
    for (int i = 0; i < CELLS; ++i)
        out[i] =
            pow(1.0 - effective_cosine(p, &cells[i]), 5.0) * cells[i].albedo - cells[i].at_grazing;
}

int main(void)
{
    static struct cell cells[CELLS];
    double reflected[FIT_PARAMETERS] = {0.1}, cosine[FIT_PARAMETERS] = {0.1};
    for (int i = 0; i < CELLS; ++i) {
        double a = (i % STEPS + 0.5) / STEPS, c = (i / STEPS + 0.5) / STEPS;
        cells[i] = (struct cell){.alpha = a * a, .cosine = LEAST_COSINE + (1.0 - LEAST_COSINE) * c};
        measure(&cells[i]);
    }
    double error = fit_minimax(reflected, albedo_residuals, CELLS, cells),
           bound = 1.0 + error - SLACK;
    printf("// albedo times %.4f, so that it is never too small; within %.4f, relatively\n", bound,
           error);
    fit_print_form("LOST", reflected, bound);
    error = fit_minimax(cosine, cosine_residuals, CELLS, cells);
    printf("// (1 - cosine)^5 of the lobe within %.4f\n", error);
    fit_print_form("COSINE", cosine, 1.0);
    return 0;
}
