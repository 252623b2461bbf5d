// SPDX-License-Identifier: Apache-2.0
/*
 * Fits the light below a curved surface for mx_subsurface_light in
 * libraries/pbrlib/shaders/diffuse.glsl: Burley's normalised diffusion profile (Christensen 2015),
 * gathered at 32 points around a circle (after Penner 2011, "Pre-integrated skin shading"). Prints
 * the constants of the function.
 *
 * The part of the response that is odd in the light's cosine c is a multiple of c, because max(c,
 * 0) is c / 2 + |c| / 2. The even part is fitted by a hyperbola. With x, the radius of the profile
 * over that of the circle,
 *
 *     response(x, c) = (odd(x) c + sqrt(flat(x)^2 (1 - c^2) + steep(x)^2 c^2)) / 2
 *
 * and odd, flat and steep are quadratic polynomials of x over a common one.
 */
#include "fit.h"

#include <math.h>
#include <stdio.h>

enum { COSINES = 33, SIZES = 48, POINTS = COSINES * SIZES, HALF_CIRCLE = 16 };

static const double pi = 3.14159265358979323846;

/* From 0.001, the least that the shader allows, to 4000. */
static double size_of(int i)
{
    double t = (i / COSINES + 0.5) / SIZES;
    return (1.0 - 0.998 * t) / (2.25 * t * t);
}

static double cosine_of(int i)
{
    return cos(pi * (i % COSINES) / (COSINES - 1));
}

static double response(double x, double c)
{
    double sine = sqrt(fmax(1.0 - c * c, 0.0)), light = 0.0, sum = 0.0;
    for (int i = 0; i < HALF_CIRCLE; ++i) {
        double half = (i + 0.5) * pi / (2 * HALF_CIRCLE), chord = sin(half);
        double e = exp(-2.0 / (3.0 * x) * chord);
        double profile = (e + e * e * e) / chord;
        light += profile
                 * (fmax(c * cos(2.0 * half) - sine * sin(2.0 * half), 0.0)
                    + fmax(c * cos(2.0 * half) + sine * sin(2.0 * half), 0.0));
        sum += 2.0 * profile;
    }
    return light / sum;
}

static double polynomial(const double *p, double x)
{
    return p[0] + x * (p[1] + x * p[2]);
}

static double fitted(const double *p, double x, double c)
{
    double below = p[9] + x * (p[10] + x);
    double odd = polynomial(p, x) / below, flat = polynomial(p + 3, x) / below,
           steep = polynomial(p + 6, x) / below;
    return 0.5 * (odd * c + sqrt(flat * flat * (1.0 - c * c) + steep * steep * c * c));
}

static double error_at(const double *p, const double *values, int i)
{
    return fitted(p, size_of(i), cosine_of(i)) - values[i];
}

static void residuals(const double *p, double *out, void *user_data)
{
    const double *values = user_data;
    for (int i = 0; i < POINTS; ++i)
        out[i] = error_at(p, values, i) * (1.0 + 3.0 * values[i]); /* brightness counts */
}

static void print_polynomial(const char *name, const double *p)
{
    printf("%s: %.4f, %.4f, %.4f\n", name, p[0], p[1], p[2]);
}

int main(void)
{
    static double values[POINTS];
    double p[FIT_PARAMETERS] = {0.2, 0.7, 0.6, 0.02, 0.2, 0.4, 0.2, 0.6, 0.8, 0.2, 0.7};
    for (int i = 0; i < POINTS; ++i)
        values[i] = response(size_of(i), cosine_of(i));
    fit_minimax(p, FIT_PARAMETERS, residuals, POINTS, values, FIT_ROUNDS);
    print_polynomial("odd", p);
    print_polynomial("flat", p + 3);
    print_polynomial("steep", p + 6);
    printf("below: %.4f, %.4f, 1\n", p[9], p[10]);
    double dark = 0.0, lit = 0.0;
    for (int i = 0; i < POINTS; ++i) {
        double *worst = values[i] < 0.3 ? &dark : &lit;
        *worst = fmax(*worst, fabs(error_at(p, values, i)));
    }
    printf("largest error below 0.3: %.4f, above: %.4f\n", dark, lit);
    return 0;
}
