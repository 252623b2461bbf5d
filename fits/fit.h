// SPDX-License-Identifier: Apache-2.0
/* Fits closed forms to functions of the library. */
#ifndef MXG_FITS_FIT_H
#define MXG_FITS_FIT_H

#include <stddef.h>

enum {
    FIT_TERMS = 4,
    FIT_PARAMETERS = FIT_TERMS * FIT_TERMS,
    FIT_MOST_PARAMETERS = 26,
    FIT_ROUNDS = 30
};

/* The polynomial dot((1, u, u², u³), M · (1, v, v², v³)) of all fits; parameters by row. */
double fit_form(const double parameters[FIT_PARAMETERS], double u, double v);

/* Prints "const mat4 NAME = …" for a function, times `scale`. */
void fit_print_form(const char *name, const double parameters[FIT_PARAMETERS], double scale);

/* Writes the residual at each point. */
typedef void (*fit_residuals)(const double *parameters, double *residuals, void *user_data);

/*
 * Minimises the largest residual: least squares (Levenberg, Marquardt) in rounds that increase the
 * weight of points with a large residual (after Lawson 1961). At most FIT_MOST_PARAMETERS. Returns
 * the largest residual.
 */
double fit_minimax(double *parameters, size_t num_parameters, fit_residuals residuals,
                   size_t num_residuals, void *user_data, int num_rounds);

#endif
