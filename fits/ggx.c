// SPDX-License-Identifier: Apache-2.0
/* The constants of mx_ggx_albedo and mx_ggx_round_like in libraries/pbrlib/shaders/ggx.glsl. */
#include "lobe.h"

#include <math.h>

/* Heitz 2014, equations 72 and 80. */
static double masking(double x, double z)
{
    return hypot(x, z);
}

/* Heitz 2018. */
static void draw(const double v[3], double xi, double eta, double h[3])
{
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]), height = v[2] / length;
    double phi = 2.0 * 3.14159265358979323846 * xi, top = (1.0 - eta) * (1.0 + height);
    double z = top - height, around = sqrt(fmax(1.0 - z * z, 0.0));
    h[0] = v[0] / length + around * cos(phi);
    h[1] = v[1] / length + around * sin(phi);
    h[2] = top;
}

/* A variable for the limit of light that grazes the facets, and one that is 0 there. */
static void variables(double alpha, double cosine, double out[3])
{
    out[0] = alpha / (alpha + 0.6 * cosine);
    out[1] = alpha * cosine;
    out[2] = out[0] * out[0];
}

int main(void)
{
    lobe_fit(&(struct distribution){masking, variables, draw});
    return 0;
}
