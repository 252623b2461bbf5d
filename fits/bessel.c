// SPDX-License-Identifier: Apache-2.0
/*
 * Fits exp(-x) I0(x), with the modified Bessel function of the first kind, for mx_hair_bessel in
 * libraries/pbrlib/shaders/hair.glsl. Prints the constants of the function: the square is a
 * quadratic polynomial over a cubic one, exact at 0 and at infinity, where it is 1 / (2 pi x).
 */
#include "fit.h"

#include <math.h>
#include <stdio.h>

enum { POINTS = 1000 };

static const double pi = 3.14159265358979323846;

/* By quadrature of exp(x (cos t - 1)) over t; the trapezoidal rule is exact for periodic functions.
 */
static double scaled_bessel(double x)
{
    enum { STEPS = 2000 };
    double sum = 0.0;
    for (int i = 0; i < STEPS; ++i)
        sum += exp(x * (cos(2.0 * pi * i / STEPS) - 1.0));
    return sum / STEPS;
}

/* From 0 to 100 and beyond, denser towards 0. */
static double argument_of(int i)
{
    double t = (i + 0.5) / POINTS;
    return 3.0 * t / (1.0 - 0.99 * t);
}

static double fitted(const double *p, double x)
{
    double above = 1.0 + x * (p[0] + x * p[1]);
    double below = 1.0 + x * (p[2] + x * (p[3] + x * 2.0 * pi * p[1]));
    return sqrt(fabs(above / below));
}

static void residuals(const double *p, double *out, void *user_data)
{
    const double *values = user_data;
    for (int i = 0; i < POINTS; ++i)
        out[i] = fitted(p, argument_of(i)) / values[i] - 1.0;
}

int main(void)
{
    static double values[POINTS];
    double p[FIT_PARAMETERS] = {0.4, 0.6, 2.5, 2.0};
    for (int i = 0; i < POINTS; ++i)
        values[i] = scaled_bessel(argument_of(i));
    double worst = fit_minimax(p, FIT_PARAMETERS, residuals, POINTS, values, FIT_ROUNDS);
    printf("above: 1, %.4f, %.4f; below: 1, %.4f, %.4f; relative error %.5f\n", p[0], p[1], p[2],
           p[3], worst);
    return 0;
}
