// SPDX-License-Identifier: Apache-2.0
/*
 * Fits acos(c) / sqrt(1 - c^2) / pi for c from 0 to 1, for mx_half_turn in
 * libraries/pbrlib/shaders/environment.glsl. Prints the coefficients of a polynomial of c, and the
 * largest error of an angle: the value is multiplied by the sine.
 */
#include "fit.h"

#include <math.h>
#include <stdio.h>

enum { POINTS = 1000, DEGREE = 4 };

static const double pi = 3.14159265358979323846;

static void residuals(const double *p, double *out, void *user_data)
{
    (void)user_data;
    for (int i = 0; i < POINTS; ++i) {
        double angle = 0.5 * pi * i / (POINTS - 1), value = p[DEGREE];
        for (int k = DEGREE; k-- > 0;)
            value = p[k] + cos(angle) * value;
        out[i] = sin(angle) * value - angle / pi;
    }
}

int main(void)
{
    double p[FIT_PARAMETERS] = {0.5, -0.3, 0.2, -0.1, 0.0};
    double worst = fit_minimax(p, FIT_PARAMETERS, residuals, POINTS, NULL, FIT_ROUNDS);
    printf("from the constant: %.7f %.7f %.7f %.7f %.7f, within %.2g half turns\n", p[0], p[1],
           p[2], p[3], p[4], worst);
    return 0;
}
