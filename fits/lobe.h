// SPDX-License-Identifier: Apache-2.0
/*
 * Integrates the lobe of a distribution of facets over all directions: the directional albedo of a
 * white lobe with single scattering, and the cosine at which Schlick's curve has its mean. Then
 * finds the round lobes that stand for anisotropic ones. Prints the constants of the three
 * functions.
 */
#ifndef MXG_FITS_LOBE_H
#define MXG_FITS_LOBE_H

/* A distribution whose shape is the same for all roughness: that of roughness 1 is enough. */
struct distribution {
    /* cos (1 + 2 Lambda) of the direction at distance x and height z from the surface's point. */
    double (*masking)(double x, double z);
    /* The light lost at this roughness and cosine is a polynomial of the first two numbers, times
     * the third. */
    void (*variables)(double alpha, double cosine, double out[3]);
    /* A normal of any length, drawn from those that are visible from v, of any length. */
    void (*draw)(const double v[3], double xi, double eta, double h[3]);
};

void lobe_fit(const struct distribution *distribution);

#endif
