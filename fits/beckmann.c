// SPDX-License-Identifier: Apache-2.0
/* The constants of mx_beckmann_albedo and mx_beckmann_round_like in
 * libraries/pbrlib/shaders/beckmann.glsl. */
#include "lobe.h"

#include <math.h>

static const double root_pi = 1.77245385090551602730;

/* Walter et al. 2007, equation 26, times 2 cos. */
static double masking(double x, double z)
{
    double a = z / fmax(x, 1e-30);
    return z * erf(a) + x / root_pi * exp(-a * a);
}

/* Where a rising function is 0, by halving. */
static double find_root(double (*f)(double x, const double *p), const double *p, double low,
                        double high)
{
    for (int i = 0; i < 40; ++i) {
        double middle = 0.5 * (low + high);
        *(f(middle, p) < 0.0 ? &low : &high) = middle;
    }
    return 0.5 * (low + high);
}

static double erf_to(double x, const double *p)
{
    return erf(x) - p[0];
}

/* The part of the visible slopes below x, for a viewer of tangent p[0] (Jakob 2014, equation 6). */
static double slopes_to(double x, const double *p)
{
    return 1.0 + erf(x) + p[0] / root_pi * exp(-x * x) - p[1];
}

static void draw(const double v[3], double xi, double eta, double h[3])
{
    double side = hypot(v[0], v[1]), tangent = side / v[2],
           most = fmin(v[2] / fmax(side, 1e-30), 6.0);
    double p[2] = {tangent, 0.0}, rest[1] = {2.0 * eta - 1.0};
    p[1] = xi * slopes_to(most, p);
    double x = find_root(slopes_to, p, -6.0, most), y = find_root(erf_to, rest, -6.0, 6.0);
    double along = side > 0.0 ? v[0] / side : 1.0, across = side > 0.0 ? v[1] / side : 0.0;
    h[0] = across * y - along * x;
    h[1] = -across * x - along * y;
    h[2] = 1.0;
}

/* Normally distributed slopes lose next to nothing where the surface is smooth. */
static void variables(double alpha, double cosine, double out[3])
{
    out[0] = exp(-0.6 * cosine / alpha);
    out[1] = alpha * cosine;
    out[2] = out[0];
}

int main(void)
{
    lobe_fit(&(struct distribution){masking, variables, draw});
    return 0;
}
